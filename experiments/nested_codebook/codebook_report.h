// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "nested_codebook/hierarchy_search.h"

namespace lodestone {

/// How the hierarchies of a row are built.
struct Hierarchy_kind {
  std::size_t regions = 0;     ///< at their tops, made as mode `particles` does; 1: none
  std::size_t leaf_faces = 0;  ///< most faces of a leaf
  std::string name;
  double leaf_share = 1;                     ///< leaves have at most so many times `leaf_faces` faces
  std::optional<double> normal_weight = {};  ///< of LBG's splits; none: at medians

  std::size_t most_faces() const {
    return static_cast<std::size_t>(std::lround(leaf_share * static_cast<double>(leaf_faces)));
  }
  bool is_base() const { return !normal_weight && leaf_share == 1; }
  bool compares_with(const Hierarchy_kind& other) const {
    return regions == other.regions && leaf_faces == other.leaf_faces;
  }
};

/// The figures of one kind of hierarchy, with one reach, on one scene.
struct Codebook_row {
  std::string scene;
  std::size_t frames = 0;
  Hierarchy_kind kind;
  double reach = 1;
  std::size_t faces = 0, leaves = 0;  ///< of all objects
  double build_seconds = 0;           ///< of all objects
  Search_counts counts = {};

  double per_frame(std::size_t count) const { return static_cast<double>(count) / static_cast<double>(frames); }
  double to_first() const { return ratio(counts.read_to_first, counts.reached); }
  double recall() const { return ratio(counts.reached, counts.colliding); }
  double face_pair_recall() const { return ratio(counts.contacts_reached, counts.contacts); }
  static double ratio(std::size_t part, std::size_t whole) {
    return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
  }
};

nlohmann::ordered_json to_json(const Codebook_row& row);

/// A table over all scenes, then a table of the rows that have the regions and the reach of the first.
/// @param rows  those of one scene after the other, each in the same order; the first is split at medians
std::string codebook_report(std::span<const Codebook_row> rows);

}  // namespace lodestone
