// SPDX-License-Identifier: GPL-3.0-or-later
// A custom partition strategy: slices of equal size along an axis. It is measured beside LBG and used by a detector,
// which takes it as a template argument. With two arguments, MESH and LABELS, the program writes the labels of a mesh
// file for the experiment `partitions`.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <numeric>

#include "lodestone/detector.h"
#include "lodestone/io/meshes/label_file.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/partition_measures.h"

using namespace lodestone;

struct Slices {
  static constexpr std::string_view name = "slices";
  int axis = 2;

  /// Sorts the vertices by one coordinate and cuts the order into `regions` runs of equal length.
  Labelling operator()(const Partition_input<Surface_mesh>& input, std::size_t regions) const {
    std::vector<std::uint32_t> order(input.positions.rows());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](auto v) { return input.positions(v, axis); });
    Labelling labelling{.labels = std::vector<Region_index>(order.size())};
    for (std::size_t rank = 0; rank < order.size(); ++rank)
      labelling.labels[order[rank]] = static_cast<Region_index>(rank * regions / order.size());
    return labelling;
  }
};

template <class Strategy>
void show(Surface_mesh mesh, const Strategy& strategy) {
  const auto regions = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
  const auto divided = partition(mesh, 12, regions, strategy);
  const auto measures = measure_partition(mesh, divided, regions);
  std::printf("%-8s %zu regions, border %.1f, normals off by %.0f degrees, largest region %.2f of the mean\n",
              strategy.name.data(), measures.regions, measures.border_length, measures.normal_deviation,
              measures.size_balance);
}

void label(const char* mesh_file, const char* label_file) {
  Mesh_file file = read_mesh(mesh_file);
  const auto regions = file.mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
  partition(file.mesh, 32, regions, Slices{});
  std::vector<Region_index> labels(file.file_vertices);
  for (const auto v : file.mesh.vertices()) labels[file.file_vertex[v]] = regions[v];
  write_labels(label_file, labels);
}

int main(int argc, char** argv) try {
  if (argc == 3) {
    label(argv[1], argv[2]);
    return 0;
  }
  Surface_mesh knot = torus_knot();
  Surface_mesh sphere = icosphere(12);
  show(knot, Slices{});
  show(knot, Lbg{});

  Detector<Slices> detector({.mode = Mode::particles, .particles = 24}, Slices{.axis = 0});
  detector.add(knot);
  detector.add(sphere);
  const bool collide = detector.detect().collides();
  std::printf("by particles in slices, knot and sphere %s\n", collide ? "collide" : "are not seen to collide");
  return collide ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
