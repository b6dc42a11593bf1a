// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lodestone/io/results/page.h"
#include "lodestone/io/scenes/scene_file.h"
#include "program/commands.h"
#include "program/page_file.h"
#include "program/scene_detector.h"

namespace lodestone {

/// Makes the page of a run of `detect`.
///
/// Answers come from the run. A second detector computes the truth about the same frames, and the distance of the two
/// nearest objects. The page does not change the run's answers. It affects the run's times slightly, since the second
/// detector evicts the run's data from the caches between frames.
class Page_log {
 public:
  /// @param scene, detector  of the run; they must outlive this
  Page_log(const Detect_command& command, const Scene& scene, const Scene_detector& detector);

  /// Adds the frame that the run has just answered.
  /// @param line  of frames.jsonl
  /// @param truth  whether any surfaces intersect, if that is already known
  void add(std::size_t frame, const Frame& result, const std::string& line, std::optional<bool> truth);

  void finish() { file_.finish(page_); }
  void commit() { file_.commit(); }
  /// One line that tells the user what was written.
  std::string summary() const;

 private:
  std::vector<Region_index> leaf_states(Object_id o) const;
  void set_regions();
  std::vector<std::vector<std::uint32_t>> particles() const;
  std::string stages(const Frame& result, std::optional<bool> truth);
  std::optional<double> nearest();

  const Detect_command& command_;
  const Scene& scene_;
  const Scene_detector& detector_;
  Scene_detector exact_;
  std::size_t frame_step_;
  Page page_;
  Page_file file_;
};

}  // namespace lodestone
