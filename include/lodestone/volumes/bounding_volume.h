// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <string_view>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// A volume around the faces below a node of a region tree: a set of points, defined exactly by the numbers it stores.
/// The page docs/concepts/bounding_volume.md defines every operation; in short:
///
/// - `v.enclose(faces)` fits v to the faces of a leaf: every point of every face lies in v, despite rounding
/// - `v.enclose(a, b)` fits v to two volumes: everything that a or b was fitted to lies in v
/// - `near(a, b, margin)` is false only if no point of a is within `margin` >= 0 of a point of b
/// - `v.extent()` is a length that compares the sizes of volumes; 0 for a point
/// - `v.volume()` is the volume of the set in cubic units, up to rounding, or an upper bound where the model says so;
///   smaller is tighter
/// - `v.bounds()` is an axis-aligned box around everything that v was fitted to
/// - `v == w`: the same fit to the same faces gives equal volumes
/// - `V::name` is its name in tables and messages
template <class V>
concept Bounding_volume = std::default_initializable<V> && std::copyable<V> && std::equality_comparable<V> &&
    requires(V& fitted, const V& a, const V& b, const Leaf_faces& faces, double margin) {
  { V::name } -> std::convertible_to<std::string_view>;
  fitted.enclose(faces);
  fitted.enclose(a, b);
  { near(a, b, margin) } -> std::same_as<bool>;
  { a.extent() } -> std::same_as<double>;
  { a.volume() } -> std::same_as<double>;
  { a.bounds() } -> std::same_as<Aabb>;
};

static_assert(Bounding_volume<Aabb>);

}  // namespace lodestone
