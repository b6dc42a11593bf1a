// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/slab_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volumes/slab_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Vertices are processed in blocks of eight. A block takes as many vector registers ("parts") as hold eight numbers.
constexpr std::size_t together = 8;
using Eight = hn::CappedTag<double, together>;
using Numbers = hn::Vec<Eight>;
constexpr std::size_t part_size = hn::MaxLanes(Eight());
constexpr std::size_t parts = together / part_size;

struct Positions {
  Numbers x[parts], y[parts], z[parts];
};

/// The vertices of a leaf, in blocks of eight.
struct Vertex_blocks {
  const Leaf_faces& faces;
  std::size_t last;  ///< index of the last vertex: only that one may be the last of the mesh

  explicit Vertex_blocks(const Leaf_faces& leaf) : faces(leaf), last(leaf.vertices.size() - 1) {}
  /// Blocks before this index are full and without the last vertex; from this index on, 1 to 8 vertices are left.
  std::size_t rest() const { return last / together * together; }
};

#if HWY_MAX_BYTES >= 32
/// A vertex in four lanes; the fourth is unspecified.
template <bool with_last>
HWY_INLINE hn::Vec<D> load(const Vertex_blocks& blocks, std::size_t index) {
  if constexpr (with_last)
    return load_last(blocks.faces.position(std::min(index, blocks.last)), 0);
  else
    return hn::LoadU(D(), blocks.faces.position(index));
}

struct Four_positions {
  hn::Vec<D> x, y, z;
};

template <bool with_last>
HWY_INLINE Four_positions load_four(const Vertex_blocks& blocks, std::size_t first) {
  const D d;
  const auto p = load<with_last>(blocks, first), q = load<with_last>(blocks, first + 1);
  const auto r = load<with_last>(blocks, first + 2), s = load<with_last>(blocks, first + 3);
  const auto xz_pq = hn::InterleaveLower(d, p, q), xz_rs = hn::InterleaveLower(d, r, s);
  const auto y_pq = hn::InterleaveUpper(d, p, q), y_rs = hn::InterleaveUpper(d, r, s);
  return {hn::ConcatLowerLower(d, xz_rs, xz_pq), hn::ConcatLowerLower(d, y_rs, y_pq),
          hn::ConcatUpperUpper(d, xz_rs, xz_pq)};
}

/// Eight vertices from index `first` on. With the last vertex, copies of it pad the block.
template <bool with_last>
HWY_INLINE Positions load_positions(const Vertex_blocks& blocks, std::size_t first) {
  const auto lower = load_four<with_last>(blocks, first), upper = load_four<with_last>(blocks, first + 4);
#if HWY_MAX_BYTES >= 64
  const Eight d;
  return {{hn::Combine(d, upper.x, lower.x)}, {hn::Combine(d, upper.y, lower.y)}, {hn::Combine(d, upper.z, lower.z)}};
#else
  return {{lower.x, upper.x}, {lower.y, upper.y}, {lower.z, upper.z}};
#endif
}
#else
template <bool with_last>
HWY_INLINE Positions load_positions(const Vertex_blocks& blocks, std::size_t first) {
  alignas(64) double x[together], y[together], z[together];
  for (std::size_t k = 0; k < together; ++k) {
    const double* position = blocks.faces.position(with_last ? std::min(first + k, blocks.last) : first + k);
    x[k] = position[0], y[k] = position[1], z[k] = position[2];
  }
  const Eight d;
  Positions result;
  for (std::size_t part = 0; part < parts; ++part) {
    result.x[part] = hn::Load(d, x + part * part_size);
    result.y[part] = hn::Load(d, y + part * part_size);
    result.z[part] = hn::Load(d, z + part * part_size);
  }
  return result;
}
#endif

/// Minima and maxima of the numbers that a projection computes for each vertex.
template <class Projection>
struct Projection_limits {
  static constexpr std::size_t count = Projection::count;
  Numbers low[count], high[count];

  HWY_INLINE void start(const Projection& projection, const Positions& p) {
    projection(p.x[0], p.y[0], p.z[0], low);
    for (std::size_t i = 0; i < count; ++i) high[i] = low[i];
    for (std::size_t part = 1; part < parts; ++part) extend(projection, p, part);
  }
  HWY_INLINE void extend(const Projection& projection, const Positions& p) {
    for (std::size_t part = 0; part < parts; ++part) extend(projection, p, part);
  }
  HWY_INLINE void extend(const Projection& projection, const Positions& p, std::size_t part) {
    Numbers values[count];
    projection(p.x[part], p.y[part], p.z[part], values);
    for (std::size_t i = 0; i < count; ++i) {
      low[i] = hn::Min(low[i], values[i]);
      high[i] = hn::Max(high[i], values[i]);
    }
  }
  /// Adding zero turns -0 into +0, so that the order of two zeros does not affect the result.
  HWY_INLINE void store(double* least, double* greatest) const {
    const Eight d;
    for (std::size_t i = 0; i < count; ++i) {
      least[i] = hn::GetLane(hn::MinOfLanes(d, low[i])) + 0.0;
      greatest[i] = hn::GetLane(hn::MaxOfLanes(d, high[i])) + 0.0;
    }
  }
};

