// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "io/shapes/shape_checks.h"
#include "io/shapes/teapot_patches.h"
#include "lodestone/io/shapes/shapes.h"

namespace lodestone {

namespace {

/// Control points, row by row, four to a row.
using Bezier_patch = std::array<Point, 16>;
using Weights = std::array<double, 4>;

/// Reads the numbers of a text in order, and keeps the line number for error messages.
class Number_reader {
 public:
  Number_reader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  template <class Number>
  Number next(std::string_view what) {
    skip_space();
    Number number{};
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
    const auto length = static_cast<std::size_t>(end - text_.data());
    if (error != std::errc{} || (length < text_.size() && !is_space(text_[length])))
      fail(fmt::format("expected {}", what));
    text_.remove_prefix(length);
    return number;
  }

  void expect_end() {
    skip_space();
    if (!text_.empty()) fail("expected the end after the last point");
  }

  std::size_t characters_left() const { return text_.size(); }

  [[noreturn]] void fail(std::string_view cause) const {
    throw Bad_mesh(fmt::format("{}:{}: {}", name_, line_, cause));
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  void skip_space() {
    for (; !text_.empty() && is_space(text_.front()); text_.remove_prefix(1))
      if (text_.front() == '\n') ++line_;
  }

  std::string_view text_;
  std::string_view name_;
  std::size_t line_ = 1;
};

std::vector<std::size_t> read_point_numbers(Number_reader& reader, std::size_t patches, std::size_t points) {
  std::vector<std::size_t> numbers(16 * patches);
  for (std::size_t& number : numbers) {
    number = reader.next<std::size_t>("a point number");
    if (number >= points) reader.fail(fmt::format("patch refers to point {} of {}", number, points));
  }
  return numbers;
}

std::vector<Point> read_points(Number_reader& reader, std::size_t count) {
  // Larger coordinates could overflow in the evaluation.
  constexpr double largest = 1e100;
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 3> p{};
    for (double& coordinate : p) {
      coordinate = reader.next<double>("a coordinate");
      if (!(std::abs(coordinate) <= largest))
        reader.fail(fmt::format("coordinate {} is not between -1e100 and 1e100", coordinate));
    }
    points.emplace_back(p[0], p[1], p[2]);
  }
  return points;
}

std::vector<Bezier_patch> read_patches(std::string_view text, std::string_view name) {
  Number_reader reader(text, name);
  const auto patches = reader.next<std::size_t>("the number of patches");
  const auto points = reader.next<std::size_t>("the number of points");
  if (patches == 0) reader.fail("no patch");
  // Every number takes at least two characters, so larger counts are wrong and would only waste memory.
  if (patches > reader.characters_left() / 32 || points > reader.characters_left() / 6)
    reader.fail(fmt::format("announces {} patches and {} points, more than the text can hold", patches, points));

  const auto numbers = read_point_numbers(reader, patches, points);
  const auto positions = read_points(reader, points);
  reader.expect_end();

  std::vector<Bezier_patch> result(patches);
  for (std::size_t i = 0; i < numbers.size(); ++i) result[i / 16][i % 16] = positions[numbers[i]];
  return result;
}

/// Cubic Bernstein polynomials at i / n. Computed from integers, so that the weights at (n - i) / n are bitwise the
/// same, reversed.
Weights bernstein(std::size_t i, std::size_t n) {
  const double a = double(n - i);
  const double b = double(i);
  const double whole = double(n) * double(n) * double(n);
  return {a * a * a / whole, 3 * (a * a * b) / whole, 3 * (b * b * a) / whole, b * b * b / whole};
}

/// Weighted mean of four numbers. The outer and inner pairs are added separately, so that reversing both orders changes
/// no bit. Four equal numbers are returned unchanged, since the sum of the weights is rounded: a collapsed edge stays a
/// point.
double weighted(const Weights& w, double p0, double p1, double p2, double p3) {
  if (p0 == p1 && p1 == p2 && p2 == p3) return p0;
  return (w[0] * p0 + w[3] * p3) + (w[1] * p1 + w[2] * p2);
}

/// On a border one set of weights is (1, 0, 0, 0) or its reverse, so only the border's points affect the result.
Point point_of(const Bezier_patch& patch, const Weights& u, const Weights& v) {
  const auto coordinate = [&](int axis) {
    const auto row = [&](std::size_t r) {
      const auto* p = &patch[4 * r];
      return weighted(v, p[0][axis], p[1][axis], p[2][axis], p[3][axis]);
    };
    return weighted(u, row(0), row(1), row(2), row(3));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

void add_unless_collapsed(std::vector<detail::Triangle_numbers>& triangles, const detail::Triangle_numbers& t) {
  if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
}

void cut_patch(const Bezier_patch& patch, const Patch_grid& grid, detail::Welded_points& points,
               std::vector<detail::Triangle_numbers>& triangles) {
  const std::size_t width = grid.v + 1;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i <= grid.u; ++i)
    for (std::size_t j = 0; j <= grid.v; ++j)
      number.push_back(points.number(point_of(patch, bernstein(i, grid.u), bernstein(j, grid.v))));
  for (std::size_t i = 0; i < grid.u; ++i)
    for (std::size_t j = 0; j < grid.v; ++j) {
      const std::size_t corner = i * width + j;
      add_unless_collapsed(triangles, {number[corner], number[corner + 1], number[corner + width + 1]});
      add_unless_collapsed(triangles, {number[corner], number[corner + width + 1], number[corner + width]});
    }
}

}  // namespace

Surface_mesh bezier_patches(std::string_view text, std::string_view name, const Patch_grid& grid) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  detail::check_count(name, "u", grid.u, 1);
  detail::check_count(name, "v", grid.v, 1);
  const std::vector<Bezier_patch> patches = read_patches(text, name);
  detail::check_faces(name, 2 * patches.size(), grid.u, grid.v);

  detail::Welded_points points;
  std::vector<detail::Triangle_numbers> triangles;
  for (const Bezier_patch& patch : patches) cut_patch(patch, grid, points, triangles);
  if (triangles.empty()) throw Bad_mesh(fmt::format("{}: every patch is a point or a line", name));

  std::vector<Point> positions = points.points();
  PMP::orient_polygon_soup(positions, triangles);
  Surface_mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(positions, triangles, mesh);
  return mesh;
}

Surface_mesh teapot(const Patch_grid& grid) { return bezier_patches(teapot_patches, "teapot", grid); }

}  // namespace lodestone
