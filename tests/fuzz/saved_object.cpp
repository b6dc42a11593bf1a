// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a saved object: loaded by a detector of each kind, and then asked.
#include <cmath>
#include <utility>
#include <vector>

#include "fuzz/byte_source.h"
#include "fuzz/detector_truth.h"
#include "lodestone/detection/saved_object.h"
#include "lodestone/detector.h"

namespace {

using namespace lodestone::fuzz;
using lodestone::Detector;
using lodestone::Detector_options;
using lodestone::Mode;

/// A wavy cloth of 7 x 7 squares.
void make_cloth(double height, Drawn_object& object) {
  constexpr std::uint32_t side = 8;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j)
      object.coordinates.insert(object.coordinates.end(), {double(i), double(j), height + std::sin(i * 2 + j)});
  for (std::uint32_t v = 0; v + side + 1 < side * side; ++v)
    if (v % side != side - 1)
      object.faces.insert(object.faces.end(), {{v, v + side, v + side + 1}, {v, v + side + 1, v + 1}});
  object.make_mesh();
}

std::vector<Detector_options> all_options() {
  Detector_options exact{.mode = Mode::exact};
  exact.tree.leaf_faces = 8;
  Detector_options regions = exact;
  regions.particles = 4;
  Detector_options near_itself = exact;
  near_itself.exact.self_collision = true;
  near_itself.exact.self_tolerance = 0.1;
  const Detector_options particles{.mode = Mode::particles, .particles = 6};
  return {exact, regions, near_itself, particles};
}

/// Modes whose particles need no tree.
std::vector<Detector_options> options_without_meetings() {
  return {{.mode = Mode::particles, .particles = 6, .meetings = 0}, {.mode = Mode::senin, .particles = 6}};
}

}  // namespace

// The first byte chooses the options, and whether the rest is the file as it is or only what follows its hash: damage
// would else hardly ever get past that.
LODESTONE_FUZZ_TARGET(saved_object) {
  static const auto options = all_options(), without_meetings = options_without_meetings();
  Byte_source bytes(input);
  const auto choice = bytes.byte();
  const auto rest = std::as_bytes(bytes.rest());
  const auto saved = choice < 128 ? lodestone::seal_saved(rest) : std::vector<std::byte>(rest.begin(), rest.end());

  Drawn_object a, b;
  make_cloth(0, a);
  make_cloth(0.5, b);
  constexpr unsigned others = 64;  // of what the byte says
  const auto& kinds = (choice & others) != 0 ? without_meetings : options;
  Detector_options asked = kinds[choice % kinds.size()];
  Detector<> detector(asked);
  detector.add(std::as_const(*a.mesh));
  detector.add(std::as_const(*b.mesh));
  if (!accepts([&] { detector.load(0, saved); })) return;

  asked.exact.self_collision = false;  // only the pair of both is compared
  auto smaller = a.coordinates;
  for (double& coordinate : smaller) coordinate *= 0.9;
  a.change(std::move(smaller), {}, {});
  accepts([&] { check_pair(detector.detect(), asked, {0, 1}, a, b, true); });
  const auto again = detector.save(0);
  require(accepts([&] { detector.load(0, again); }), "what was loaded and saved is refused");
}
