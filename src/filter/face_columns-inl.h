// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_FACE_COLUMNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_FACE_COLUMNS_INL_H
#undef LODESTONE_FACE_COLUMNS_INL_H
#else
#define LODESTONE_FACE_COLUMNS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "filter/box_lanes-inl.h"
#include "filter/face_columns.h"
#include "filter/face_filter_kernel.h"
#include "filter/rounding-inl.h"
#include "simd/lane_lookup-inl.h"
#include "simd/positions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The steps that the vertices of a leaf are in, by axis.
struct alignas(64) Vertex_steps {
  std::int16_t of[3][3 * most_leaf_faces + most_side_lanes];
};

/// Rounds the positions of a leaf's vertices, moved by `shift`.
HWY_INLINE void round_positions(const Leaf_input& leaf, const Filter_request& request, double shift,
                                Face_columns::Positions& positions) {
  const Double_lanes d;
  const hn::Rebind<float, Double_lanes> narrow;
  const auto origin = in_all_lanes(d, request.origin);
  const auto round = [&](Doubles axis_origin, Doubles coordinates)
                         HWY_ATTR { return rounded(d, request, axis_origin, hn::Add(coordinates, hn::Set(d, shift))); };
  std::size_t first = 0;
  for (; first < leaf.vertex_count; first += double_lanes) {
    const auto [x, y, z] = load_positions(
        [&](std::size_t lane) { return leaf.coordinates + 3 * std::size_t{leaf.vertices[first + lane]}; });
    hn::Store(round(origin.x, x), narrow, positions[0] + first);
    hn::Store(round(origin.y, y), narrow, positions[1] + first);
    hn::Store(round(origin.z, z), narrow, positions[2] + first);
  }
  // The last floats are read as a vector. Processors are slow at numbers that are too small to be normal.
  for (; first % float_lanes != 0; first += double_lanes)
    for (auto& axis : positions) hn::Store(hn::Zero(narrow), narrow, axis + first);
}

HWY_INLINE void step_positions(const Face_columns::Positions& positions, const Filter_request& request,
                               std::size_t count, Vertex_steps& to) {
  const Float_lanes d;
  const hn::Rebind<std::int16_t, Float_lanes> narrow;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto per_unit = hn::Set(d, request.steps_per_unit[axis]);
    for (std::size_t first = 0; first < count; first += float_lanes)
      hn::Store(steps(d, hn::Load(d, positions[axis] + first), per_unit), narrow, to.of[axis] + first);
  }
}

#if HWY_TARGET <= HWY_AVX3
HWY_INLINE Indices pack_corners(Indices p, Indices q, Indices r) {
  return hn::Or3(p, hn::ShiftLeft<10>(q), hn::ShiftLeft<20>(r));
}

/// Fits boxes around the corners of all faces: `low` sides where the corners are, `high` sides where they are moved to.
HWY_INLINE void fit_boxes(const Leaf_input& leaf, const Vertex_steps& here, const Vertex_steps& moved) {
  const Side_lanes d;
  const Side_index_lanes indices;
  const Index_lanes wide;
  Face_columns& faces = *leaf.faces;
  for (std::size_t first = 0; first < leaf.face_count; first += side_lanes) {
    hn::Vec<Side_index_lanes> corners[3];
    hn::LoadInterleaved3(indices, leaf.corners[first].data(), corners[0], corners[1], corners[2]);
    Looked_up<std::int16_t, Side_index_lanes, 3> low[3], high[3];
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = look_up(indices, here.of, leaf.vertex_count, corners[c]);
      high[c] = &moved == &here ? low[c] : look_up(indices, moved.of, leaf.vertex_count, corners[c]);
    }
    const auto lower = [&](std::size_t c) HWY_ATTR { return hn::PromoteTo(wide, hn::LowerHalf(corners[c])); };
    const auto upper = [&](std::size_t c) HWY_ATTR {
      return hn::PromoteTo(wide, hn::UpperHalf(hn::Half<Side_index_lanes>(), corners[c]));
    };
    hn::Store(pack_corners(lower(0), lower(1), lower(2)), wide, faces.corners[0] + first);
    hn::Store(pack_corners(upper(0), upper(1), upper(2)), wide, faces.corners[0] + first + float_lanes);
    Sides lowest[3], highest[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lowest[axis] = hn::Min(hn::Min(low[0].of[axis], low[1].of[axis]), low[2].of[axis]);
      highest[axis] = hn::Max(hn::Max(high[0].of[axis], high[1].of[axis]), high[2].of[axis]);
    }
    store_boxes(lowest, highest, leaf.face_count - first, faces, first);
  }
}
#else
HWY_INLINE void fit_boxes(const Leaf_input& leaf, const Vertex_steps& here, const Vertex_steps& moved) {
  for (std::size_t f = 0; f < leaf.face_count; ++f) {
    const auto& [p, q, r] = leaf.corners[f];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto &low = here.of[axis], &high = moved.of[axis];
      leaf.faces->low[axis][f] = std::min({low[p], low[q], low[r]});
      leaf.faces->high[axis][f] = std::max({high[p], high[q], high[r]});
    }
  }
  pad_columns(*leaf.faces, leaf.face_count);
}
#endif

HWY_INLINE void copy_vertices(const Leaf_input& leaf) {
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t f = 0; f < leaf.face_count; ++f)
      leaf.faces->vertices[corner][f] = leaf.vertices[leaf.corners[f][corner]];
}

/// Fills in the columns of a leaf: the rounded corners of its faces, and boxes around them. Out of line: a leaf meets
/// several others, and is rounded once.
HWY_NOINLINE inline void fill_columns(const Leaf_input& leaf, const Filter_request& request) {
  Face_columns& faces = *leaf.faces;
  Vertex_steps here;
  round_positions(leaf, request, 0, faces.positions);
  step_positions(faces.positions, request, leaf.vertex_count, here);
  if (request.margin > 0) {
    alignas(64) Face_columns::Positions moved_positions;
    Vertex_steps moved;
    round_positions(leaf, request, request.margin, moved_positions);
    step_positions(moved_positions, request, leaf.vertex_count, moved);
    fit_boxes(leaf, here, moved);
  } else {
    fit_boxes(leaf, here, here);
  }
  if (request.one_mesh) {
    copy_vertices(leaf);
    pad_columns(faces, leaf.face_count);  // unaligned: a leaf against itself reads vectors from any face on
  }
  faces.count = leaf.face_count;
}

/// Rounds the corners of a leaf's faces, if that has not been done yet.
HWY_INLINE void round_corners(const Leaf_input& leaf, const Filter_request& request) {
  if (!leaf.faces->has_faces()) fill_columns(leaf, request);
}

/// The rounded box of a leaf. It is kept, since most leaves meet several others.
HWY_INLINE Lane_box leaf_box(const Leaf_input& leaf, const Filter_request& request) {
  Face_columns& faces = *leaf.faces;
  if (!faces.has_leaf_box) {
    step_corner(request, 0, leaf.box->low, faces.leaf_low);
    step_corner(request, request.margin, leaf.box->high, faces.leaf_high);
    faces.has_leaf_box = true;
  }
  const Side_lanes d;
  const auto &low = faces.leaf_low, &high = faces.leaf_high;
  return {{hn::Set(d, low[0]), hn::Set(d, low[1]), hn::Set(d, low[2])},
          {hn::Set(d, high[0]), hn::Set(d, high[1]), hn::Set(d, high[2])}};
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
