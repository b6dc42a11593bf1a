// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/filter/face_group_filter.h"

#include <algorithm>
#include <array>

#include "filter/face_columns.h"
#include "filter/face_filter_kernel.h"
#include "filter/filter_request.h"
#include "filter/filter_scratch.h"

namespace lodestone {

namespace {

/// Every face of a group has three vertices of its own: to look for those in common would take longer than the filter.
constexpr auto own_corners = [] {
  std::array<Leaf_corners, most_leaf_faces + most_side_lanes> corners{};  // padded: the kernel reads whole vectors
  for (std::size_t face = 0; face < most_leaf_faces; ++face)
    for (std::size_t corner = 0; corner < 3; ++corner)
      corners[face][corner] = static_cast<std::uint16_t>(3 * face + corner);
  return corners;
}();

}  // namespace

/// One of the two meshes, and a group of its faces.
struct Face_group_filter::Side {
  Coordinates coordinates;
  std::array<std::uint32_t, 3 * most_leaf_faces + most_float_lanes> vertices;
  Aabb box;
  Face_columns columns;

  kernel::Leaf_input input(std::span<const Corners> faces) {
    const std::size_t count = 3 * faces.size();
    for (std::size_t f = 0; f < faces.size(); ++f) std::ranges::copy(faces[f], vertices.begin() + 3 * f);
    std::fill_n(vertices.begin() + count, most_float_lanes, vertices.front());
    columns.clear();
    box.enclose({.coordinates = coordinates,
                 .vertices = std::span(vertices).first(count),
                 .corners = std::span(own_corners).first(faces.size())});
    return {.coordinates = coordinates.data(),
            .vertices = vertices.data(),
            .corners = own_corners.data(),
            .vertex_count = count,
            .face_count = faces.size(),
            .box = &box,
            .faces = &columns};
  }
};

Face_group_filter::Face_group_filter()
    : sides_{std::make_unique_for_overwrite<Side>(), std::make_unique_for_overwrite<Side>()},
      request_(std::make_unique<kernel::Filter_request>()),
      scratch_(std::make_unique_for_overwrite<Filter_scratch>()) {}
Face_group_filter::~Face_group_filter() = default;

void Face_group_filter::begin(Coordinates a, const Aabb& bounds_a, Coordinates b, const Aabb& bounds_b) {
  sides_[0]->coordinates = a;
  sides_[1]->coordinates = b;
  *request_ = filter_request(bounds_a, bounds_b, 0);
}

std::span<const Face_candidate> Face_group_filter::face_candidates(std::span<const Corners> a,
                                                                   std::span<const Corners> b) {
  candidates_.resize(std::max(candidates_.size(), a.size() * b.size() + most_float_lanes));
  const auto input_a = sides_[0]->input(a), input_b = sides_[1]->input(b);
  const Aabb &box_a = *input_a.box, &box_b = *input_b.box;
  const auto request = is_too_coarse(*request_, box_a, box_b) ? filter_request(box_a, box_b, 0) : *request_;
  const std::size_t count = kernel::face_candidates(input_a, input_b, request, *scratch_, candidates_.data());
  return {candidates_.data(), count};
}

}  // namespace lodestone
