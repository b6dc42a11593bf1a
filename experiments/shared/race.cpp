// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/race.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "lodestone/queries/exhaustive.h"
#include "shared/lap_timer.h"
#include "shared/read_bound.h"

namespace lodestone {

namespace {

std::size_t heap_bytes() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// The truth of one frame.
struct Truth {
  std::vector<Object_pair> pairs;                ///< asked for
  std::vector<std::vector<Face_pair>> contacts;  ///< per pair, sorted
};

/// Adds the differences between two sorted sets.
void compare_sets(const std::vector<Face_pair>& truth, std::vector<Face_pair> found, Entry_figures& figures) {
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<Face_pair> missing, invented;
  std::ranges::set_difference(truth, found, std::back_inserter(missing));
  std::ranges::set_difference(found, truth, std::back_inserter(invented));
  figures.missing_pairs += missing.size();
  figures.false_pairs += invented.size();
  figures.wrong_sets += missing.empty() && invented.empty() ? 0 : 1;
}

/// Counts wrong answers in the first pass. In a later pass it counts frames that are wrong if the entry was right so
/// far.
void compare(const Truth& truth, const Answer& answer, std::size_t pass, Entry_figures& counted) {
  if (!counted.entry.answers) return;
  Entry_figures later = counted;
  Entry_figures& figures = pass == 0 ? counted : later;
  if (pass > 0) figures.missed = figures.invented = figures.wrong_sets = 0;
  figures.invented += answer.elsewhere;
  for (std::size_t p = 0; p < truth.pairs.size(); ++p) {
    const bool collides = !truth.contacts[p].empty();
    if (std::isfinite(answer.any_seconds)) {
      figures.missed += collides && !answer.collides[p] ? 1 : 0;
      figures.invented += !collides && answer.collides[p] ? 1 : 0;
    }
    if (figures.entry.reports_pairs && std::isfinite(answer.all_seconds))
      compare_sets(truth.contacts[p], answer.contacts[p], figures);
  }
  const bool wrong = figures.missed + figures.invented + figures.wrong_sets > 0;
  const bool wrong_before = counted.missed + counted.invented + counted.wrong_sets > 0;
  if (pass > 0 && wrong && !wrong_before) ++counted.wrong_later;
}

/// Objects are near if their bounding boxes overlap after each has grown to all sides by this share of its diagonal.
constexpr double near_margin = 0.05;
constexpr double never = std::numeric_limits<double>::infinity();

/// An entry at work.
struct Player {
  Entry_figures* figures;
  std::unique_ptr<Entrant> entrant;
  double seconds = 0;           ///< of all passes so far
  double approach_seconds = 0;  ///< between sampled frames

  /// Plays the frame that is posed now.
  /// @param frame  index among the sampled ones
  const Answer& play(std::size_t frame, const Truth& truth) {
    const Lap_timer timer;
    const Answer& answer = entrant->play(truth.pairs);
    seconds += timer.seconds();
    if (figures->frames.size() == frame) figures->frames.push_back({never, never, never, never, never});
    auto& least = figures->frames[frame];
    const double update = answer.update_seconds, any = answer.any_seconds, all = answer.all_seconds;
    least.update = std::min(least.update, update);
    if (answer.gave_up) {
      figures->gave_up = figures->left_early = true;
      return answer;
    }
    least.any = std::min(least.any, any);
    least.all = std::min(least.all, all);
    least.update_and_any = std::min(least.update_and_any, update + any);
    least.update_and_all = std::min(least.update_and_all, update + all);
    return answer;
  }
};

class Scene_race {
 public:
  Scene_race(Scene& scene, const Race_options& options, const std::function<void(double)>& progress)
      : scene_(scene), options_(options), progress_(progress) {
    figures_ = {.name = scene.name, .objects = scene.objects.size(), .frames = scene.frames};
    numberings_.reserve(scene.objects.size());
    for (const auto& object : scene.objects) {
      const auto& numbering = numberings_.emplace_back(object.mesh);
      meshes_.push_back({&object.mesh, numbering.corners()});
      figures_.triangles += numbering.corners().size();
      figures_.vertices += numbering.vertex_count();
    }
    sample(std::clamp(options.triangles / figures_.triangles, options.least_frames, options.most_frames));
    for (const auto frame : figures_.sampled) {
      pose_all(frame);
      truths_.push_back(find_truth());
      auto& frame_positions = positions_.emplace_back();
      for (const auto& object : scene.objects)
        frame_positions.emplace_back(object.mesh.points().begin(), object.mesh.points().end());
    }
  }

  Scene_figures run(std::span<const Entry> entries) {
    figures_.entries.reserve(entries.size());
    while (figures_.entries.size() < entries.size()) {
      ++figures_.batches;
      auto players = build(entries);
      for (std::size_t pass = 0; pass < options_.passes; ++pass)
        for (std::size_t turn = 0; turn < players.size(); ++turn) {
          play(pass, players[(pass + turn) % players.size()]);
          const auto finished = figures_.entries.size() - players.size();
          const auto share = static_cast<double>(pass * players.size() + turn + 1) /
                             static_cast<double>(options_.passes * players.size());
          progress_((static_cast<double>(finished) + share * static_cast<double>(players.size())) /
                    static_cast<double>(entries.size()));
        }
      inspect(players);
    }
    for (const auto& truth : truths_) {
      figures_.asked += truth.pairs.size();
      for (const auto& contacts : truth.contacts) {
        figures_.colliding += contacts.empty() ? 0 : 1;
        figures_.contacts += contacts.size();
      }
    }
    return std::move(figures_);
  }

