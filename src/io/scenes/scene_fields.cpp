// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/scene_fields.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "io/shapes/directions.h"
#include "lodestone/io/shapes/shapes.h"

namespace lodestone::detail {

namespace {

using Vector = Kernel::Vector_3;
using Transformation = Kernel::Aff_transformation_3;

// Far above what an experiment needs, and small enough that a scene of a few lines cannot exhaust memory.
constexpr std::size_t most_patch_cuts = 200;
constexpr std::size_t most_cuts = 2000;
constexpr std::size_t most_frequency = 400;
constexpr std::size_t most_turns = 100;
constexpr std::size_t most_steps = 100;
constexpr std::size_t most_way_points = 100'000;

// ---- Shapes ----

Surface_mesh read_teapot(const Json_value& value) {
  value.expect_keys({"u", "v"});
  const Patch_grid grid;
  return teapot({.u = value.count("u", 1, most_patch_cuts, grid.u), .v = value.count("v", 1, most_patch_cuts, grid.v)});
}

Surface_mesh read_uv_sphere(const Json_value& value) {
  value.expect_keys({"slices", "stacks"});
  return uv_sphere(value.at("slices").count(3, most_cuts), value.at("stacks").count(2, most_cuts));
}

Surface_mesh read_icosphere(const Json_value& value) {
  value.expect_keys({"frequency"});
  return icosphere(value.at("frequency").count(1, most_frequency));
}

Surface_mesh read_torus_knot(const Json_value& value) {
  value.expect_keys({"p", "q", "radius", "tube", "segments", "sides"});
  const Torus_knot_options knot;
  return torus_knot({.p = value.count("p", 1, most_turns, knot.p),
                     .q = value.count("q", 0, most_turns, knot.q),
                     .radius = value.number("radius", knot.radius),
                     .tube = value.number("tube", knot.tube),
                     .segments = value.count("segments", 3, most_cuts, knot.segments),
                     .sides = value.count("sides", 3, most_cuts, knot.sides)});
}

Surface_mesh read_cloth(const Json_value& value) {
  value.expect_keys({"columns", "rows"});
  return cloth(value.at("columns").count(1, most_cuts), value.at("rows").count(1, most_cuts));
}

// ---- Deformations ----

Wobble read_wobble(const Json_value& value) {
  value.expect_keys({"amplitude", "waves", "period", "phase"});
  const Wobble wobble;
  return {.amplitude = value.number("amplitude", wobble.amplitude),
          .waves = value.number("waves", wobble.waves),
          .period = value.number("period", wobble.period),
          .phase = value.number("phase", wobble.phase)};
}

Bend read_bend(const Json_value& value) {
  value.expect_keys({"axis", "towards", "degrees", "period", "phase"});
  const Bend bend;
  return {.axis = value.vector("axis", bend.axis),
          .towards = value.vector("towards", bend.towards),
          .degrees = value.number("degrees", bend.degrees),
          .period = value.number("period", bend.period),
          .phase = value.number("phase", bend.phase)};
}

Twist read_twist(const Json_value& value) {
  value.expect_keys({"axis", "degrees", "period", "phase"});
  const Twist twist;
  return {.axis = value.vector("axis", twist.axis),
          .degrees = value.number("degrees", twist.degrees),
          .period = value.number("period", twist.period),
          .phase = value.number("phase", twist.phase)};
}

Inflate read_inflate(const Json_value& value) {
  value.expect_keys({"factor", "frames"});
  const Inflate inflate;
  return {.factor = value.number("factor", inflate.factor), .frames = value.number("frames", inflate.frames)};
}

Way_point read_way_point(const Json_value& value) {
  value.expect_keys({"frame", "at"});
  return {.frame = value.at("frame").number(), .at = value.at("at").vector()};
}

Path read_path(const Json_value& value) {
  const std::string word = value.word({"linear", "smooth", "closed"});
  if (word == "linear") return Path::linear;
  return word == "smooth" ? Path::smooth : Path::closed;
}

Travel read_travel(const Json_value& value) {
  value.expect_keys({"way_points", "path"});
  Travel travel;
  for (const Json_value& element : value.at("way_points").elements(most_way_points))
    travel.way_points.push_back(read_way_point(element));
  if (const auto path = value.find("path")) travel.path = read_path(*path);
  return travel;
}

Spin read_spin(const Json_value& value) {
  value.expect_keys({"axis", "degrees_per_frame"});
  const Spin spin;
  return {.axis = value.vector("axis", spin.axis),
          .degrees_per_frame = value.number("degrees_per_frame", spin.degrees_per_frame)};
}

Deformation read_fields(const std::string& kind, const Json_value& value) {
  if (kind == "wobble") return read_wobble(value);
  if (kind == "bend") return read_bend(value);
  if (kind == "twist") return read_twist(value);
  if (kind == "inflate") return read_inflate(value);
  if (kind == "travel") return read_travel(value);
  return read_spin(value);
}

Deformation read_deformation(const Json_value& value) {
  const std::string kind = value.expect_one_key({"wobble", "bend", "twist", "inflate", "travel", "spin"});
  const Json_value fields = value.at(kind);
  Deformation deformation = read_fields(kind, fields);
  fields.checked([&] { check(deformation); });
  return deformation;
}

// ---- Placement ----

double read_factor(const Json_value& value) {
  const double factor = value.number();
  if (!(factor > 0)) value.fail(fmt::format("{} is not > 0", factor));
  return factor;
}

Transformation read_scale(const Json_value& value) {
  if (!value.is_array()) {
    const double factor = read_factor(value);
    return {factor, 0, 0, 0, factor, 0, 0, 0, factor};
  }
  value.vector();  // Refuses anything but three numbers.
  const auto factors = value.elements(3);
  return {read_factor(factors[0]), 0, 0, 0, read_factor(factors[1]), 0, 0, 0, read_factor(factors[2])};
}

Transformation read_rotation(const Json_value& value) {
  value.expect_keys({"axis", "degrees"});
  const Vector a = unit(read_direction(value.at("axis")));
  const double s = std::sin(value.at("degrees").number() * degree);
  const double c = std::cos(value.at("degrees").number() * degree);
  const auto entry = [&](int i, int j) { return (1 - c) * a[i] * a[j]; };
  return {entry(0, 0) + c,         entry(0, 1) - s * a.z(), entry(0, 2) + s * a.y(),
          entry(1, 0) + s * a.z(), entry(1, 1) + c,         entry(1, 2) - s * a.x(),
          entry(2, 0) - s * a.y(), entry(2, 1) + s * a.x(), entry(2, 2) + c};
}

}  // namespace

Surface_mesh read_shape(const Json_value& value) {
  const std::string kind = value.expect_one_key({"teapot", "uv_sphere", "icosphere", "torus_knot", "cloth"});
  const Json_value fields = value.at(kind);
  return fields.checked([&] {
    if (kind == "teapot") return read_teapot(fields);
    if (kind == "uv_sphere") return read_uv_sphere(fields);
    if (kind == "icosphere") return read_icosphere(fields);
    if (kind == "torus_knot") return read_torus_knot(fields);
    return read_cloth(fields);
  });
}

std::vector<Deformation> read_deformations(const Json_value& value) {
  std::vector<Deformation> result;
  for (const Json_value& element : value.elements(most_steps)) result.push_back(read_deformation(element));
  return result;
}

Transformation read_placement(const Json_value& value) {
  value.expect_keys({"scale", "rotate", "translate"});
  Transformation result(CGAL::IDENTITY);
  if (const auto scale = value.find("scale")) result = read_scale(*scale) * result;
  if (const auto rotate = value.find("rotate")) result = read_rotation(*rotate) * result;
  if (const auto translate = value.find("translate"))
    result = Transformation(CGAL::TRANSLATION, translate->vector()) * result;
  return result;
}

Vector read_direction(const Json_value& value) {
  const Vector direction = value.vector();
  if (!is_direction(direction)) value.fail("a direction must not be zero");
  return direction;
}

}  // namespace lodestone::detail
