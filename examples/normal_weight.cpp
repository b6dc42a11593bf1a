// SPDX-License-Identifier: GPL-3.0-or-later
// How much should normals weigh against positions? A sweep over the weight, with the measures of each partition.
#include <algorithm>
#include <cstdio>
#include <exception>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/lbg.h"
#include "lodestone/partition/partition_measures.h"

using namespace lodestone;

int main() try {
  Surface_mesh mesh = teapot();
  const auto regions = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;

  std::printf("weight  parts per region  border  normals (degrees)  radius  balls\n");
  double flattest = 180, roughest = 0;
  for (const double weight : {0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    const auto divided = lbg(mesh, 32, regions, {.features = {.normal_weight = weight}});
    const auto measures = measure_partition(mesh, divided, regions);
    std::printf("%6.2f  %16.2f  %6.2f  %17.1f  %6.3f  %5.2f\n", weight, measures.parts_per_region,
                measures.border_length, measures.normal_deviation, measures.geodesic_radius, measures.ball_volume);
    flattest = std::min(flattest, measures.normal_deviation);
    roughest = std::max(roughest, measures.normal_deviation);
  }
  return flattest < roughest ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
