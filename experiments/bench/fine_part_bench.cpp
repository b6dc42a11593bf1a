// SPDX-License-Identifier: GPL-3.0-or-later
// A ball of many faces above a floor of two that is up to a hundred million times as wide, beside the ball alone.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

constexpr std::uint32_t frequency = 64;  // 81 920 faces

Surface_mesh ball(double size, double x) {
  Surface_mesh mesh = icosphere(frequency);
  for (Point& p : mesh.points()) p = Point(size * (p.x() + x), size * (p.y() + 0.013), size * (p.z() + 0.31));
  return mesh;
}

/// Two balls that cross; the first has a floor below it, the second a ceiling above it.
using Pair = std::array<Surface_mesh, 2>;
Pair crossing_balls(double size, bool in_hall) {
  Pair pair{ball(size, 0), ball(size, 1.9)};
  for (const std::size_t side : {0, 1}) {
    if (!in_hall) break;
    Surface_mesh& mesh = pair[side];
    const double z = side == 0 ? -3 : 3;
    const auto p = mesh.add_vertex(Point(-2, -2, z)), q = mesh.add_vertex(Point(2, -2, z));
    const auto r = mesh.add_vertex(Point(2, 2, z)), s = mesh.add_vertex(Point(-2, 2, z));
    mesh.add_face(p, q, r);
    mesh.add_face(p, r, s);
  }
  return pair;
}

/// What each question takes.
struct Times {
  std::vector<double> all_pairs, self, one_call;
};

/// What each question found the last time.
struct Contacts {
  std::vector<Face_pair> all_pairs, self, one_call;
  bool operator==(const Contacts&) const = default;
};

/// Detectors of a pair, that ask again and again.
class Asked_pair {
 public:
  explicit Asked_pair(Pair pair) : pair_(std::move(pair)) {
    Detector_options options;
    options.exact.self_collision = true;
    for (const Surface_mesh& mesh : pair_) between_.add(mesh);
    within_ = Detector<>(options);
    within_.add(std::as_const(pair_[0]));
    between_.detect(), within_.detect();  // build
  }
  void ask(Times& times) {
    Lap_timer timer;
    between_.update();
    const auto& all_pairs = between_.detect().face_pairs;
    times.all_pairs.push_back(timer.lap());
    within_.update();
    const auto& self = within_.detect().face_pairs;
    times.self.push_back(timer.lap());
    auto at_once = find_collisions(pair_[0], pair_[1]);
    times.one_call.push_back(timer.lap());
    contacts_ = {.all_pairs = {all_pairs.begin(), all_pairs.end()},
                 .self = {self.begin(), self.end()},
                 .one_call = std::move(at_once.faces)};
  }
  const Contacts& contacts() const { return contacts_; }

 private:
  Pair pair_;
  Detector<> between_, within_;
  Contacts contacts_;
};

/// Medians of frames in which all positions are read, and of one call; and how many times what the balls alone take.
void ball_in_hall(benchmark::State& state) {
  const double size = std::ldexp(1.0, -static_cast<int>(state.range(0)));
  Asked_pair alone(crossing_balls(size, false)), in_hall(crossing_balls(size, true));
  Times alone_times, hall_times;
  for (auto _ : state) {
    alone.ask(alone_times);
    in_hall.ask(hall_times);
  }
  const Contacts& contacts = in_hall.contacts();
  if (alone.contacts() != contacts) state.SkipWithError("other contacts in the hall");
  const auto report = [&](const char* name, const std::vector<double>& hall, const std::vector<double>& balls) {
    state.counters[std::string(name) + "_ms"] = 1e3 * median(hall);
    state.counters[std::string(name) + "_ratio"] = median(hall) / median(balls);
  };
  state.counters["contacts"] =
      static_cast<double>(contacts.all_pairs.size() + contacts.self.size() + contacts.one_call.size());
  report("all_pairs", hall_times.all_pairs, alone_times.all_pairs);
  report("self", hall_times.self, alone_times.self);
  report("one_call", hall_times.one_call, alone_times.one_call);
}

BENCHMARK(ball_in_hall)
    ->ArgName("halvings")
    ->Arg(2)
    ->Arg(7)
    ->Arg(10)
    ->Arg(14)
    ->Arg(20)
    ->Arg(27)
    ->Iterations(21)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
