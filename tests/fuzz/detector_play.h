// SPDX-License-Identifier: GPL-3.0-or-later
// A detector and its objects, driven by bytes.
#pragma once

#include <deque>
#include <set>

#include "fuzz/drawn_objects.h"
#include "lodestone/detector.h"

namespace lodestone::fuzz {

/// Any options that a detector accepts.
Detector_options draw_options(Byte_source& bytes);

/// Adds, moves, changes and removes objects, and compares every answer with exhaustive checking.
class Detector_play {
 public:
  explicit Detector_play(const Detector_options& options) : options_(options), detector_(options) {}

  /// Until the bytes are used up, or it has taken long enough.
  void run(Byte_source& bytes);

 private:
  void act(Byte_source& bytes);
  void add(Byte_source& bytes);
  void remove(Byte_source& bytes);
  void rebuild(Byte_source& bytes);
  void ignore(Byte_source& bytes);
  void save_and_load(Byte_source& bytes);
  void place(Byte_source& bytes);
  void give(Byte_source& bytes);
  void detect_without_a_number(Byte_source& bytes);
  void query(Byte_source& bytes);
  void query_two(Byte_source& bytes, Object_id a, Object_id b);
  void query_one(Byte_source& bytes, Object_id object);
  void query_all(const Ray& ray);
  void detect();

  /// An object that there is; there must be one.
  Object_id one_of(Byte_source& bytes) const;
  bool may_collide(Object_id a, Object_id b) const;
  std::size_t present() const;

  Detector_options options_;
  std::deque<Drawn_object> objects_;  ///< before the detector, which refers to them
  Detector<> detector_;
  std::set<Object_pair> ignored_;
  std::vector<Collision_groups> groups_;
};

}  // namespace lodestone::fuzz
