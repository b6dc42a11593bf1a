// SPDX-License-Identifier: GPL-3.0-or-later
// Slow answers about moving triangles that share nothing with the library's own way.
#pragma once

#include <optional>
#include <vector>

#include "lodestone/triangles/impact.h"
#include "support/exact_point.h"

namespace lodestone {

/// Whether two moving triangles have a point in common at a time: CGAL's `do_intersect`, in rational numbers.
bool meet_at(const Moving_triangle& a, const Moving_triangle& b, const Rational& t);

/// The fractions in [0, 1] whose denominators are at most this, ascending.
std::vector<Rational> fractions(int largest_denominator);

/// The fraction of the least denominator between two numbers, 0 <= low < high.
Rational simplest_between(const Rational& low, const Rational& high);

/// Conservative advancement in floating point: goes from 0 in steps that are too short to pass a contact, until the
/// distance is below `near`.
/// @return none if it arrives at 1
std::optional<double> advance(const Moving_triangle& a, const Moving_triangle& b, double near);

/// The triangle at a time, with rounded corners.
Triangle rounded_at(const Moving_triangle& moving, double t);

}  // namespace lodestone
