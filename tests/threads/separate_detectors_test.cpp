// SPDX-License-Identifier: GPL-3.0-or-later
// Detectors of different threads share nothing that changes.
#include <gtest/gtest.h>

#include <deque>
#include <thread>

#include "lodestone/find_collisions.h"
#include "lodestone/partition/strategies.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

/// What a thread does on its own: a few frames of one mode, with several threads inside.
std::vector<Frame> frames_of(Mode mode) {
  std::deque<Surface_mesh> scene{sphere(12), potato(10, 2)};
  Detector<> detector({.mode = mode, .particles = finds_all(mode) ? 0U : 12U, .contact_points = true, .threads = 2});
  for (auto& mesh : scene) detector.add(mesh);
  std::vector<Frame> frames;
  for (int frame = 0; frame < 3; ++frame) {
    detector.update();
    frames.push_back(detector.detect());
    shift(scene[1], 0.07, 0.02);
  }
  return frames;
}

constexpr std::array all_modes{Mode::exact, Mode::certified, Mode::particles, Mode::senin};

TEST(Separate_detectors, answer_side_by_side_what_they_answer_alone) {
  std::array<std::vector<Frame>, all_modes.size()> alone;
  for (std::size_t i = 0; i < all_modes.size(); ++i) alone[i] = frames_of(all_modes[i]);
  std::array<std::vector<Frame>, 2 * all_modes.size()> found;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] { found[i] = frames_of(all_modes[i % all_modes.size()]); });
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t frame = 0; frame < found[i].size(); ++frame)
      expect_same_frame(found[i][frame], alone[i % all_modes.size()][frame]);
}

TEST(Separate_detectors, may_read_one_mesh_side_by_side) {
  const Surface_mesh a = sphere(14), b = potato(11, 5);
  const auto truth = exhaustive_face_pairs(a, b);
  std::array<std::vector<Face_pair>, 4> found;
  std::vector<std::thread> threads;
  for (auto& pairs : found)
    threads.emplace_back([&] {
      Detector<> detector({.threads = 2});
      detector.add(a);
      detector.add(b);
      pairs = detector.detect().face_pairs;
    });
  for (auto& thread : threads) thread.join();
  for (const auto& pairs : found) EXPECT_EQ(pairs, truth);
}

/// The regions of all vertices.
std::vector<Region_index> regions_by(const Strategy_entry& entry) {
  Surface_mesh mesh = potato(9, 3);
  auto regions = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:own").first;
  partition(mesh, 8, regions, make_strategy(entry.name));
  return {regions.begin(), regions.end()};
}

TEST(Separate_detectors, partitions_side_by_side_are_those_made_alone) {
  std::vector<std::vector<Region_index>> alone, found(2 * strategies().size());
  for (const auto& entry : strategies()) alone.push_back(regions_by(entry));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] { found[i] = regions_by(strategies()[i % strategies().size()]); });
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 0; i < found.size(); ++i) {
    SCOPED_TRACE(strategies()[i % strategies().size()].name);
    EXPECT_EQ(found[i], alone[i % alone.size()]);
  }
}

}  // namespace
}  // namespace lodestone
