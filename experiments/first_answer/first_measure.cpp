// SPDX-License-Identifier: GPL-3.0-or-later
#include "first_answer/first_measure.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "lodestone/detector.h"
#include "peers/peer.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"
#include "shared/memory_peak.h"

namespace lodestone {

namespace {

/// Per contestant, scene and question; beyond, it starts no further round.
constexpr double enough_seconds = 1;
/// Frames after the first answer, per round.
constexpr std::size_t frames_per_round = 3;

/// How much more memory is resident at most, while `ask` runs, than before.
template <class Ask>
std::size_t peak_bytes(const Ask& ask) {
  ::malloc_trim(0);
  const Memory_peak peak;
  ask();
  return peak.bytes();
}

/// Puts the vertices of a mesh back where they were, also after a contestant has given up.
class Kept_positions {
 public:
  explicit Kept_positions(Surface_mesh& mesh) : mesh_(mesh), points_(mesh.points().begin(), mesh.points().end()) {}
  ~Kept_positions() { std::ranges::copy(points_, mesh_.points().begin()); }
  Kept_positions(const Kept_positions&) = delete;

 private:
  Surface_mesh& mesh_;
  std::vector<Point> points_;
};

using Truth = std::vector<Face_pair>;

/// The right answers to the first question of a round and in its frames, by mode exact: the experiment `every_frame`
/// checks that mode.
std::vector<Truth> truths_of(Once_scene& scene) {
  const Kept_positions kept(scene.b);
  Detector<> detector;
  detector.add(std::as_const(scene.a)), detector.add(std::as_const(scene.b));
  std::vector<Truth> truths{detector.detect(0, 1).face_pairs};
  for (std::size_t frame = 0; frame < frames_per_round; ++frame) {
    scene.step();
    truths.push_back(detector.detect(0, 1).face_pairs);
  }
  return truths;
}

/// One question to one contestant on one scene.
class Asker {
 public:
  Asker(const Once_contestant& contestant, Contact_query query, Once_scene& scene)
      : contestant_(contestant), query_(query), scene_(scene) {}

  bool done() const { return spent_ > enough_seconds; }
  /// Of complete rounds. None: there is none.
  std::optional<Once_times> times() const {
    if (firsts_.empty()) return std::nullopt;
    return Once_times{.first = median(firsts_), .frame = median(frames_)};
  }

  /// @param truths  of `truths_of`
  /// @return whether all answers are right
  /// @throws Gave_up
  bool play_round(std::span<const Truth> truths) {
    const Lap_timer timer;
    const auto session = contestant_.begin(scene_.a, scene_.b, query_);
    ask(*session);
    const double first = timer.seconds();
    bool right = is_right(truths.front());
    const std::vector<double> frames = seconds_of_frames(*session, truths.subspan(1), right);
    firsts_.push_back(first);
    frames_.insert(frames_.end(), frames.begin(), frames.end());
    spent_ = std::accumulate(frames.begin(), frames.end(), spent_ + first);
    return right;
  }

 private:
  void ask(Session& session) {
    found_.clear();
    if (query_ == Contact_query::all)
      session.all(found_);
    else
      any_ = session.any();
  }
  /// @param right  becomes false where an answer is wrong
  std::vector<double> seconds_of_frames(Session& session, std::span<const Truth> truths, bool& right) {
    std::vector<double> seconds;
    const Kept_positions kept(scene_.b);
    for (const Truth& truth : truths) {
      scene_.step();
      const Lap_timer lap;
      session.update();
      ask(session);
      seconds.push_back(lap.seconds());
      right &= is_right(truth);
    }
    return seconds;
  }
  bool is_right(const Truth& truth) {
    if (query_ != Contact_query::all) return any_ == !truth.empty();
    std::ranges::sort(found_);
    return std::ranges::equal(found_, truth);
  }

  const Once_contestant& contestant_;
  Contact_query query_;
  Once_scene& scene_;
  std::vector<double> firsts_, frames_;  // seconds
  std::vector<Face_pair> found_;
  bool any_ = false;
  double spent_ = 0;
};

/// Asks one question to all contestants that report the answer.
void ask_all(Once_scene& scene, Contact_query query, std::span<const Truth> truths,
             std::optional<Once_times> Once_figures::*times, std::size_t most_rounds,
             std::vector<Once_figures>& figures) {
  std::vector<Asker> askers;
  for (const auto& f : figures) askers.emplace_back(*f.contestant, query, scene);
  for (std::size_t round = 0; round < most_rounds; ++round)
    for (const std::size_t i : order_of_turns(round, figures.size())) {
      Once_figures& f = figures[i];
      const bool reported = query != Contact_query::all || f.contestant->reports_pairs;
      if (f.left_out || f.gave_up || !reported || askers[i].done()) continue;
      try {
        f.right &= askers[i].play_round(truths);
      } catch (const Gave_up&) {
        f.gave_up = true;
      }
    }
  for (std::size_t i = 0; i < figures.size(); ++i) figures[i].*times = askers[i].times();
}

}  // namespace

std::optional<std::size_t> pays_from(const Once_times& session, const Once_times& calls) {
  if (session.first <= calls.first) return 1;
  if (session.frame >= calls.frame) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::ceil((session.first - calls.first) / (calls.frame - session.frame)));
}

std::vector<Once_figures> measure_first_answers(Once_scene& scene, std::span<const Once_contestant> contestants,
                                                const std::vector<bool>& left_out, std::size_t most_rounds) {
  const auto truths = truths_of(scene);
  std::vector<Once_figures> figures;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    Once_figures& f = figures.emplace_back(Once_figures{.contestant = &contestants[i], .left_out = left_out[i]});
    if (f.left_out) continue;
    try {
      f.peak_bytes = peak_bytes([&] { contestants[i].begin(scene.a, scene.b, Contact_query::yes_no)->any(); });
    } catch (const Gave_up&) {
      f.gave_up = true;
    }
  }
  ask_all(scene, Contact_query::yes_no, truths, &Once_figures::any, most_rounds, figures);
  ask_all(scene, Contact_query::all, truths, &Once_figures::all, most_rounds, figures);
  return figures;
}

}  // namespace lodestone