 private:
  void pose_all(std::size_t frame) {
    for (auto& object : scene_.objects) pose(object, frame);
  }

  /// Chooses frames in which objects are near.
  void sample(std::size_t count) {
    std::vector<std::size_t> near;
    for (const auto frame : spread(scene_.frames, 4 * count)) {
      pose_all(frame);
      if (!overlapping_pairs(near_margin).empty()) near.push_back(frame);
    }
    for (const auto index : spread(near.size(), count)) figures_.sampled.push_back(near[index]);
    if (near.empty()) figures_.sampled = spread(scene_.frames, count);
  }

  /// @param margin  by which boxes grow to all sides, in multiples of their diagonals
  std::vector<Object_pair> overlapping_pairs(double margin) const {
    std::vector<Box> boxes;
    for (const auto& mesh : meshes_) {
      Box& box = boxes.emplace_back(read_every_vertex(mesh.coordinates()));
      const Eigen::Vector3d growth = Eigen::Vector3d::Constant(margin * box.diagonal().norm());
      box = Box(box.min() - growth, box.max() + growth);
    }
    std::vector<Object_pair> pairs;
    for (std::uint32_t b = 0; b < boxes.size(); ++b)
      for (std::uint32_t a = 0; a < b; ++a)
        if (boxes[a].intersects(boxes[b])) pairs.push_back({a, b});
    return pairs;
  }

  /// Builds the next entries, until they use up the memory of a batch.
  std::vector<Player> build(std::span<const Entry> entries) {
    pose_all(0);
    std::vector<Player> players;
    for (std::size_t bytes = 0; figures_.entries.size() < entries.size() && bytes < options_.bytes;) {
      auto& figures = figures_.entries.emplace_back(Entry_figures{.entry = entries[figures_.entries.size()]});
      const auto before = heap_bytes();
      Lap_timer timer;
      auto entrant = figures.entry.build(meshes_);
      figures.build_seconds = timer.lap();
      figures.bytes = entrant->bytes().value_or(std::max(heap_bytes(), before) - before);
      bytes += figures.bytes;
      entrant->prepare();
      players.push_back({&figures, std::move(entrant)});
    }
    return players;
  }

  /// One pass of one entry.
  void play(std::size_t pass, Player& player) {
    if (pass > 1 && player.seconds > options_.seconds) return;
    if (pass > 0 && player.approach_seconds > options_.approach_seconds) return;
    const std::size_t rounds = player.entrant->rounds();
    for (std::size_t round = 0; round < rounds; ++round) play_round(pass, round, player);
  }

  /// Goes over all sampled frames once.
  void play_round(std::size_t pass, std::size_t round, Player& player) {
    player.entrant->start_round(round);
    std::size_t next = 0;
    for (std::size_t f = 0; f < figures_.sampled.size() && !player.figures->left_early; ++f) {
      if (player.seconds > options_.most_seconds) player.figures->left_early = true;
      if (player.figures->left_early) return;
      if (player.entrant->wants_approach())
        for (; next < figures_.sampled[f]; ++next) approach(player, next);
      next = figures_.sampled[f] + 1;
      restore(f);
      if (round == 0) ++player.figures->passes;
      const Answer& answer = player.play(f, truths_[f]);
      if (!answer.gave_up) compare(truths_[f], answer, pass, *player.figures);
    }
  }

  void approach(Player& player, std::size_t frame) {
    pose_all(frame);
    const Lap_timer timer;
    player.entrant->approach();
    player.approach_seconds += timer.seconds();
  }

  /// Shows the sampled frames once more to the entrants that finished all of them.
  void inspect(std::span<Player> players) {
    for (std::size_t f = 0; f < figures_.sampled.size(); ++f) {
      restore(f);
      for (auto& player : players)
        if (!player.figures->left_early) player.entrant->inspect(truths_[f].pairs, f, figures_.sampled.size());
    }
  }

  /// Writes the positions of a sampled frame into the meshes, as a simulation does just before it asks.
  void restore(std::size_t f) {
    for (std::size_t o = 0; o < scene_.objects.size(); ++o)
      std::ranges::copy(positions_[f][o], scene_.objects[o].mesh.points().begin());
  }

  Truth find_truth() const {
    Truth truth{overlapping_pairs(0), {}};
    for (const auto& [a, b] : truth.pairs)
      truth.contacts.push_back(exhaustive_face_pairs(*meshes_[a].mesh, *meshes_[b].mesh));
    return truth;
  }

  Scene& scene_;
  const Race_options& options_;
  const std::function<void(double)>& progress_;
  std::vector<Mesh_numbering<Surface_mesh>> numberings_;
  std::vector<Moving_mesh> meshes_;
  std::vector<Truth> truths_;                               ///< per sampled frame
  std::vector<std::vector<std::vector<Point>>> positions_;  ///< per sampled frame and object
  Scene_figures figures_;
};

}  // namespace

std::vector<std::size_t> spread(std::size_t range, std::size_t count) {
  count = std::min(range, count);
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) indices[i] = (2 * i + 1) * range / (2 * count);
  return indices;
}

Scene_figures measure_race(Scene& scene, std::span<const Entry> entries, const Race_options& options,
                           const std::function<void(double)>& progress) {
  // Earlier scenes leave the heap fragmented. Without trimming, an entry would be slower than in a run of one scene.
  ::malloc_trim(0);
  return Scene_race(scene, options, progress).run(entries);
}

}  // namespace lodestone
