// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/impact.h"

#include <cmath>
#include <limits>
#include <optional>

#include "triangles/exact_contacts.h"
#include "triangles/impact_filter.h"

namespace lodestone {

namespace {

/// The number half-way between two neighbours among the doubles in [0, 1].
Dyadic middle(double low, double high) {
  // The spacing of doubles is a multiple of 2^-1074, so that of their middles is one of 2^-1075.
  const Dyadic a = dyadic(low), b = dyadic(high);
  const unsigned long e = std::max(a.e, b.e);
  Integer first = a.m, second = b.m;
  first <<= e - a.e;
  second <<= e - b.e;
  return {first + second, e + 1};
}

std::array<int, 2> edge_of(int first_corner, int edge) { return {first_corner + edge, first_corner + (edge + 1) % 3}; }

/// Gives the exact test all pairs of features that the filter does not prove apart.
class Contact_search {
 public:
  Contact_search(const Moving_triangle& a, const Moving_triangle& b, double latest)
      : a_(a), b_(b), filter_(a, b, latest) {}

  std::optional<Impact_time> run() {
    if (filter_.are_apart()) return std::nullopt;
    if (!filter_.are_apart_at_start() && triangles_intersect(a_.start, b_.start)) return Impact_time();
    try_corners(0, {3, 4, 5});
    try_corners(3, {0, 1, 2});
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto first = edge_of(0, i), second = edge_of(3, j);
        if (!filter_.edges_apart(first, second)) exact().try_edges(first, second);
      }
    if (!exact_ || !exact_->first()) return std::nullopt;
    return Impact_time(*exact_->first());
  }

 private:
  void try_corners(int first_corner, const std::array<int, 3>& face) {
    for (int corner = first_corner; corner < first_corner + 3; ++corner)
      if (!filter_.corner_and_face_apart(corner, face)) exact().try_corner_and_face(corner, face);
  }

  Exact_contacts& exact() {
    if (!exact_) exact_.emplace(a_, b_);
    return *exact_;
  }

  const Moving_triangle& a_;
  const Moving_triangle& b_;
  Impact_filter filter_;
  std::optional<Exact_contacts> exact_;
};

}  // namespace

Impact_time::Impact_time(const Algebraic_time& exact) : low_(exact.round_down()), high_(low_), value_(low_) {
  if (exact.equals(low_)) return;
  high_ = std::nextafter(low_, std::numeric_limits<double>::infinity());
  value_ = exact.compare(middle(low_, high_)) > 0 ? high_ : low_;
  exact_ = std::make_shared<const Algebraic_time>(exact);
}

std::strong_ordering operator<=>(const Impact_time& a, const Impact_time& b) {
  // A time that is no double lies strictly between `low` and `high`.
  if (a.low_ != b.low_) return a.low_ < b.low_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (a.high_ != b.high_) return a.high_ < b.high_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (a.exact_ == b.exact_) return std::strong_ordering::equal;
  Algebraic_time first = *a.exact_, second = *b.exact_;
  return first.compare(second);
}

std::optional<Impact_time> first_impact(const Moving_triangle& a, const Moving_triangle& b, double latest) {
  return Contact_search(a, b, latest).run();
}

}  // namespace lodestone
