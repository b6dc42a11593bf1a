// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_LEAF_POSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_LEAF_POSE_INL_H
#undef LODESTONE_LEAF_POSE_INL_H
#else
#define LODESTONE_LEAF_POSE_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "filter/face_filter_kernel.h"
#include "filter/filter_scratch.h"
#include "filter/near_boxes-inl.h"
#include "simd/lane_lookup-inl.h"
#include "simd/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Coordinates in the request's unit, seen from its origin, and rounded; all are rounded alike.
template <class Tag>
HWY_INLINE hn::Vec<hn::Rebind<float, Tag>> rounded(Tag d, const Filter_request& request, hn::Vec<Tag> origin,
                                                   hn::Vec<Tag> coordinates) {
  const auto most = hn::Set(d, static_cast<double>(std::numeric_limits<float>::max()));
  const auto scaled = hn::Mul(hn::Sub(coordinates, origin), hn::Set(d, request.scale));
  return hn::DemoteTo(hn::Rebind<float, Tag>(), hn::Min(hn::Max(scaled, hn::Neg(most)), most));
}

/// In which step of the request's region rounded coordinates are, or on which side of it.
///
/// Neither this nor rounding can reverse the order of two numbers: boxes that are within the margin of each other stay
/// so, whatever is lost.
template <class Tag>
HWY_INLINE hn::Vec<hn::Rebind<std::int16_t, Tag>> steps(Tag d, hn::Vec<Tag> coordinates, hn::Vec<Tag> per_unit) {
  const hn::Rebind<std::int32_t, Tag> integers;
  const auto inside = hn::Min(hn::Max(hn::Mul(coordinates, per_unit), hn::Zero(d)), hn::Set(d, most_steps));
  return hn::DemoteTo(hn::Rebind<std::int16_t, Tag>(),
                      hn::Add(hn::ConvertTo(integers, inside), hn::Set(integers, first_step)));
}

/// Rounds a position moved by `shift`.
HWY_INLINE void round_position(const Filter_request& request, double shift, const double* position, float* to) {
  const D d;
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto moved = hn::Add(hn::LoadU(d, position + i * lanes), hn::Set(d, shift));
    const auto origin = hn::LoadU(d, request.origin + i * lanes);
    hn::StoreU(rounded(d, request, origin, moved), hn::Rebind<float, D>(), to + i * lanes);
  }
}

/// The box of a leaf. It is kept, for most leaves meet several others.
HWY_INLINE Limits limits_of_leaf(const Leaf_input& leaf, const Filter_request& request) {
  Face_columns& faces = *leaf.faces;
  if (!faces.knows_leaf) {
    const hn::CappedTag<float, 4> d;
    const hn::Rebind<std::int16_t, decltype(d)> narrow;
    float low[4], high[4];
    round_position(request, 0, leaf.box->low, low);
    round_position(request, request.margin, leaf.box->high, high);
    for (std::size_t i = 0; i < 4; i += hn::Lanes(d)) {
      const auto per_unit = hn::LoadU(d, request.steps_per_unit + i);
      hn::StoreU(steps(d, hn::LoadU(d, low + i), per_unit), narrow, faces.low_of_leaf + i);
      hn::StoreU(steps(d, hn::LoadU(d, high + i), per_unit), narrow, faces.high_of_leaf + i);
    }
    faces.knows_leaf = true;
  }
  const auto &low = faces.low_of_leaf, &high = faces.high_of_leaf;
  const Box_lanes sides;
  return {{hn::Set(sides, low[0]), hn::Set(sides, low[1]), hn::Set(sides, low[2])},
          {hn::Set(sides, high[0]), hn::Set(sides, high[1]), hn::Set(sides, high[2])}};
}

/// The position of a vertex of a leaf; the lanes past z mean nothing.
HWY_INLINE hn::Vec<D> load_position(const Leaf_input& leaf, std::size_t place, std::size_t i) {
  return load_last(leaf.coordinates + 3 * std::size_t{leaf.vertices[place]}, i);
}

/// In which steps the vertices of a leaf are, by axis.
struct alignas(64) Vertex_steps {
  std::int16_t of[3][3 * most_leaf_faces + most_box_lanes];
};

#if HWY_TARGET <= HWY_AVX3
/// Rounds the positions of a leaf's vertices, moved by `shift`.
HWY_INLINE void round_positions(const Leaf_input& leaf, const Filter_request& request, double shift,
                                Face_columns::Positions& positions) {
  const Float_lanes d;
  const hn::Rebind<double, hn::Half<Float_lanes>> wide;
  const hn::Repartition<double, Float_lanes> pairs;
  const auto origin = hn::LoadU(D(), request.origin);
  const auto origins = hn::Combine(wide, origin, origin);
  for (std::size_t start = 0; start < leaf.vertex_count; start += hn::Lanes(d)) {
    // Vertices k, k + 4, k + 8 and k + 12, four floats each.
    const auto row = [&](std::size_t k) HWY_ATTR {
      const auto position = [&](std::size_t place) HWY_ATTR { return load_position(leaf, start + place, 0); };
      const auto two_rows = [&](std::size_t first) HWY_ATTR {
        const auto two = hn::Combine(wide, position(first + 4), position(first));
        return rounded(wide, request, origins, hn::Add(two, hn::Set(wide, shift)));
      };
      return hn::Combine(d, two_rows(k + 8), two_rows(k));
    };
    const auto row0 = row(0), row1 = row(1), row2 = row(2), row3 = row(3);
    const auto xy01 = hn::BitCast(pairs, hn::InterleaveLower(d, row0, row1));
    const auto xy23 = hn::BitCast(pairs, hn::InterleaveLower(d, row2, row3));
    const auto z01 = hn::BitCast(pairs, hn::InterleaveUpper(d, row0, row1));
    const auto z23 = hn::BitCast(pairs, hn::InterleaveUpper(d, row2, row3));
    hn::Store(hn::BitCast(d, hn::InterleaveLower(pairs, xy01, xy23)), d, positions[0] + start);
    hn::Store(hn::BitCast(d, hn::InterleaveUpper(pairs, xy01, xy23)), d, positions[1] + start);
    hn::Store(hn::BitCast(d, hn::InterleaveLower(pairs, z01, z23)), d, positions[2] + start);
  }
}

