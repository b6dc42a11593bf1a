// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/impact.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "lodestone/triangles/triangle_distance.h"
#include "support/exact_point.h"
#include "support/moving_triangles.h"
#include "support/special_numbers.h"
#include "triangles/impact_oracle.h"

namespace lodestone {
namespace {

const Moving_triangle origin = standing({Point(0, 0, 0), Point(0, 0, 0), Point(0, 0, 0)});

Moving_triangle moving_point(const Point& from, const Point& to) { return {{from, from, from}, {to, to, to}}; }
Moving_triangle moving_segment(const Point& p, const Point& q, const Point& to_p, const Point& to_q) {
  return {{p, q, q}, {to_p, to_q, to_q}};
}
Moving_triangle all_scaled(const Moving_triangle& moving, double factor) {
  return mapped(moving, [factor](const Point& p) { return Point(factor * p.x(), factor * p.y(), factor * p.z()); });
}

/// The first impact in both orders, which must be the same, as a double; infinity: none.
double time_of(const Moving_triangle& a, const Moving_triangle& b) {
  const auto forth = first_impact(a, b), back = first_impact(b, a);
  EXPECT_EQ(forth, back);
  return forth ? forth->value() : infinity;
}

TEST(First_impact, of_a_corner_and_a_face_is_when_the_corner_is_on_the_face) {
  const Moving_triangle face = standing({Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0)});
  const auto fall = [&](double x, double y, double from, double to) {
    const Triangle above{Point(x, y, from), Point(x, y, from + 1), Point(x + 1, y, from + 1)};
    const Triangle below{Point(x, y, to), Point(x, y, to + 1), Point(x + 1, y, to + 1)};
    return time_of({above, below}, face);
  };
  EXPECT_EQ(fall(1, 1, 1, -1), 0.5);
  EXPECT_EQ(fall(1, 1, 3, -1), 0.75);
  EXPECT_EQ(fall(1, 1, 1, -2), 1.0 / 3);
  EXPECT_EQ(fall(2, 2, 1, -1), 0.5) << "on an edge";
  EXPECT_EQ(fall(0, 0, 1, -1), 0.5) << "on a corner";
  EXPECT_EQ(fall(1, 1, 1, 0), 1) << "at the end";
  EXPECT_EQ(fall(1, 1, 0, 1), 0) << "at the start";
  EXPECT_EQ(fall(1, 1, 1, std::numeric_limits<double>::denorm_min()), infinity);
  EXPECT_EQ(fall(1, 1, std::numeric_limits<double>::denorm_min(), 1), infinity);
  EXPECT_EQ(fall(3, 2, 1, -1), infinity);
  EXPECT_EQ(fall(std::nextafter(2, 3), 2, 1, -1), infinity);
  EXPECT_EQ(fall(-1, 1, 1, -1), 1) << "the last corner comes to an edge";
  EXPECT_EQ(fall(std::nextafter(-1, -2), 1, 1, -1), infinity);
}

TEST(First_impact, of_edges_can_be_at_an_irrational_time) {
  const Moving_triangle a = standing({Point(-1, 0, 0), Point(1, 0, 0), Point(0, 0, -5)});
  // At y = 0 the edge between the first two corners has the height (1 - 2 t^2) / (1 + t).
  const Moving_triangle b{{Point(0, -1, 0), Point(0, 0, 1), Point(0, -1, 10)},
                          {Point(0, -1, -2), Point(0, 1, 1), Point(0, -1, 10)}};
  EXPECT_EQ(time_of(a, b), std::sqrt(0.5));
  const auto time = first_impact(a, b);
  EXPECT_LT(time->low(), time->high());
  EXPECT_EQ(std::nextafter(time->low(), 1), time->high());
}

/// A triangle whose plane contains the origin where (t - r)(t - s)(t - q) = 0. Its corners are the rows of the
/// companion matrix of that polynomial, plus t: at the root t the weights of the corners, as they make the origin, are
/// rsq / t, minus the sum of the other two roots, and 1. A factor of -1 flips the sign of a weight.
Moving_triangle companion(double r, double s, double q, double flip_first, double flip_second) {
  const double c0 = -r * s * q, c1 = r * s + s * q + q * r, c2 = -(r + s + q);
  const auto at = [&](double t) {
    return Triangle{Point(flip_first * t, -flip_first, 0), Point(0, flip_second * t, -flip_second),
                    Point(c0, c1, c2 + t)};
  };
  return {at(0), at(1)};
}

TEST(First_impact, is_at_the_first_root_that_is_inside) {
  EXPECT_EQ(time_of(companion(0.25, 0.75, -0.5, -1, 1), origin), 0.75);
  EXPECT_EQ(time_of(companion(0.25, 0.75, -0.5, -1, -1), origin), 0.25);
  EXPECT_EQ(time_of(companion(0.25, 0.5, 0.75, 1, 1), origin), infinity);
  EXPECT_EQ(time_of(companion(0.25, 0.5, 0.75, 1, -1), origin), 0.25);
  EXPECT_EQ(time_of(companion(0.25, 0.5, -0.75, -1, 1), origin), 0.25) << "0.5 is inside, too";
  EXPECT_EQ(time_of(companion(0.5, 0.5, -2, -1, 1), origin), 0.5) << "a double root";
  EXPECT_EQ(time_of(companion(0.5, 0.5, 0.5, 1, -1), origin), 0.5) << "a triple root";
  EXPECT_EQ(time_of(companion(1, 1, -2, -1, 1), origin), 1);
  EXPECT_EQ(time_of(companion(0, 0.5, -2, -1, 1), origin), 0) << "a corner passes the origin";
}

TEST(First_impact, of_a_cubic_is_rounded_to_the_nearest_double) {
  // t^3 = 1/2.
  const Moving_triangle moving{{Point(0, -1, 0), Point(0, 0, -1), Point(-0.5, 0, 0)},
                               {Point(1, -1, 0), Point(0, 1, -1), Point(-0.5, 0, 1)}};
  EXPECT_EQ(time_of(moving, origin), static_cast<double>(0.793700525984099737375852819636154130L));
}

TEST(First_impact, of_points_and_segments_is_found) {
  EXPECT_EQ(time_of(moving_point({-1, -1, -1}, {2, 2, 2}), origin), 1.0 / 3);
  EXPECT_EQ(time_of(moving_point({-1, -1, -1}, {2, 2, 2.5}), origin), infinity);
  EXPECT_EQ(time_of(moving_point({-1, -1, -1}, {3, 3, 3}), moving_point({1, 1, 1}, {-1, -1, -1})), 1.0 / 3);
  const Moving_triangle segment = standing({Point(0, 0, 0), Point(8, 8, 0), Point(4, 4, 0)});
  EXPECT_EQ(time_of(moving_point({3, 3, 1}, {3, 3, -3}), segment), 0.25);
  EXPECT_EQ(time_of(moving_point({3, 4, 1}, {3, 3, -3}), segment), infinity);
  EXPECT_EQ(time_of(moving_point({-3, -3, 0}, {9, 9, 0}), segment), 0.25) << "along the line";
  EXPECT_EQ(time_of(moving_point({-3, -3, 0}, {-1, -1, 0}), segment), infinity);
  EXPECT_EQ(time_of(moving_segment({-2, -2, 0}, {-1, -1, 0}, {-2, -2, 0}, {2, 2, 0}), segment), 1.0 / 3);
  EXPECT_EQ(time_of(moving_segment({0, 8, 1}, {8, 0, 1}, {0, 8, -1}, {8, 0, -1}), segment), 0.5);
  EXPECT_EQ(time_of(moving_segment({9, 9, 1}, {16, 16, 1}, {9, 9, -1}, {16, 16, -1}), segment), infinity);
  EXPECT_EQ(time_of(moving_segment({8, 8, 1}, {16, 16, 1}, {8, 8, -1}, {16, 16, -1}), segment), 0.5);
}

TEST(First_impact, in_a_common_plane_is_found) {
  const Triangle still{Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0)};
  const auto slide = [&](double from, double to, double lift) {
    const auto other = [](double x, double z) {
      return Triangle{Point(x, 1, z), Point(x + 4, 0, z), Point(x + 4, 4, z)};
    };
    Moving_triangle a = standing(still), b{other(from, 0), other(to, lift)};
    for (Point& p : a.end) p = Point(p.x(), p.y(), lift);
    return time_of(a, b);
  };
  for (const double lift : {0.0, 3.0, -0x1p-30}) {
    EXPECT_EQ(slide(5, 1, lift), 0.5);
    EXPECT_EQ(slide(4, 2.5, lift), 2.0 / 3);
    EXPECT_EQ(slide(4, 3, lift), 1);
    EXPECT_EQ(slide(4, std::nextafter(3, 4), lift), infinity);
  }
  // Edges in one line, from end to end.
  const Moving_triangle a = standing({Point(0, 0, 0), Point(1, 0, 0), Point(0, -1, 0)});
  const Moving_triangle b{{Point(2, 0, 0), Point(3, 0, 0), Point(3, 1, 0)},
                          {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0)}};
  EXPECT_EQ(time_of(a, b), 0.5);
}

