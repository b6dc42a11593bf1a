// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/slab_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volumes/slab_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"
#include "volumes/vertex_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Least and greatest of the numbers to which a projection takes each vertex.
template <class Projection>
struct Projection_limits {
  static constexpr std::size_t count = Projection::count;
  Doubles low[count], high[count];

  HWY_INLINE void start(const Projection& projection, const Vertex_block& block) {
    projection(block.of[0], low);
    for (std::size_t i = 0; i < count; ++i) high[i] = low[i];
    for (std::size_t i = 1; i < block_vectors; ++i) extend(projection, block.of[i]);
  }
  HWY_INLINE void extend(const Projection& projection, const Vertex_block& block) {
    for (const auto& p : block.of) extend(projection, p);
  }
  HWY_INLINE void extend(const Projection& projection, const Vector3<Double_lanes>& p) {
    Doubles values[count];
    projection(p, values);
    for (std::size_t i = 0; i < count; ++i) {
      low[i] = hn::Min(low[i], values[i]);
      high[i] = hn::Max(high[i], values[i]);
    }
  }
  /// Adding zero turns -0 into 0: which of the two was found depends on the order of the lanes.
  HWY_INLINE void store(double* least, double* greatest) const {
    const Double_lanes d;
    for (std::size_t i = 0; i < count; ++i) {
      least[i] = hn::GetLane(hn::MinOfLanes(d, low[i])) + 0.0;
      greatest[i] = hn::GetLane(hn::MaxOfLanes(d, high[i])) + 0.0;
    }
  }
};

template <class Projection>
HWY_INLINE void find_limits(const Leaf_faces& faces, const Projection& projection, double* low, double* high) {
  const Vertex_blocks blocks(faces);
  Projection_limits<Projection> limits;
  limits.start(projection, blocks.load_last());
  for (std::size_t first = 0; first < blocks.last_block(); first += block_vertices)
    limits.extend(projection, blocks.load(first));
  limits.store(low, high);
}

template <int K>
struct Dop_projection {
  static constexpr std::size_t count = K / 2;

  HWY_INLINE void operator()(const Vector3<Double_lanes>& p, Doubles* values) const {
    const auto [x, y, z] = p;
    const auto sum = hn::Add(x, y), difference = hn::Sub(x, y);
    values[0] = x, values[1] = y, values[2] = z;
    if constexpr (K >= 18) {
      values[3] = sum, values[4] = difference;
      values[5] = hn::Add(x, z), values[6] = hn::Sub(x, z);
      values[7] = hn::Add(y, z), values[8] = hn::Sub(y, z);
    }
    if constexpr (K != 18) {
      values[count - 4] = hn::Add(sum, z), values[count - 3] = hn::Sub(sum, z);
      values[count - 2] = hn::Add(difference, z), values[count - 1] = hn::Sub(difference, z);
    }
  }
};

struct Frame_projection {
  static constexpr std::size_t count = 6;
  Vector3<Double_lanes> origin, axes[3];

  HWY_INLINE explicit Frame_projection(const Frame& frame) {
    const Double_lanes d;
    origin = in_all_lanes(d, frame.origin);
    for (std::size_t i = 0; i < 3; ++i) axes[i] = in_all_lanes(d, frame.axes[i]);
  }
  HWY_INLINE void operator()(const Vector3<Double_lanes>& p, Doubles* values) const {
    const auto v = p - origin;
    values[0] = v.x, values[1] = v.y, values[2] = v.z;
    for (std::size_t i = 0; i < 3; ++i) values[3 + i] = dot(axes[i], v);
  }
};

/// Nine sums per lane. Lane k of a block adds up the terms of every eighth vertex from the k-th on.
struct Moment_sums {
  Doubles sums[9][block_vectors];
  Vector3<Double_lanes> origin;
  Doubles scale;

  HWY_INLINE Moment_sums(const double* position, double factor) {
    const Double_lanes d;
    for (auto& sum : sums)
      for (auto& part : sum) part = hn::Zero(d);
    origin = in_all_lanes(d, position);
    scale = hn::Set(d, factor);
  }
  HWY_INLINE void add(const Vertex_block& block) {
    for (std::size_t i = 0; i < block_vectors; ++i) {
      const auto v = block.of[i] - origin;
      const auto x = hn::Mul(v.x, scale), y = hn::Mul(v.y, scale), z = hn::Mul(v.z, scale);
      const Doubles terms[9]{
          x, y, z, hn::Mul(x, x), hn::Mul(y, y), hn::Mul(z, z), hn::Mul(x, y), hn::Mul(x, z), hn::Mul(y, z)};
      for (std::size_t k = 0; k < 9; ++k) sums[k][i] = hn::Add(sums[k][i], terms[k]);
    }
  }
  HWY_INLINE double total(std::size_t k) const {
    alignas(64) double lane[block_vertices];
    for (std::size_t i = 0; i < block_vectors; ++i) hn::Store(sums[k][i], Double_lanes(), lane + i * double_lanes);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  }
};

void dop_limits_kernel(const Leaf_faces& faces, int K, double* low, double* high) {
  if (K == 14)
    find_limits(faces, Dop_projection<14>(), low, high);
  else if (K == 18)
    find_limits(faces, Dop_projection<18>(), low, high);
  else
    find_limits(faces, Dop_projection<26>(), low, high);
}

Frame_limits frame_limits_kernel(const Leaf_faces& faces, const Frame& frame) {
  Frame_limits result;
  find_limits(faces, Frame_projection(frame), result.low, result.high);
  return result;
}

/// The last vertex is the origin, so its repetitions in the last block add nothing.
Moments moments_kernel(const Leaf_faces& faces, double scale) {
  const Vertex_blocks blocks(faces);
  Moment_sums sums(faces.position(blocks.last), scale);
  for (std::size_t first = 0; first < blocks.last_block(); first += block_vertices) sums.add(blocks.load(first));
  sums.add(blocks.load_last());
  Moments result;
  for (std::size_t i = 0; i < 3; ++i) result.first[i] = sums.total(i);
  for (std::size_t i = 0; i < 6; ++i) result.second[i] = sums.total(3 + i);
  return result;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(dop_limits_kernel);
HWY_EXPORT(frame_limits_kernel);
HWY_EXPORT(moments_kernel);

void dop_limits(const Leaf_faces& faces, int K, double* low, double* high) {
  HWY_DYNAMIC_DISPATCH(dop_limits_kernel)(faces, K, low, high);
}

Frame_limits frame_limits(const Leaf_faces& faces, const Frame& frame) {
  return HWY_DYNAMIC_DISPATCH(frame_limits_kernel)(faces, frame);
}

Moments moments(const Leaf_faces& faces, double scale) { return HWY_DYNAMIC_DISPATCH(moments_kernel)(faces, scale); }

}  // namespace lodestone::kernel
#endif
