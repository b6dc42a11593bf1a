// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/exact_crossing.h"

#include <cmath>
#include <limits>
#include <optional>

namespace lodestone {

namespace {

/// Exact sums and products, but no quotients.
using Ring_kernel = Kernel::Exact_kernel_rt;
using Ring_number = Ring_kernel::FT;

/// A quotient of exact numbers, as far as doubles tell it.
class Share {
 public:
  Share(const Ring_number& rise, const Ring_number& whole)
      : rise_(rise), whole_(whole), divisor_(CGAL::to_double(whole)), rounded_(CGAL::to_double(rise) / divisor_) {}

  /// The nearest double to start + share * length, of two such the one nearer to zero; none if doubles overflow.
  std::optional<double> along(double start, const Ring_number& length) const {
    const Ring_number way = length * rise_;
    double best = start + CGAL::to_double(length) * rounded_;
    for (int correction = 0; correction < 4 && std::isfinite(best); ++correction) {
      const Ring_number rest = way - (Ring_number(best) - Ring_number(start)) * whole_;
      const double beyond = CGAL::to_double(rest) / divisor_;
      if (surely_nearest(best, beyond)) return best;
      const double next = std::nextafter(best, CGAL::sign(rest) == CGAL::sign(whole_) ? infinity : -infinity);
      if (!std::isfinite(next)) return {};
      switch (CGAL::compare(CGAL::abs(rest + rest), CGAL::abs((Ring_number(next) - Ring_number(best)) * whole_))) {
        case CGAL::SMALLER:
          return best + 0.0;  // adding zero makes -0 zero
        case CGAL::EQUAL:
          return (std::abs(next) < std::abs(best) ? next : best) + 0.0;
        case CGAL::LARGER:
          best = best + beyond == best ? next : best + beyond;
      }
    }
    return {};
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// @param beyond  how far the number is beyond x; known to some digits where half a step of x is
  bool surely_nearest(double x, double beyond) const {
    const double size = std::abs(x), half_a_step = (size - std::nextafter(size, 0.0)) / 2;
    // The divisor too must be a normal number, or it would be known to no digits.
    const double told = std::abs(half_a_step * divisor_);
    return std::abs(divisor_) > 0x1p-1000 && told > 0x1p-1000 && told < infinity &&
           std::abs(beyond) < 0.99 * half_a_step;
  }

  const Ring_number &rise_, &whole_;
  double divisor_, rounded_;
};

/// CGAL's own conversion may be off in the last digits. Without GMP it is NaN where numerator and denominator are too
/// large for doubles; the interval around the number is not.
double nearest_double(const CGAL::Exact_rational& number) {
  using Number = CGAL::Exact_rational;
  const auto [low, high] = CGAL::to_interval(number);
  double best = std::isfinite(low) ? low : high;
  const auto is_nearer = [&](double other) {
    return std::isfinite(other) && CGAL::abs(Number(number - Number(other))) < CGAL::abs(Number(number - Number(best)));
  };
  for (const double end : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()})
    while (is_nearer(std::nextafter(best, end))) best = std::nextafter(best, end);
  return best;
}

/// The crossing of an edge and a plane: p + edge * rise / whole.
template <class K>
struct Exact_crossing {
  Exact_crossing(const Point& from, const Point& to, const Triangle& plane) : p(exact(from)), edge(exact(to) - p) {
    const auto corner = exact(plane[0]);
    const auto normal = CGAL::cross_product(exact(plane[1]) - corner, exact(plane[2]) - corner);
    rise = normal * (corner - p);
    whole = normal * edge;
  }
  static typename K::Point_3 exact(const Point& point) { return {point.x(), point.y(), point.z()}; }

  typename K::Point_3 p;
  typename K::Vector_3 edge;
  typename K::FT rise, whole;
};

}  // namespace

Point exact_crossing(const Point& from, const Point& to, const Triangle& plane) {
  const Exact_crossing<Ring_kernel> crossing(from, to, plane);
  const Share share(crossing.rise, crossing.whole);
  const auto x = share.along(from.x(), crossing.edge.x()), y = share.along(from.y(), crossing.edge.y()),
             z = share.along(from.z(), crossing.edge.z());
  if (x && y && z) return {*x, *y, *z};
  const Exact_crossing<Rational_kernel> in_rationals(from, to, plane);
  return nearest_point(in_rationals.p + in_rationals.edge * (in_rationals.rise / in_rationals.whole));
}

Rational_kernel::Point_3 rational(const Point& p) { return Exact_crossing<Rational_kernel>::exact(p); }

Point nearest_point(const Rational_kernel::Point_3& p) {
  return {nearest_double(p.x()), nearest_double(p.y()), nearest_double(p.z())};
}

}  // namespace lodestone
