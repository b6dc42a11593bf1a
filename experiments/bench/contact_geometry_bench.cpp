// SPDX-License-Identifier: GPL-3.0-or-later
// What contact points and normals add to a frame in mode `exact`, and what points take where faces touch.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <benchmark/benchmark.h>

#include <array>
#include <deque>
#include <vector>

#include "bench/frame_player.h"
#include "lodestone/detector.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Frames of one scene: all face pairs alone, with points, and with points and normals take turns on each frame.
///
/// Reported time: the frame with points and normals. The counters are medians over the frames that have contacts;
/// `over_pairs` is the ratio of the last to the first.
void contact_geometry(benchmark::State& state, const std::string& scene_name) {
  Frame_player player(scene_name);
  std::deque<Detector<>> detectors;
  for (const auto& [points, normals] : {std::pair{false, false}, {true, false}, {true, true}}) {
    detectors.emplace_back(Detector_options{
        .mode = Mode::exact, .contacts = Contact_query::all, .contact_points = points, .contact_normals = normals});
    for (auto& object : player.scene().objects) detectors.back().add(std::as_const(object.mesh));
  }
  player.next();
  for (auto& detector : detectors) detector.detect();

  std::array<std::vector<double>, 3> seconds;
  std::vector<double> contacts;
  for (auto _ : state) {
    player.next();
    std::array<double, 3> frame_seconds{};
    std::size_t found = 0;
    for (std::size_t i = 0; i < detectors.size(); ++i) {
      const auto& statistics = detectors[i].detect().statistics;
      frame_seconds[i] = statistics.seconds.refit + statistics.seconds.broad_phase + statistics.seconds.confirmation;
      found = statistics.contacts;
    }
    state.SetIterationTime(frame_seconds.back());
    if (found == 0) continue;
    for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i].push_back(frame_seconds[i]);
    contacts.push_back(static_cast<double>(found));
  }
  state.counters["contacts"] = median(contacts);
  state.counters["pairs_us"] = 1e6 * median(seconds[0]);
  state.counters["points_us"] = 1e6 * median(seconds[1]);
  state.counters["normals_us"] = 1e6 * median(seconds[2]);
  state.counters["over_pairs"] = median(seconds[2]) / median(seconds[0]);
}

BENCHMARK_CAPTURE(contact_geometry, paper_pair, "teapot_sphere_1")->UseManualTime()->Iterations(600);
BENCHMARK_CAPTURE(contact_geometry, spheres_5k, "spheres_5k")->UseManualTime()->Iterations(400);
BENCHMARK_CAPTURE(contact_geometry, spheres_50k, "spheres_50k")->UseManualTime()->Iterations(400);
BENCHMARK_CAPTURE(contact_geometry, torus_knots_20k, "torus_knots_20k")->UseManualTime()->Iterations(400);
BENCHMARK_CAPTURE(contact_geometry, bodies_20_5k, "bodies_20_5k")->UseManualTime()->Iterations(200);

