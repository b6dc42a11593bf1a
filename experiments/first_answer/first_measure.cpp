// SPDX-License-Identifier: GPL-3.0-or-later
#include "first_answer/first_measure.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "lodestone/detector.h"
#include "peers/peer.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

/// Per contestant, scene and question; beyond, it starts no further round.
constexpr double enough_seconds = 1;
/// Frames after the first answer, per round.
constexpr std::size_t frames_per_round = 3;

/// The answers that are right, by mode exact: the experiment `every_frame` checks that mode.
std::vector<Face_pair> truth_of(const Once_scene& scene) {
  Detector<> detector;
  detector.add(scene.a), detector.add(scene.b);
  return detector.detect(0, 1).face_pairs;
}

/// A line of /proc/self/status, in bytes; 0 where there is none.
std::size_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::size_t kilobytes = 0; word == key + ":" && status >> kilobytes) return 1024 * kilobytes;
  return 0;
}

/// How much more memory is resident at most, while `ask` runs, than before.
template <class Ask>
std::size_t peak_bytes(const Ask& ask) {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak is from here on
  const std::size_t before = status_bytes("VmRSS");
  ask();
  return std::max(status_bytes("VmHWM"), before) - before;
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

/// One question to one contestant on one scene.
class Asker {
 public:
  Asker(const Once_contestant& contestant, Contact_query query, Once_scene& scene)
      : contestant_(contestant), query_(query), scene_(scene) {}

  bool done() const { return spent_ > enough_seconds; }
  const Once_times& times() const { return times_; }

  /// @return whether the answer is right
  /// @throws Gave_up
  bool play_round(std::span<const Face_pair> truth) {
    const Lap_timer timer;
    const auto session = contestant_.begin(scene_.a, scene_.b, query_);
    ask(*session);
    const double first = timer.seconds();
    const bool right = is_right(truth);
    note(times_.first, first);
    double frames = 0;
    const Kept_positions kept(scene_.b);
    for (std::size_t frame = 0; frame < frames_per_round; ++frame) {
      scene_.step();
      Lap_timer lap;
      session->update();
      ask(*session);
      const double seconds = lap.seconds();
      note(times_.frame, seconds);
      frames += seconds;
    }
    ++rounds_;
    spent_ += first + frames;
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
  bool is_right(std::span<const Face_pair> truth) {
    if (query_ != Contact_query::all) return any_ == !truth.empty();
    std::ranges::sort(found_);
    return std::ranges::equal(found_, truth);
  }
  void note(double& least, double seconds) const {
    least = rounds_ == 0 && least == 0 ? seconds : std::min(least, seconds);
  }

  const Once_contestant& contestant_;
  Contact_query query_;
  Once_scene& scene_;
  Once_times times_;
  std::vector<Face_pair> found_;
  bool any_ = false;
  std::size_t rounds_ = 0;
  double spent_ = 0;
};

/// Asks one question to all contestants that report the answer.
void ask_all(Once_scene& scene, Contact_query query, std::span<const Face_pair> truth,
             std::optional<Once_times> Once_figures::*times, std::size_t most_rounds,
             std::vector<Once_figures>& figures) {
  std::vector<Asker> askers;
  for (const auto& f : figures) askers.emplace_back(*f.contestant, query, scene);
  for (std::size_t round = 0; round < most_rounds; ++round)
    for (std::size_t turn = 0; turn < figures.size(); ++turn) {
      const std::size_t i = (turn + round) % figures.size();
      Once_figures& f = figures[i];
      const bool reported = query != Contact_query::all || f.contestant->reports_pairs;
      if (f.left_out || f.gave_up || !reported || askers[i].done()) continue;
      try {
        f.right &= askers[i].play_round(truth);
        f.*times = askers[i].times();
      } catch (const Gave_up&) {
        f.gave_up = true;
      }
    }
}

}  // namespace

std::optional<std::size_t> pays_from(const Once_times& session, const Once_times& calls) {
  if (session.first <= calls.first) return 1;
  if (session.frame >= calls.frame) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::ceil((session.first - calls.first) / (calls.frame - session.frame)));
}

std::vector<Once_figures> measure_first_answers(Once_scene& scene, std::span<const Once_contestant> contestants,
                                                const std::vector<bool>& left_out, std::size_t most_rounds) {
  const auto truth = truth_of(scene);
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
  ask_all(scene, Contact_query::yes_no, truth, &Once_figures::any, most_rounds, figures);
  ask_all(scene, Contact_query::all, truth, &Once_figures::all, most_rounds, figures);
  return figures;
}

}  // namespace lodestone
