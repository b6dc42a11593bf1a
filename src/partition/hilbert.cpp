// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/hilbert.h"

#include <CGAL/hilbert_sort.h>

#include <numeric>
#include <utility>
#include <vector>

#include "partition/used_surface.h"

namespace lodestone {

namespace {

/// Vertex indices as points. CGAL's adaptor of its kernels is not used: it compares coordinates only, so the standard
/// library would decide on which side of a median vertices with equal coordinates end.
struct Numbered_points {
  using Point_3 = std::uint32_t;

  template <Eigen::Index axis>
  struct Less {
    const Positions* positions;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return std::pair((*positions)(a, axis), a) < std::pair((*positions)(b, axis), b);
    }
  };
  using Less_x_3 = Less<0>;
  using Less_y_3 = Less<1>;
  using Less_z_3 = Less<2>;

  Less_x_3 less_x_3_object() const { return {positions}; }
  Less_y_3 less_y_3_object() const { return {positions}; }
  Less_z_3 less_z_3_object() const { return {positions}; }

  const Positions* positions;
};

Labelling label_hilbert(const Numbered_surface& surface, std::size_t regions) {
  std::vector<std::uint32_t> order(static_cast<std::size_t>(surface.positions.rows()));
  std::iota(order.begin(), order.end(), 0);
  CGAL::hilbert_sort(order.begin(), order.end(), Numbered_points{&surface.positions});

  Labelling labelling{.labels = std::vector<Region_index>(order.size())};
  for (std::size_t i = 0; i < order.size(); ++i)
    labelling.labels[order[i]] = static_cast<Region_index>(i * regions / order.size());
  return labelling;
}

}  // namespace

Labelling Hilbert::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, label_hilbert);
}

}  // namespace lodestone
