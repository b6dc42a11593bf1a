// SPDX-License-Identifier: GPL-3.0-or-later
#include "peer_run.h"

#include <malloc.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "lodestone/baselines/exhaustive.h"
#include "read_bound.h"
#include "stopwatch.h"

namespace lodestone {

namespace {

std::size_t heap_bytes() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// What is true in one frame.
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

void compare(const Truth& truth, const Answer& answer, Entry_figures& figures) {
  if (!figures.entry.answers) return;
  for (std::size_t p = 0; p < truth.pairs.size(); ++p) {
    const bool collides = !truth.contacts[p].empty();
    figures.missed += collides && !answer.collides[p] ? 1 : 0;
    figures.invented += !collides && answer.collides[p] ? 1 : 0;
    if (figures.entry.reports_pairs) compare_sets(truth.contacts[p], answer.contacts[p], figures);
  }
}

/// An entry at work.
struct Player {
  Entry_figures* figures;
  std::unique_ptr<Entrant> entrant;
  double seconds = 0;  ///< of all passes so far

  const Answer& play(const Truth& truth, Frame_seconds& least) {
    const Answer& answer = entrant->play(truth.pairs);
    const double update = answer.update_seconds, any = answer.any_seconds, all = answer.all_seconds;
    seconds += update + any + all;
    ++figures->passes;
    least.update = std::min(least.update, update);
    least.any = std::min(least.any, any);
    least.all = std::min(least.all, all);
    least.update_and_any = std::min(least.update_and_any, update + any);
    least.update_and_all = std::min(least.update_and_all, update + all);
    return answer;
  }
};

class Scene_run {
 public:
  Scene_run(Scene& scene, const Peer_run_options& options, const std::function<void(double)>& progress)
      : scene_(scene), options_(options), progress_(progress) {
    figures_ = {.name = scene.name, .objects = scene.objects.size(), .frames = scene.frames};
    numberings_.reserve(scene.objects.size());
    for (const auto& object : scene.objects) {
      const auto& numbering = numberings_.emplace_back(object.mesh);
      meshes_.push_back({&object.mesh, numbering.corners()});
      figures_.triangles += numbering.corners().size();
      figures_.vertices += numbering.vertex_count();
    }
    const auto affordable = options.triangles / figures_.triangles;
    figures_.sampled = sample_frames(scene.frames, std::clamp(affordable, options.least_frames, options.most_frames));
    truths_.resize(figures_.sampled.size());
  }

  Scene_figures run(std::span<const Entry> entries) {
    figures_.entries.reserve(entries.size());
    while (figures_.entries.size() < entries.size()) {
      ++figures_.batches;
      auto players = build(entries);
      for (std::size_t f = 0; f < figures_.sampled.size(); ++f) {
        play(f, players);
        const auto finished = figures_.entries.size() - players.size();
        const auto share = static_cast<double>(f + 1) / static_cast<double>(figures_.sampled.size());
        progress_((static_cast<double>(finished) + share * static_cast<double>(players.size())) /
                  static_cast<double>(entries.size()));
      }
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

  /// Builds the entries that are next, until the memory for one batch is used up.
  std::vector<Player> build(std::span<const Entry> entries) {
    pose_all(0);
    std::vector<Player> players;
    for (std::size_t bytes = 0; figures_.entries.size() < entries.size() && bytes < options_.bytes;) {
      auto& figures = figures_.entries.emplace_back(Entry_figures{.entry = entries[figures_.entries.size()]});
      constexpr double never = std::numeric_limits<double>::infinity();
      figures.frames.assign(figures_.sampled.size(), {never, never, never, never, never});
      const auto before = heap_bytes();
      Stopwatch watch;
      auto entrant = figures.entry.build(meshes_);
      figures.build_seconds = watch.lap();
      figures.bytes = std::max(heap_bytes(), before) - before;
      bytes += figures.bytes;
      entrant->prepare();
      players.push_back({&figures, std::move(entrant)});
    }
    return players;
  }

  void play(std::size_t f, std::vector<Player>& players) {
    pose_all(figures_.sampled[f]);
    auto& truth = truths_[f];
    if (figures_.batches == 1) truth = find_truth();
    const double share = static_cast<double>(f + 1) / static_cast<double>(figures_.sampled.size());
    for (std::size_t pass = 0; pass < options_.passes; ++pass)
      for (std::size_t turn = 0; turn < players.size(); ++turn) {
        auto& player = players[(f + pass + turn) % players.size()];
        if (pass > 0 && player.seconds > share * options_.seconds) continue;
        const Answer& answer = player.play(truth, player.figures->frames[f]);
        if (pass == 0) compare(truth, answer, *player.figures);
      }
  }

  Truth find_truth() const {
    std::vector<Box> boxes;
    for (const auto& mesh : meshes_) boxes.push_back(read_every_vertex(mesh.coordinates()));
    Truth truth;
    for (std::uint32_t b = 0; b < meshes_.size(); ++b)
      for (std::uint32_t a = 0; a < b; ++a) {
        if (meshes_.size() > 2 && !boxes[a].intersects(boxes[b])) continue;
        truth.pairs.push_back({a, b});
        truth.contacts.push_back(exhaustive_face_pairs(*meshes_[a].mesh, *meshes_[b].mesh));
      }
    return truth;
  }

  Scene& scene_;
  const Peer_run_options& options_;
  const std::function<void(double)>& progress_;
  std::vector<Mesh_numbering<Surface_mesh>> numberings_;
  std::vector<Peer_mesh> meshes_;
  std::vector<Truth> truths_;  ///< per sampled frame
  Scene_figures figures_;
};

}  // namespace

std::vector<std::size_t> sample_frames(std::size_t frames, std::size_t count) {
  count = std::min(frames, count);
  std::vector<std::size_t> sampled(count);
  for (std::size_t i = 0; i < count; ++i) sampled[i] = (2 * i + 1) * frames / (2 * count);
  return sampled;
}

Scene_figures measure_peers(Scene& scene, std::span<const Entry> entries, const Peer_run_options& options,
                            const std::function<void(double)>& progress) {
  return Scene_run(scene, options, progress).run(entries);
}

}  // namespace lodestone