template <class Projection>
HWY_INLINE void limits(const Leaf_faces& faces, const Projection& projection, double* low, double* high) {
  const Vertex_blocks blocks(faces);
  Projection_limits<Projection> found;
  found.start(projection, load_positions<true>(blocks, blocks.rest()));
  for (std::size_t first = 0; first < blocks.rest(); first += together)
    found.extend(projection, load_positions<false>(blocks, first));
  found.store(low, high);
}

template <int K>
struct Dop_projection {
  static constexpr std::size_t count = K / 2;

  HWY_INLINE void operator()(Numbers x, Numbers y, Numbers z, Numbers* values) const {
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
  Numbers origin[3], axes[3][3];

  HWY_INLINE explicit Frame_projection(const Frame& frame) {
    const Eight d;
    for (std::size_t i = 0; i < 3; ++i) {
      origin[i] = hn::Set(d, frame.origin[i]);
      for (std::size_t k = 0; k < 3; ++k) axes[i][k] = hn::Set(d, frame.axes[i][k]);
    }
  }
  HWY_INLINE void operator()(Numbers x, Numbers y, Numbers z, Numbers* values) const {
    values[0] = hn::Sub(x, origin[0]), values[1] = hn::Sub(y, origin[1]), values[2] = hn::Sub(z, origin[2]);
    for (std::size_t i = 0; i < 3; ++i)
      values[3 + i] = hn::Add(hn::Add(hn::Mul(axes[i][0], values[0]), hn::Mul(axes[i][1], values[1])),
                              hn::Mul(axes[i][2], values[2]));
  }
};

/// Nine sums per lane. The terms of vertex k of every block are added in lane k, for any vector width.
struct Moment_sums {
  Numbers sums[9][parts];
  Numbers origin[3], scale;

  HWY_INLINE Moment_sums(const double* position, double factor) {
    const Eight d;
    for (auto& sum : sums)
      for (auto& part : sum) part = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) origin[i] = hn::Set(d, position[i]);
    scale = hn::Set(d, factor);
  }
  HWY_INLINE void add(const Positions& p) {
    for (std::size_t part = 0; part < parts; ++part) {
      const auto x = hn::Mul(hn::Sub(p.x[part], origin[0]), scale), y = hn::Mul(hn::Sub(p.y[part], origin[1]), scale),
                 z = hn::Mul(hn::Sub(p.z[part], origin[2]), scale);
      const Numbers terms[9]{
          x, y, z, hn::Mul(x, x), hn::Mul(y, y), hn::Mul(z, z), hn::Mul(x, y), hn::Mul(x, z), hn::Mul(y, z)};
      for (std::size_t i = 0; i < 9; ++i) sums[i][part] = hn::Add(sums[i][part], terms[i]);
    }
  }
  HWY_INLINE double total(std::size_t i) const {
    alignas(64) double lane[together];
    for (std::size_t part = 0; part < parts; ++part) hn::Store(sums[i][part], Eight(), lane + part * part_size);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  }
};

void dop_limits_kernel(const Leaf_faces& faces, int K, double* low, double* high) {
  if (K == 14)
    limits(faces, Dop_projection<14>(), low, high);
  else if (K == 18)
    limits(faces, Dop_projection<18>(), low, high);
  else
    limits(faces, Dop_projection<26>(), low, high);
}

Frame_limits frame_limits_kernel(const Leaf_faces& faces, const Frame& frame) {
  Frame_limits result;
  limits(faces, Frame_projection(frame), result.low, result.high);
  return result;
}

/// The last vertex is the origin, so the copies of it that pad the last block add zero.
Moments moments_kernel(const Leaf_faces& faces, double scale) {
  const Vertex_blocks blocks(faces);
  Moment_sums sums(faces.position(blocks.last), scale);
  for (std::size_t first = 0; first < blocks.rest(); first += together) sums.add(load_positions<false>(blocks, first));
  sums.add(load_positions<true>(blocks, blocks.rest()));
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