/// The triangles of a sheet of 8 x 8 squares; `place` maps (u, v), from 0 to 1, to a point.
template <class Place>
std::vector<Triangle> sheet(const Place& place) {
  constexpr int squares = 8;
  const auto corner = [&place](int i, int j) { return place(double{1} * i / squares, double{1} * j / squares); };
  std::vector<Triangle> triangles;
  for (int i = 0; i < squares; ++i)
    for (int j = 0; j < squares; ++j) {
      triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return triangles;
}

std::vector<Triangle_pair> touching_pairs(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  std::vector<Triangle_pair> pairs;
  for (const Triangle& s : a)
    for (const Triangle& t : b)
      if (triangles_intersect(s, t)) pairs.push_back({s, t});
  return pairs;
}

using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;

/// Turns what `CGAL::intersection` returns into points. CGAL converts the midpoint of an interval, which may be off in
/// the last digits, unless the exact number is asked for.
struct Cgal_points {
  bool exactly;
  Intersection_points& points;

  void operator()(const Epeck::Point_3& p) const {
    const auto number = [&](const Epeck::FT& x) {
      if (exactly) x.exact();
      return CGAL::to_double(x);
    };
    points.emplace_back(number(p.x()), number(p.y()), number(p.z()));
  }
  void operator()(const Epeck::Segment_3& s) const {
    (*this)(s.source());
    (*this)(s.target());
  }
  void operator()(const Epeck::Triangle_3& t) const {
    for (int i = 0; i < 3; ++i) (*this)(t[i]);
  }
  void operator()(const std::vector<Epeck::Point_3>& polygon) const {
    for (const auto& p : polygon) (*this)(p);
  }
};

Intersection_points cgal_intersection(const Triangle_pair& pair, bool exactly) {
  const auto exact = [](const Triangle& t) {
    const auto point = [&t](std::size_t i) { return Epeck::Point_3(t[i].x(), t[i].y(), t[i].z()); };
    return Epeck::Triangle_3(point(0), point(1), point(2));
  };
  Intersection_points points;
  if (const auto shape = CGAL::intersection(exact(pair.a), exact(pair.b)))
    boost::apply_visitor(Cgal_points{exactly, points}, *shape);
  return points;
}

/// Where pairs of faces meet, all of which touch or overlap in a plane; in turns with CGAL's exact constructions.
/// Reported time: all of it. The counters are medians per pair.
void touching_points(benchmark::State& state, const std::vector<Triangle_pair>& pairs) {
  std::vector<Intersection_points> points(pairs.size()), of_cgal(pairs.size());
  std::array<std::vector<double>, 3> seconds;
  for (auto _ : state) {
    Lap_timer timer;
    triangle_intersections(pairs, points);
    seconds[0].push_back(timer.lap());
    for (const bool exactly : {false, true}) {
      for (std::size_t i = 0; i < pairs.size(); ++i) of_cgal[i] = cgal_intersection(pairs[i], exactly);
      seconds[exactly ? 2 : 1].push_back(timer.lap());
    }
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (points[i].size() != of_cgal[i].size()) state.SkipWithError("CGAL finds another number of points");
  }
  const double count = static_cast<double>(pairs.size());
  state.counters["pairs"] = count;
  state.counters["us"] = 1e6 * median(seconds[0]) / count;
  state.counters["cgal_us"] = 1e6 * median(seconds[1]) / count;
  state.counters["cgal_over"] = median(seconds[1]) / median(seconds[0]);
  state.counters["exact_us"] = 1e6 * median(seconds[2]) / count;
  state.counters["exact_over"] = median(seconds[2]) / median(seconds[0]);
}

Point flat(double u, double v) { return {u, v, 0}; }
/// In a plane but for rounding.
Point on_a_slope(double u, double v) { return {0.8 * u - 0.36 * v, 0.6 * u + 0.48 * v, 0.8 * v}; }

BENCHMARK_CAPTURE(touching_points, same_sheet, touching_pairs(sheet(flat), sheet(flat)))->Iterations(20);
BENCHMARK_CAPTURE(touching_points, shifted_in_its_plane, touching_pairs(sheet(flat), sheet([](double u, double v) {
                                                                          return Point(u + 0.0731, v + 0.0417, 0);
                                                                        })))
    ->Iterations(20);
BENCHMARK_CAPTURE(touching_points, shifted_on_a_slope, touching_pairs(sheet(on_a_slope), sheet([](double u, double v) {
                                                                        return on_a_slope(u + 0.0731, v + 0.0417);
                                                                      })))
    ->Iterations(20);
BENCHMARK_CAPTURE(touching_points, standing_on_it,
                  touching_pairs(sheet(flat), sheet([](double u, double v) { return Point(0.1 + 0.3 * u, v, u); })))
    ->Iterations(20);

}  // namespace

}  // namespace lodestone
