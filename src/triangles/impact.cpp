// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/impact.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "triangles/exact_contacts.h"
#include "triangles/impact_filter.h"
#include "triangles/triangle_box.h"

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

std::array<int, 2> edge_of(int first) { return {first, first < 3 ? (first + 1) % 3 : 3 + (first + 1) % 3}; }

/// Which impacts count.
struct Limit {
  const Impact_time* time = nullptr;  ///< later impacts do not count; null: all impacts count
  bool counts = false;                ///< whether an impact at this time does, or only earlier ones
};

/// Gives the exact test the pairs of features that may meet, the earliest first.
class Feature_search {
 public:
  Feature_search(const Moving_triangle& a, const Moving_triangle& b, double latest)
      : a_(a), b_(b), filter_(a, b, latest) {}

  std::optional<Impact_time> run(const Limit& limit) {
    list_candidates();
    if (limit.time != nullptr) drop_later_candidates(*limit.time);
    if (candidates_.empty()) return std::nullopt;
    std::ranges::sort(candidates_, {}, &Candidate::bound);
    Exact_contacts exact(a_, b_, limit.counts ? nullptr : limit.time);
    for (const Candidate& candidate : candidates_) {
      if (candidate.bound > exact.latest()) break;
      try_exactly(candidate, exact);
    }
    return exact.first() ? std::optional<Impact_time>(*exact.first()) : std::nullopt;
  }

 private:
  /// A corner and the other triangle, or two edges.
  struct Candidate {
    double bound;
    int first;
    int second = none;
  };
  static constexpr int none = -1;

  void list_candidates() {
    const auto add = [&](const Candidate& candidate) {
      if (std::isfinite(candidate.bound)) candidates_.push_back(candidate);
    };
    for (int corner = 0; corner < 6; ++corner) add({filter_.corner_and_face(corner), corner});
    for (int first = 0; first < 3; ++first)
      for (int second = 3; second < 6; ++second) add({filter_.edges(first, second), first, second});
  }

  /// Drops the candidates that double-double proves to be later. Many are: the faces of a block that falls flat meet
  /// the floor at times that are the same double.
  void drop_later_candidates(const Impact_time& limit) {
    const Double_double until = Double_double(limit.low()) + Double_double(limit.above_low());
    const auto is_later = [&](const Candidate& candidate) {
      const auto [bound, first, second] = candidate;
      return second != none ? filter_.edges_apart(first, second, bound, until)
                            : filter_.corner_and_face_apart(first, bound, until);
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_later), candidates_.end());
  }

  static void try_exactly(const Candidate& candidate, Exact_contacts& exact) {
    const auto [bound, first, second] = candidate;
    if (second != none)
      exact.try_edges(edge_of(first), edge_of(second));
    else if (first < 3)
      exact.try_corner_and_face(first, {3, 4, 5});
    else
      exact.try_corner_and_face(first, {0, 1, 2});
  }

  const Moving_triangle& a_;
  const Moving_triangle& b_;
  Impact_filter filter_;
  boost::container::static_vector<Candidate, 15> candidates_;
};

/// @param latest  if there is a limit, the least double that is not below it
std::optional<Impact_time> search(const Moving_triangle& a, const Moving_triangle& b, double latest,
                                  const Limit& limit) {
  const double overlap_from = overlap_time_lower_bound(box_around(a), box_around(b));
  if (!(overlap_from <= latest)) return std::nullopt;
  if (overlap_from == 0 && triangles_intersect(a.start, b.start)) return Impact_time();
  const auto first = Feature_search(a, b, latest).run(limit);
  // Beyond these the filter may have dropped what is earlier than this.
  const bool counts = first && first->high() <= latest && (limit.time == nullptr || *first <= *limit.time);
  return counts ? first : std::nullopt;
}

}  // namespace

Impact_time::Impact_time(const Algebraic_time& exact) : low_(exact.round_down()), high_(low_), value_(low_) {
  if (exact.equals(low_)) return;
  high_ = std::nextafter(low_, std::numeric_limits<double>::infinity());
  value_ = exact.compare(middle(low_, high_)) > 0 ? high_ : low_;
  above_low_ = exact.rounded_up_above(low_);
  exact_ = std::make_shared<const Algebraic_time>(exact);
}

Algebraic_time Impact_time::exact() const { return exact_ ? *exact_ : Algebraic_time(dyadic(low_)); }

std::strong_ordering operator<=>(const Impact_time& a, const Impact_time& b) {
  // A time that is no double lies strictly between `low` and `high`.
  if (a.low_ != b.low_) return a.low_ < b.low_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (a.high_ != b.high_) return a.high_ < b.high_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (a.exact_ == b.exact_) return std::strong_ordering::equal;
  Algebraic_time first = *a.exact_, second = *b.exact_;
  return first.compare(second);
}

Moving_box box_around(const Moving_triangle& moving) {
  return {.start = box_of(moving.start), .end = box_of(moving.end)};
}

std::optional<Impact_time> first_impact(const Moving_triangle& a, const Moving_triangle& b, double latest) {
  return search(a, b, latest, {});
}

std::optional<Impact_time> first_impact_before(const Impact_time& limit, const Moving_triangle& a,
                                               const Moving_triangle& b) {
  return limit == Impact_time() ? std::nullopt : search(a, b, limit.high(), {.time = &limit, .counts = false});
}

std::optional<Impact_time> first_impact_until(const Impact_time& limit, const Moving_triangle& a,
                                              const Moving_triangle& b) {
  return search(a, b, limit.high(), {.time = &limit, .counts = true});
}

}  // namespace lodestone
