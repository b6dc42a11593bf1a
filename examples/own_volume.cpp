// SPDX-License-Identifier: GPL-3.0-or-later
// A custom bounding volume in the trees of mode exact: boxes of floats, which take less than half the memory of the
// library's boxes. It finds the same contacts, as every correct bounding volume does.
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"

using namespace lodestone;

struct Float_box {
  static constexpr std::string_view name = "float_box";
  std::array<float, 3> low, high;

  void enclose(const Leaf_faces& faces) {
    Aabb box;
    box.enclose(faces);
    for (int k = 0; k < 3; ++k) {
      low[k] = std::nextafter(static_cast<float>(box.low[k]), -HUGE_VALF);  // outwards, to undo any rounding inwards
      high[k] = std::nextafter(static_cast<float>(box.high[k]), HUGE_VALF);
    }
  }
  void enclose(const Float_box& a, const Float_box& b) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(a.low[k], b.low[k]), high[k] = std::max(a.high[k], b.high[k]);
  }
  Aabb bounds() const { return {.low = {low[0], low[1], low[2]}, .high = {high[0], high[1], high[2]}}; }
  double extent() const { return bounds().extent(); }
  double volume() const { return bounds().volume(); }
  bool operator==(const Float_box&) const = default;
};

/// False only if the two are farther apart than the margin.
bool near(const Float_box& a, const Float_box& b, double margin) { return near(a.bounds(), b.bounds(), margin); }

int main() try {
  const Surface_mesh below = icosphere(40);
  Surface_mesh above = below;
  Detector boxes({.mode = Mode::exact});
  Volume_detector<Float_box> own({.mode = Mode::exact});
  for (const auto* mesh : {&std::as_const(above), &below}) boxes.add(*mesh), own.add(*mesh);

  bool same = true;
  for (const double height : {2.1, 1.9, 1.0}) {
    for (const auto v : above.vertices()) above.point(v) = below.point(v) + Kernel::Vector_3(0, 0, height);
    const auto contacts = own.detect().face_pairs;
    same &= contacts == boxes.detect().face_pairs;
    std::printf("height %.1f: %zu contacts\n", height, contacts.size());
  }
  std::printf("%s, with %zu bytes per node instead of %zu\n", same ? "as with the library's boxes" : "WRONG",
              sizeof(Float_box), sizeof(Aabb));
  return same ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
