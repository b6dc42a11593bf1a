// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_leaf_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/ray_leaf_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "queries/leaf_codes-inl.h"
#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint64_t every_direction = ~std::uint64_t{0};

/// Component `axis` of some vectors.
template <int axis>
HWY_INLINE Doubles component(const Vector3<Double_lanes>& v) {
  if constexpr (axis == 0) return v.x;
  if constexpr (axis == 1) return v.y;
  return v.z;
}

/// Writes the code of each vertex of a leaf.
/// @return the bits that all vertices have in common
template <int depth_axis>
HWY_INLINE std::uint64_t code_vertices(const Leaf_faces& leaf, const Ray_input& ray, double error, double most_depth,
                                       std::uint64_t* codes) {
  constexpr int x_axis = (depth_axis + 1) % 3, y_axis = (depth_axis + 2) % 3;
  const Double_lanes d;
  const Code_lanes code_lanes;
  const auto origin = in_all_lanes(d, ray.origin);
  const Doubles shear_x = hn::Set(d, ray.shear[x_axis]), shear_y = hn::Set(d, ray.shear[y_axis]);
  const Doubles beyond = hn::Set(d, error), beyond_of_two = hn::Set(d, 3 * error);
  const std::uint32_t* const vertices = leaf.vertices.data();
  const std::size_t count = leaf.vertices.size();
  Codes common = hn::Set(code_lanes, every_direction);
  for (std::size_t k = 0; k < count; k += double_lanes) {
    const auto a = load_positions([&](std::size_t lane) HWY_ATTR {
                     return leaf.coordinates.data() + 3 * std::size_t{vertices[k + lane]};
                   }) -
                   origin;
    const Doubles a_z = component<depth_axis>(a);
    const Doubles x = hn::Sub(component<x_axis>(a), hn::Mul(shear_x, a_z));
    const Doubles y = hn::Sub(component<y_axis>(a), hn::Mul(shear_y, a_z));
    const Doubles depth = hn::Mul(hn::Set(d, ray.sign), a_z);
    const Doubles sum = hn::Add(x, y), difference = hn::Sub(x, y);
    Codes code = hn::Zero(code_lanes);
    add_bit(code, 0, hn::Gt(x, beyond));
    add_bit(code, 1, hn::Lt(x, hn::Neg(beyond)));
    add_bit(code, 2, hn::Gt(y, beyond));
    add_bit(code, 3, hn::Lt(y, hn::Neg(beyond)));
    // A sum carries both errors and a rounding.
    add_bit(code, 4, hn::Gt(sum, beyond_of_two));
    add_bit(code, 5, hn::Lt(sum, hn::Neg(beyond_of_two)));
    add_bit(code, 6, hn::Gt(difference, beyond_of_two));
    add_bit(code, 7, hn::Lt(difference, hn::Neg(beyond_of_two)));
    // One rounding does not move a depth across a double.
    add_bit(code, 8, hn::Lt(depth, hn::Zero(d)));
    add_bit(code, 9, hn::Gt(depth, hn::Set(d, most_depth)));
    hn::StoreU(code, code_lanes, codes + k);
    const auto padding = hn::Not(hn::FirstN(code_lanes, count - k));
    common = hn::And(common, hn::Or(code, hn::IfThenElseZero(padding, hn::Set(code_lanes, every_direction))));
  }
  std::uint64_t lanes[double_lanes], bits = every_direction;
  hn::StoreU(common, code_lanes, lanes);
  for (const std::uint64_t lane : lanes) bits &= lane;
  return bits;
}

std::size_t list_ray_candidates_kernel(const Leaf_faces& leaf, const Ray_input& ray, double error, double most_depth,
                                       std::uint8_t* candidates) {
  prefetch(leaf.corners);
  std::uint64_t codes[most_codes];
  const std::uint64_t common = ray.depth_axis == 0   ? code_vertices<0>(leaf, ray, error, most_depth, codes)
                               : ray.depth_axis == 1 ? code_vertices<1>(leaf, ray, error, most_depth, codes)
                                                     : code_vertices<2>(leaf, ray, error, most_depth, codes);
  if (common != 0) return 0;
  return list_faces(leaf, codes, candidates);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(list_ray_candidates_kernel);

std::size_t list_ray_candidates(const Leaf_faces& leaf, const Ray_input& ray, double error, double most_depth,
                                std::uint8_t* candidates) {
  return HWY_DYNAMIC_DISPATCH(list_ray_candidates_kernel)(leaf, ray, error, most_depth, candidates);
}

}  // namespace lodestone::kernel
#endif
