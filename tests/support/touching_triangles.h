// SPDX-License-Identifier: GPL-3.0-or-later
// An oracle for triangle pairs in integer arithmetic, and pairs that are hard to decide.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "lodestone/triangles/triangle_intersection.h"
#include "support/number_vectors.h"

namespace lodestone {

using Integer_point = std::array<std::int64_t, 3>;
using Integer_triangle = std::array<Integer_point, 3>;

/// Wide enough for determinants of coordinates up to 2^28.
using Wide = __int128;
using Wide_vector = std::array<Wide, 3>;

Wide determinant(const Wide_vector& p, const Wide_vector& q, const Wide_vector& r);

bool is_zero(const Wide_vector& p);

bool same_sign(std::initializer_list<Wide> values);

/// Whether the origin lies between p and q, on the triangle p q r, in the tetrahedron p q r s. For affinely dependent
/// points the answer is 'no': the origin then lies in the hull of fewer of them.
bool origin_in(const Wide_vector& p, const Wide_vector& q);

bool origin_in(const Wide_vector& p, const Wide_vector& q, const Wide_vector& r);

bool origin_in(const Wide_vector& p, const Wide_vector& q, const Wide_vector& r, const Wide_vector& s);

/// Whether two triangles, segments or points have a common point: exactly when the origin lies in the convex hull of
/// the nine differences of their corners, that is in the hull of at most four of them (Caratheodory).
bool have_common_point(const Integer_triangle& a, const Integer_triangle& b);

bool is_degenerate(const Integer_triangle& t);

Triangle as_triangle(const Integer_triangle& t, double scale = 1, double offset = 0);

std::string text(const Integer_triangle& t);

/// Corners with coordinates from 0 to size - 1.
Integer_triangle random_triangle(std::mt19937_64& random, int size);

/// Two triangles; a corner of the second lies on the first, or misses it by one unit of some 10^7.
std::pair<Integer_triangle, Integer_triangle> nearly_touching(std::mt19937_64& random);

/// A zero-area triangle that takes products beyond 53 bits to recognise, and one that meets it or just misses it.
std::pair<Integer_triangle, Integer_triangle> nearly_touching_a_segment(std::mt19937_64& random);

}  // namespace lodestone