TEST(First_impact, where_a_triangle_collapses_at_that_moment_is_found) {
  // The corners are in one line only at t = 1/2, and then the origin is among them.
  const Moving_triangle turning{{Point(-1, -1, 1), Point(1, -1, 1), Point(0, 3, 1)},
                                {Point(-1, 1, -1), Point(1, 1, -1), Point(0, -3, -1)}};
  EXPECT_EQ(time_of(turning, origin), 0.5);
  EXPECT_EQ(time_of(turning, moving_point({1, 0, 0}, {1, 0, 0})), 0.5);
  EXPECT_EQ(time_of(turning, moving_point({1.25, 0, 0}, {1.25, 0, 0})), infinity);
  // To a point.
  const Moving_triangle through{{Point(-1, -1, 1), Point(1, -1, 1), Point(0, 3, 1)},
                                {Point(1, 1, -1), Point(-1, 1, -1), Point(0, -3, -1)}};
  EXPECT_EQ(time_of(through, origin), 0.5);
  EXPECT_EQ(time_of(through, moving_point({0x1p-50, 0, 0}, {0x1p-50, 0, 0})), infinity);
}

TEST(First_impact, of_coordinates_of_any_size_is_found) {
  const double large = std::numeric_limits<double>::max();
  EXPECT_EQ(time_of(moving_point({-large, -large, -large}, {large, large, large}), origin), 0.5);
  EXPECT_EQ(time_of(moving_point({-large, 0, 0}, {large, 0, 0}), moving_point({large, 0, 0}, {-large, 0, 0})), 0.5);
  EXPECT_EQ(time_of(moving_point({-large, 0, 0}, {large, 1e-300, 0}), origin), infinity);
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(time_of(moving_point({-least, 0, 0}, {2 * least, 0, 0}), origin), 1.0 / 3);
  EXPECT_EQ(time_of(moving_point({-least, 0, 0}, {large, 0, 0}), origin), 0) << "rounded";
  EXPECT_EQ(time_of(moving_point({-least, 0, 0}, {1, 0, 0}), origin), least);
  EXPECT_EQ(time_of(moving_point({-1, 0, 0}, {least, 0, 0}), origin), 1) << "rounded";
  const Moving_triangle face = standing({Point(-large, -large, 0), Point(large, -large, 0), Point(0, large, 0)});
  EXPECT_EQ(time_of(face, moving_point({0, 0, large}, {0, 0, -large})), 0.5);
  EXPECT_EQ(time_of(face, moving_point({0, 0, least}, {0, 0, -least})), 0.5);
}

