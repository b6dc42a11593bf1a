// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/scenes/scene_file.h"
#include "program/commands.h"
#include "program/detect_summary.h"
#include "program/frame_log.h"
#include "program/frame_tally.h"
#include "program/page_log.h"
#include "program/paraview_log.h"
#include "program/scene_detector.h"
#include "program/scene_hash.h"
#include "program/scene_positions.h"

namespace lodestone {

/// A run of `detect` through a scene: the detector, the truth beside it, and the results so far.
class Detect_run {
 public:
  /// @param command  must outlive this
  explicit Detect_run(const Detect_command& command);

  std::size_t frames() const { return scene_.frames; }
  /// Answers a frame. @return its line of frames.jsonl, line break included
  std::string play(std::size_t frame);
  /// Plays a frame for what the detector keeps of it: its answer counts nowhere.
  void warm_up(std::size_t frame);
  /// What the summary has been told of the last frame.
  const Frame_tally& last_tally() const { return tally_; }
  /// Counts a frame that another process has played.
  void add(const Frame_tally& tally);
  /// The objects as they were in the process that has played the last frame.
  void set_objects(nlohmann::ordered_json objects) { objects_ = std::move(objects); }
  /// The revision of the program that has played the frames, if it is another one.
  void set_revision(std::string revision) { revision_ = std::move(revision); }
  /// See hash_of(Scene&).
  std::string hash_of_inputs() { return hash_of(scene_); }
  nlohmann::ordered_json objects() const { return objects_json(subject()); }
  nlohmann::ordered_json summary() const { return summary_json(subject(), summary_); }
  void print() const { print_summary(subject(), summary_); }
  std::string answer() const { return one_line_answer(subject(), summary_); }
  bool finds_any() const { return summary_.finds_any(); }
  const Scene& scene() const { return scene_; }
  /// Whether positions are computed where the detector looks.
  bool computes_positions() const {
    return std::ranges::any_of(computed_, [](const auto& c) { return c != nullptr; });
  }
  /// The number of vertices of an object that lie on others along seams, which its particles walk across.
  std::size_t joined_vertices(Object_id id) const;
  /// Null if no page was requested.
  Page_log* page() { return page_ ? &*page_ : nullptr; }
  Paraview_log* paraview() { return paraview_ ? &*paraview_ : nullptr; }
  /// Whether a false contact was reported, or mode exact missed one.
  bool contradicts_truth() const { return contradicted_ || (missed_ && finds_all(command_.options.mode)); }

 private:
  Run_subject subject() const { return {command_, scene_, detector_ ? &*detector_ : nullptr, objects_, revision_}; }
  void compute_motions();
  void make_detector();
  void pose_all(std::size_t frame);
  const Frame& detect();
  template <class Visit>
  void for_each_pair(const Visit& visit) const;
  std::optional<std::vector<Pair_truth>> find_truth() const;
  std::optional<std::vector<Pair_closest>> find_closest();
  std::optional<std::vector<Object_impact>> find_impacts(std::size_t frame);
  void compare(const Frame& result, const std::vector<Pair_truth>& truth);
  std::optional<bool> any_truth(const std::optional<std::vector<Pair_truth>>& truth) const;

  const Detect_command& command_;
  Scene scene_;
  std::vector<std::unique_ptr<Computed_motion>> computed_;  ///< per object in mode certified; null: read from files
  /// With --impacts: where all vertices are in the frame after the last one that was played. So each is read once.
  std::vector<Positions> ahead_;
  std::size_t frame_ahead_ = 0;  ///< 0: none
  bool asks_once_ = false;
  std::optional<Scene_detector> detector_;  ///< none if the only frame has been made without one
  std::optional<Frame> only_frame_;         ///< the one that has been made so
  nlohmann::ordered_json objects_;          ///< null: of this detector
  std::string revision_;                    ///< of the program that has played the frames
  Frame_tally tally_;
  Run_summary summary_;
  std::optional<Page_log> page_;
  std::optional<Paraview_log> paraview_;
  bool contradicted_ = false, missed_ = false;
};

}  // namespace lodestone