HWY_INLINE hn::Vec<Vertex_lanes> pack_corners(hn::Vec<Vertex_lanes> p, hn::Vec<Vertex_lanes> q,
                                              hn::Vec<Vertex_lanes> r) {
  return hn::Or3(p, hn::ShiftLeft<10>(q), hn::ShiftLeft<20>(r));
}

/// Bounds of the steps of the corners of all faces: `low` of where they are, `high` of where they are moved to.
HWY_INLINE void fit_boxes(const Leaf_input& leaf, const Vertex_steps& here, const Vertex_steps& moved) {
  const Box_lanes d;
  const Box_places places;
  const Vertex_lanes wide;
  Face_columns& faces = *leaf.faces;
  for (std::size_t first = 0; first < leaf.face_count; first += hn::Lanes(d)) {
    hn::Vec<Box_places> corners[3];
    hn::LoadInterleaved3(places, leaf.corners[first].data(), corners[0], corners[1], corners[2]);
    Looked_up<std::int16_t, Box_places, 3> low[3], high[3];
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = look_up(places, here.of, leaf.vertex_count, corners[c]);
      high[c] = &moved == &here ? low[c] : look_up(places, moved.of, leaf.vertex_count, corners[c]);
    }
    const auto lower = [&](std::size_t c) HWY_ATTR { return hn::PromoteTo(wide, hn::LowerHalf(corners[c])); };
    const auto upper = [&](std::size_t c)
                           HWY_ATTR { return hn::PromoteTo(wide, hn::UpperHalf(hn::Half<Box_places>(), corners[c])); };
    hn::Store(pack_corners(lower(0), lower(1), lower(2)), wide, faces.corners[0] + first);
    hn::Store(pack_corners(upper(0), upper(1), upper(2)), wide, faces.corners[0] + first + hn::Lanes(wide));
    Sides lowest_of[3], highest_of[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lowest_of[axis] = hn::Min(hn::Min(low[0].of[axis], low[1].of[axis]), low[2].of[axis]);
      highest_of[axis] = hn::Max(hn::Max(high[0].of[axis], high[1].of[axis]), high[2].of[axis]);
    }
    store_boxes(lowest_of, highest_of, leaf.face_count - first, faces, first);
  }
}
#else
HWY_INLINE void round_positions(const Leaf_input& leaf, const Filter_request& request, double shift,
                                Face_columns::Positions& positions) {
  for (std::size_t place = 0; place < leaf.vertex_count; ++place) {
    double position[4];
    float near[4];
    for (std::size_t i = 0; i < vectors; ++i) hn::StoreU(load_position(leaf, place, i), D(), position + i * lanes);
    round_position(request, shift, position, near);
    for (std::size_t axis = 0; axis < 3; ++axis) positions[axis][place] = near[axis];
  }
}

HWY_INLINE void fit_boxes(const Leaf_input& leaf, const Vertex_steps& here, const Vertex_steps& moved) {
  for (std::size_t f = 0; f < leaf.face_count; ++f) {
    const auto& [p, q, r] = leaf.corners[f];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto &low = here.of[axis], &high = moved.of[axis];
      leaf.faces->low[axis][f] = std::min({low[p], low[q], low[r]});
      leaf.faces->high[axis][f] = std::max({high[p], high[q], high[r]});
    }
  }
  end_columns(*leaf.faces, leaf.face_count);
}
#endif

HWY_INLINE void positions_to_steps(const Face_columns::Positions& positions, const Filter_request& request,
                                   std::size_t count, Vertex_steps& to) {
  const Float_lanes d;
  const hn::Rebind<std::int16_t, Float_lanes> narrow;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto per_unit = hn::Set(d, request.steps_per_unit[axis]);
    for (std::size_t first = 0; first < count; first += hn::Lanes(d))
      hn::Store(steps(d, hn::Load(d, positions[axis] + first), per_unit), narrow, to.of[axis] + first);
  }
}

/// Fills in where the faces of a leaf are.
HWY_INLINE void pose(const Leaf_input& leaf, const Filter_request& request) {
  Face_columns& faces = *leaf.faces;
  Vertex_steps here;
  round_positions(leaf, request, 0, faces.positions);
  positions_to_steps(faces.positions, request, leaf.vertex_count, here);
  if (request.margin > 0) {
    alignas(64) Face_columns::Positions moved_positions;
    Vertex_steps moved;
    round_positions(leaf, request, request.margin, moved_positions);
    positions_to_steps(moved_positions, request, leaf.vertex_count, moved);
    fit_boxes(leaf, here, moved);
  } else {
    fit_boxes(leaf, here, here);
  }
  if (request.one_mesh) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t f = 0; f < leaf.face_count; ++f)
        faces.vertices[corner][f] = leaf.vertices[leaf.corners[f][corner]];
    end_columns(faces, leaf.face_count);  // a leaf against itself reads vectors from any face on
  }
  faces.count = leaf.face_count;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