/// The time is one of contact, and there is none before it at any of some fractions.
/// @return whether the time is irrational, or has a large denominator
bool expect_first(const Moving_pair& pair, const std::optional<Impact_time>& time,
                  const std::vector<Rational>& fractions) {
  const auto& [a, b] = pair;
  for (const Rational& t : fractions) {
    // Between `low` and `high` there is no double, but the fraction there may be the time itself.
    if (time && t >= time->low()) break;
    EXPECT_FALSE(meet_at(a, b, t)) << "at " << CGAL::to_double(t);
  }
  if (!time) return false;
  if (time->low() == time->high()) {
    EXPECT_TRUE(meet_at(a, b, time->low()));
    return false;
  }
  EXPECT_FALSE(meet_at(a, b, time->low()));
  if (meet_at(a, b, simplest_between(time->low(), time->high()))) return false;
  EXPECT_LT(closest_points(rounded_at(a, time->value()), rounded_at(b, time->value())).distance, 1e-13);
  return true;
}

/// Conservative advancement stops at the time, or before it where the triangles are near for a while.
void expect_as_advancement(const Moving_pair& pair, const std::optional<Impact_time>& time, double distance) {
  const auto& [a, b] = pair;
  const auto near = advance(a, b, distance);
  EXPECT_TRUE(near || !time) << "the triangles never are near, but meet at " << time->value();
  if (!near) return;
  const double until = time ? time->value() : 1;
  EXPECT_LE(*near, until + 1e-9);
  for (const double part : {0.25, 0.5, 0.75}) {
    const double t = *near + part * (until - *near);
    EXPECT_LT(closest_points(rounded_at(a, t), rounded_at(b, t)).distance, 10 * distance) << "at " << t;
  }
}

