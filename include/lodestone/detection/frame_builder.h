// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"

namespace lodestone {

/// Makes the frames of a mode, pair by pair. Reuses its memory from frame to frame.
class Frame_builder {
 public:
  /// @param options  which points and normals a frame has; the tolerance below which faces are contacts
  explicit Frame_builder(const Detector_options& options);
  /// Makes room for so many pairs and contacts.
  void reserve(std::size_t pairs, std::size_t face_pairs);

  /// Starts the next frame: without pairs.
  /// @param statistics  what happened since the frame before
  void start(const Frame_statistics& statistics = {});

  /// Of the current frame, to be added to.
  Frame_statistics& statistics() { return frame_.statistics; }
  /// Of the current frame, to be added to.
  Stage_times& seconds() { return frame_.statistics.seconds; }
  /// Number of the frame, from 1.
  std::uint64_t number() const { return frame_.number; }
  /// The contacts of all pairs so far. A stage appends those of its pair between `start_pair` and `end_pair`.
  std::vector<Face_pair>& face_pairs() { return frame_.face_pairs; }
  /// Candidate regions of all pairs so far, to be appended to.
  std::vector<Candidate_regions>& candidates() { return frame_.candidates; }
  /// `Frame::object_iterations`, to be written.
  std::vector<std::size_t>& object_iterations() { return frame_.object_iterations; }

  /// Starts a pair: what is appended from now on is its own.
  Pair_result start_pair(Object_pair pair) const {
    return {.a = pair.a, .b = pair.b, .first_contact = frame_.face_pairs.size(), .first_patch = frame_.patches.size()};
  }
  /// Ends a pair: counts its contacts, and computes their points and normals if the options ask for them.
  /// @param triangle_of  gives the triangle of an object's face: called with Object_id and face index
  template <class Triangle_of>
  void end_pair(Pair_result result, Triangle_of triangle_of) {
    result.contacts = frame_.face_pairs.size() - result.first_contact;
    if (points_ || normals_) {
      for (const auto& [face_a, face_b] : frame_.contacts(result)) {
        faces_.push_back({triangle_of(result.a, face_a), triangle_of(result.b, face_b)});
        if (faces_.size() == most_faces) add_geometry();
      }
      add_geometry();
    }
    frame_.pairs.push_back(result);
  }

  /// Groups the contacts of the last pair into contact patches, if the options ask for them.
  /// @param a, b       surfaces of its objects
  /// @param tolerance  below which faces are contacts
  void add_patches(const Object_surface& a, const Object_surface& b, double tolerance);

  /// Forgets what the pairs hold, to find it anew.
  void clear_pairs();

  /// Ends the frame: sums up what the pairs hold.
  const Frame& finish();

 private:
  /// So many contacts share a pass, which stays in the caches.
  static constexpr std::size_t most_faces = 64;

  void add_geometry();
  void add_gap(const Closest_points& nearest);

  bool points_, normals_, patches_;
  bool contacts_may_be_apart_;  ///< a contact can be two faces that are near without intersecting
  Frame frame_;
  std::vector<Triangle_pair> faces_;  ///< of contacts whose geometry is still to be added
};

}  // namespace lodestone
