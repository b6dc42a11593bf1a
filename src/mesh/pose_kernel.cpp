// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/pose_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/pose_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Writes nothing past z: the next position may not have been read yet. It does not store under a
/// mask: on some processors, what reads such a position soon afterwards has to wait.
HWY_INLINE void store_position(Position_vector position, [[maybe_unused]] std::size_t i, double* to) {
#if HWY_MAX_BYTES >= 32 && HWY_TARGET != HWY_SCALAR
  const hn::Half<Position_lanes> half;
  hn::StoreU(hn::LowerHalf(half, position), half, to);
  to[2] = hn::GetLane(hn::UpperHalf(half, position));
#else
  if ((i + 1) * position_lanes <= 3)
    hn::StoreU(position, Position_lanes(), to + i * position_lanes);
  else if (i * position_lanes < 3)
    to[2] = hn::GetLane(position);
#endif
}

#if HWY_MAX_BYTES >= 64 && HWY_TARGET != HWY_SCALAR
/// Two columns in a vector: x and y, z and t.
HWY_INLINE void skin_vertex(const Skin& skin, std::uint32_t vertex, const double* shape, double* to) {
  const Double_lanes d;
  const std::uint32_t begin = skin.begin[vertex], end = skin.begin[vertex + 1];
  const auto column_pair = [&](std::uint32_t i, std::size_t pair) HWY_ATTR {
    return hn::Mul(hn::Set(d, skin.weights[i]),
                   hn::LoadU(d, skin.columns + 16 * std::size_t{skin.joints[i]} + 8 * pair));
  };
  Doubles xy = column_pair(begin, 0), zt = column_pair(begin, 1);
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    xy = hn::Add(xy, column_pair(i, 0));
    zt = hn::Add(zt, column_pair(i, 1));
  }
  const Position_lanes half;
  const auto both = [&](double lower, double upper)
                        HWY_ATTR { return hn::Combine(d, hn::Set(half, upper), hn::Set(half, lower)); };
  const double x = shape[0], y = shape[1], z = shape[2];
  const auto sum = hn::Add(hn::Mul(xy, both(x, y)), hn::Mul(zt, both(z, 1)));
  store_position(hn::Add(hn::LowerHalf(half, sum), hn::UpperHalf(half, sum)), 0, to);
}
#else
HWY_INLINE void skin_vertex(const Skin& skin, std::uint32_t vertex, const double* shape, double* to) {
  const Position_lanes d;
  const std::uint32_t begin = skin.begin[vertex], end = skin.begin[vertex + 1];
  const auto x = hn::Set(d, shape[0]), y = hn::Set(d, shape[1]), z = hn::Set(d, shape[2]);
  for (std::size_t k = 0; k < position_vectors; ++k) {
    const auto blend = [&](std::size_t column) HWY_ATTR {
      const double* from = skin.columns + 4 * column + k * position_lanes;
      const auto scaled = [&](std::uint32_t i) HWY_ATTR {
        return hn::Mul(hn::Set(d, skin.weights[i]), hn::LoadU(d, from + 16 * std::size_t{skin.joints[i]}));
      };
      auto sum = scaled(begin);
      for (std::uint32_t i = begin + 1; i < end; ++i) sum = hn::Add(sum, scaled(i));
      return sum;
    };
    const auto xz = hn::Add(hn::Mul(blend(0), x), hn::Mul(blend(2), z));
    const auto yt = hn::Add(hn::Mul(blend(1), y), blend(3));
    store_position(hn::Add(xz, yt), k, to);
  }
}
#endif

void skin_kernel(const Skin& skin, const std::uint32_t* vertices, std::size_t count, const double* shape,
                 double* coordinates) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t vertex = vertices == nullptr ? static_cast<std::uint32_t>(i) : vertices[i];
    skin_vertex(skin, vertex, shape + 3 * std::size_t{vertex}, coordinates + 3 * std::size_t{vertex});
  }
}

void add_scaled_kernel(const double* offsets, std::size_t count, double weight, double* to) {
  const Double_lanes d;
  const auto by = hn::Set(d, weight);
  std::size_t i = 0;
  for (; i + double_lanes <= count; i += double_lanes)
    hn::StoreU(hn::Add(hn::LoadU(d, to + i), hn::Mul(by, hn::LoadU(d, offsets + i))), d, to + i);
  for (; i < count; ++i) to[i] += weight * offsets[i];
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(skin_kernel);
HWY_EXPORT(add_scaled_kernel);

void skin(const Skin& skin, const std::uint32_t* vertices, std::size_t count, const double* shape,
          double* coordinates) {
  HWY_DYNAMIC_DISPATCH(skin_kernel)(skin, vertices, count, shape, coordinates);
}

void add_scaled(const double* offsets, std::size_t count, double weight, double* to) {
  HWY_DYNAMIC_DISPATCH(add_scaled_kernel)(offsets, count, weight, to);
}

}  // namespace lodestone::kernel
#endif