TEST(First_impact, on_a_lattice_agrees_with_rational_sampling_and_conservative_advancement) {
  Moving_pairs pairs(1);
  const auto all = fractions(12);
  int none = 0, at_start = 0, rational = 0, irrational = 0;
  for (int i = 0; i < 4000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Moving_pair pair = pairs.on_a_lattice();
    const auto time = first_impact(pair.a, pair.b);
    const bool is_irrational = expect_first(pair, time, all);
    expect_as_advancement(pair, time, 1e-5);
    ++(!time ? none : time->value() == 0 ? at_start : is_irrational ? irrational : rational);
  }
  EXPECT_GT(none, 800);
  EXPECT_GT(at_start, 300);
  EXPECT_GT(rational, 400);
  EXPECT_GT(irrational, 300);
}

TEST(First_impact, anywhere_agrees_with_conservative_advancement) {
  Moving_pairs pairs(6);
  int met = 0, apart = 0;
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Moving_pair pair = pairs.anywhere();
    const auto time = first_impact(pair.a, pair.b);
    expect_as_advancement(pair, time, 1e-9);
    ++(time ? met : apart);
  }
  EXPECT_GT(met, 800);
  EXPECT_GT(apart, 800);
}

TEST(First_impact, is_the_same_for_any_order_of_triangles_and_corners) {
  Moving_pairs pairs(2);
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = pairs.on_a_lattice();
    const auto time = first_impact(a, b);
    EXPECT_EQ(first_impact(b, a), time);
    const auto permuted = [](const Moving_triangle& t, std::size_t p, std::size_t q, std::size_t r) {
      return Moving_triangle{{t.start[p], t.start[q], t.start[r]}, {t.end[p], t.end[q], t.end[r]}};
    };
    EXPECT_EQ(first_impact(permuted(a, 1, 2, 0), permuted(b, 1, 0, 2)), time);
    EXPECT_EQ(first_impact(permuted(b, 2, 1, 0), permuted(a, 0, 2, 1)), time);
  }
}

