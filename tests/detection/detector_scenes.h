// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of a few meshes, and what every frame of a detector must hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <string_view>

#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "support/test_meshes.h"

namespace lodestone {

using Owned_meshes = std::deque<Surface_mesh>;
inline constexpr std::array modes{Mode::particles, Mode::senin};

inline const Detector_options all_contacts{.mode = Mode::particles, .particles = 32, .contacts = Contact_query::all};

/// Every pair of the frame against exhaustive checking; gives the number of pairs that collide.
std::size_t expect_true(const Frame& frame, const Owned_meshes& scene);

/// The statistics of a frame are the sums over its pairs, whose contacts follow one another.
void expect_sums_of_pairs(const Frame& frame);

Owned_meshes two_spheres(double distance, int parts = 12);

/// A strategy that needs the mesh itself.
struct By_vertex_number {
  static constexpr std::string_view name = "by vertex number";
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    Labelling result;
    for (const auto v : vertices(input.mesh))
      result.labels.push_back(input.numbering.index(v) % static_cast<Region_index>(regions));
    return result;
  }
};

template <class Detector_type>
void add_all(Detector_type& detector, Owned_meshes& scene) {
  for (auto& mesh : scene) detector.add(mesh);
}

void expect_equal(const Frame& a, const Frame& b);

}  // namespace lodestone