TEST(First_impact, is_the_same_after_exact_scaling_and_translation) {
  Moving_pairs pairs(3);
  const auto moved = [](const Moving_triangle& moving, double by) {
    return mapped(moving, [by](const Point& p) { return Point(p.x() + by, p.y() - by, p.z() + 3 * by); });
  };
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = pairs.on_a_lattice();
    const auto time = first_impact(a, b);
    for (const double factor : {0x1p-1074, 0x1p-700, 0x1p-40, 0x1p50, 0x1p700, 0x1p1018})
      EXPECT_EQ(first_impact(all_scaled(a, factor), all_scaled(b, factor)), time) << factor;
    for (const double by : {1.0, 0x1p20, 0x1p48}) EXPECT_EQ(first_impact(moved(a, by), moved(b, by)), time) << by;
    // A last digit more makes it another problem; its answer scales as well.
    const double factor = 1 + 0x1p-52;
    EXPECT_EQ(first_impact(all_scaled(a, 8 * factor), all_scaled(b, 8 * factor)),
              first_impact(all_scaled(a, factor), all_scaled(b, factor)));
  }
}

TEST(First_impact, of_half_the_motion_is_at_twice_the_time) {
  // From t = 0 to 1/2 the corners go half of their ways: the time doubles.
  Moving_pairs pairs(4);
  int halved = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = pairs.on_a_lattice();
    const auto half = [](const Moving_triangle& t) { return Moving_triangle{t.start, rounded_at(t, 0.5)}; };
    const auto time = first_impact(a, b), in_half = first_impact(half(a), half(b));
    EXPECT_EQ(in_half.has_value(), time && time->high() <= 0.5);
    if (!in_half) continue;
    ++halved;
    EXPECT_EQ(in_half->low(), 2 * time->low());
    EXPECT_EQ(in_half->value(), 2 * time->value());
  }
  EXPECT_GT(halved, 200);
}

TEST(First_impact, is_reported_unless_it_is_later_than_asked_for) {
  Moving_pairs pairs(5);
  int later = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [a, b] = pairs.on_a_lattice();
    const auto time = first_impact(a, b);
    if (!time) continue;
    EXPECT_EQ(first_impact(a, b, time->high()), time);
    if (time->high() == 0) continue;
    ++later;
    for (const double earlier : {std::nextafter(time->high(), 0.0), 0.75 * time->low()})
      EXPECT_EQ(first_impact(a, b, earlier), std::nullopt);
  }
  EXPECT_GT(later, 200);
}

TEST(Impact_time, is_compared_exactly) {
  // A point that goes from -n to m is at the origin at n / (n + m).
  const auto fraction = [](double n, double m) { return *first_impact(moving_point({-n, 0, 0}, {m, 0, 0}), origin); };
  const Impact_time third = fraction(1, 2);
  EXPECT_EQ(third, fraction(3, 6));
  EXPECT_EQ(third, fraction(0x1p-300, 0x1p-299));
  // Quotients of successive Fibonacci numbers differ by less than 2^-104.
  const double f75 = 2111485077978050, f76 = 3416454622906707, f77 = 5527939700884757;
  const Impact_time below = fraction(f76, f75), above = fraction(f77, f76);
  EXPECT_EQ(above.low(), below.low());
  EXPECT_LT(below, above);
  EXPECT_GT(above, below);
  EXPECT_EQ(third.value(), 1.0 / 3);
  EXPECT_EQ(fraction(1, 1).low(), fraction(1, 1).high());
  EXPECT_LT(Impact_time(), third);
  // The square root of a half, as a root of two polynomials.
  const auto root = [](double factor) {
    const Moving_triangle a = standing({Point(-1, 0, 0), Point(1, 0, 0), Point(0, 0, -5)});
    return *first_impact(a, {{Point(0, -1, 0), Point(0, 0, factor), Point(0, -1, 10)},
                             {Point(0, -1, -2 * factor), Point(0, 1, factor), Point(0, -1, 10)}});
  };
  EXPECT_EQ(root(1), root(0.75));
  // Pell's equation: p^2 = 2 q^2 +- 1 gives fractions q / p on either side of the root, within 1 / p^2.
  const double p1 = 1855077841, q1 = 1311738121, p2 = 4478554083, q2 = 3166815962;
  const Impact_time one = fraction(q1, p1 - q1), two = fraction(q2, p2 - q2);
  EXPECT_EQ(one.low(), root(1).low());
  EXPECT_EQ(two.low(), root(1).low());
  EXPECT_NE(one < root(1), two < root(1));
}

TEST(Impact_time, of_fractions_is_rounded_and_ordered_like_rational_numbers) {
  std::mt19937_64 random(1);
  const auto any_number = [&random] {
    constexpr std::array exponents{-1050, -1000, -500, -52, -2, -1, 0, 1, 52, 500, 900};
    const int exponent = exponents[random() % exponents.size()];
    const auto bits = 1 + random() % 53;
    return std::ldexp(static_cast<double>(1 + random() % (1ULL << bits)), exponent);
  };
  struct Fraction {
    Rational exact;
    Impact_time time;
  };
  // A point that goes from -n to m is at the origin at n / (n + m).
  const auto fraction = [](double n, double m) {
    return Fraction{Rational(n) / (Rational(n) + Rational(m)),
                    *first_impact(moving_point({-n, 0, 0}, {m, 0, 0}), origin)};
  };
  const auto check = [](const Fraction& checked) {
    const auto& [exact, time] = checked;
    const Rational low(time.low()), high(time.high()), value(time.value());
    EXPECT_LE(low, exact);
    EXPECT_LE(exact, high);
    EXPECT_EQ(time.high(), low == exact ? time.low() : std::nextafter(time.low(), 2.0));
    EXPECT_EQ(value, high - exact < exact - low ? high : low);
  };
  int different = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    const double n = any_number(), m = any_number();
    const Fraction a = fraction(n, m), b = fraction(std::nextafter(n, infinity), m), c = fraction(any_number(), m);
    for (const Fraction* one : {&a, &b, &c}) {
      check(*one);
      for (const Fraction* other : {&a, &b, &c}) {
        EXPECT_EQ(one->time < other->time, one->exact < other->exact);
        EXPECT_EQ(one->time == other->time, one->exact == other->exact);
      }
    }
    different += a.time.low() == b.time.low() ? 0 : 1;
  }
  EXPECT_GT(different, 50);
  EXPECT_LT(different, 350);
}

/// Expects of all pairs, and of the first impacts of all as limits, that nothing later is found and nothing is missed.
/// @return how many first impacts were earlier than a limit, and how many the same
std::array<int, 2> expect_limits_hold(const std::vector<Moving_pair>& pairs) {
  std::vector<Impact_time> limits{Impact_time()};
  for (const auto& [a, b] : pairs)
    if (const auto time = first_impact(a, b)) limits.push_back(*time);
  int earlier = 0, equal = 0;
  for (const auto& [a, b] : pairs) {
    const auto first = first_impact(a, b);
    for (const Impact_time& limit : limits) {
      EXPECT_EQ(first_impact_before(limit, a, b), first && *first < limit ? first : std::nullopt);
      EXPECT_EQ(first_impact_until(limit, a, b), first && *first <= limit ? first : std::nullopt);
      earlier += first && *first < limit ? 1 : 0;
      equal += first && *first == limit ? 1 : 0;
    }
  }
  return {earlier, equal};
}

TEST(First_impact_before_or_until, is_the_first_impact_or_none_if_that_is_later) {
  Moving_pairs pairs(7);
  std::vector<Moving_pair> asked;
  for (int i = 0; i < 60; ++i)
    for (const Moving_pair& pair : {pairs.on_a_lattice(), pairs.beside_a_lattice(), pairs.anywhere()})
      asked.push_back(pair);
  const auto [earlier, equal] = expect_limits_hold(asked);
  EXPECT_GT(earlier, 1000);
  EXPECT_GT(equal, 200);
}

TEST(First_impact_before_or_until, tells_times_apart_that_only_rounding_keeps_from_being_the_same) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto turned = [&](double x, double y, double z) { return Point(c * x - s * z, y, s * x + c * z); };
  std::vector<Moving_pair> landing;
  for (int i = 0; i < 40; ++i) {
    // One lies in a slope, the other falls on it.
    Moving_pair pair;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      pair.a.start[corner] = pair.a.end[corner] = turned(unit(random), unit(random), 0);
      const double x = unit(random), y = unit(random);
      pair.b.start[corner] = turned(x, y, 1);
      pair.b.end[corner] = turned(x, y, -1);
    }
    landing.push_back(pair);
  }
  const auto [earlier, equal] = expect_limits_hold(landing);
  EXPECT_GT(earlier, 100);
  EXPECT_GT(equal, 10);
}

TEST(First_impact_before_or_until, of_coordinates_whose_volumes_nearly_overflow) {
  const Moving_triangle floor = standing({Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)});
  const auto limit = first_impact(floor, {{Point(0, 0, 1), Point(1, 0, 1), Point(0, 1, 1)},
                                          {Point(0, 0, -1.1), Point(1, 0, -1.1), Point(0, 1, -1.1)}});
  ASSERT_TRUE(limit);
  for (const double m : {1e90, 1e94, 1e97, 9e99, 1e103}) {
    const Moving_triangle rising{{Point(m, 0, -1e-9 * m), Point(-m, m, -1e-9 * m), Point(-m, -m, -1e-9 * m)},
                                 {Point(m, 0, m), Point(-m, m, m), Point(-m, -m, m)}};
    const Moving_triangle still =
        standing({Point(0, 0, 0), Point(.1 * m, .1 * m, .5 * m), Point(-.1 * m, .1 * m, .5 * m)});
    const auto first = first_impact(rising, still);
    ASSERT_TRUE(first && *first < *limit) << m;
    EXPECT_EQ(first_impact_before(*limit, rising, still), first) << m;
    EXPECT_EQ(first_impact_until(*limit, rising, still), first) << m;
  }
}

TEST(First_impact_before_or_until, at_times_below_the_smallest_double) {
  // A corner meets a face at t = 2^-1075, where it has moved by 2^-1074, which is how far away it was.
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const Moving_triangle still = standing({Point(-1, -1, 0), Point(1, -1, 0), Point(0, 1, 0)});
  const Moving_triangle point = moving_point({0, 0, least}, {0, 0, -2});
  const auto time = first_impact(still, point);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->low(), 0);
  EXPECT_EQ(time->high(), least);
  EXPECT_EQ(first_impact_until(*time, still, point), time);
  EXPECT_EQ(first_impact_before(*time, still, point), std::nullopt);
  // One that is half as fast comes later, one that is twice as fast earlier.
  EXPECT_EQ(first_impact_until(*time, still, moving_point({0, 0, least}, {0, 0, -1})), std::nullopt);
  EXPECT_TRUE(first_impact_before(*time, still, moving_point({0, 0, least}, {0, 0, -4})));
}

/// Three planes through the origin that the faces' corners cross at times 2^-2098 apart: two thousand halvings tell
/// their roots from each other.
TEST(First_impact, at_times_that_only_thousands_of_digits_tell_apart_needs_little_stack) {
  constexpr double huge = 0x1p1020, tiny = 0x1p-1074;
  Moving_triangle moving, still;
  moving.start = {Point(-huge, 0, 0), Point(0, -huge, 0), Point(0, 0, -huge)};
  moving.end = {Point(2 * huge, 0, 0), Point(0, 2 * huge, 0), Point(0, 0, 2 * huge)};
  still.start = still.end = {Point(0, tiny, 0), Point(huge, huge, huge), Point(huge, huge, 0)};
  struct Question {
    const Moving_triangle &a, &b;
    std::optional<Impact_time> answer = {};
  } question{moving, still};
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, std::size_t{256} << 10U), 0);
  pthread_t thread;
  ASSERT_EQ(pthread_create(
                &thread, &attributes,
                [](void* asked) -> void* {
                  auto& now = *static_cast<Question*>(asked);
                  now.answer = first_impact(now.a, now.b);
                  return nullptr;
                },
                &question),
            0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  const auto swapped = first_impact(still, moving);
  ASSERT_EQ(question.answer.has_value(), swapped.has_value());
  EXPECT_TRUE(!swapped || *question.answer == *swapped);
}

}  // namespace
}  // namespace lodestone
