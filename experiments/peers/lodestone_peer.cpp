// SPDX-License-Identifier: GPL-3.0-or-later
// Lodestone's exact mode, as a user of `Detector` meets it: broad phase and sorted results included.
#include <fmt/format.h>

#include <algorithm>

#include "entrant.h"
#include "lap_timer.h"
#include "lodestone/detector.h"

namespace lodestone {

namespace {

/// One detector for each of the two questions.
class Lodestone_entrant : public Entrant {
 public:
  Lodestone_entrant(std::span<const Peer_mesh> meshes, std::size_t threads)
      : meshes_(meshes.begin(), meshes.end()),
        any_({.mode = Mode::exact, .contacts = Contact_query::yes_no, .exact = {.threads = threads}}),
        all_({.mode = Mode::exact, .contacts = Contact_query::all, .exact = {.threads = threads}}) {
    build(any_);
  }

  void prepare() override { build(all_); }

  const Answer& play(std::span<const Object_pair> pairs) override {
    Lap_timer timer;
    const Frame& any = any_.detect();
    const double any_seconds = timer.lap();
    answer_.update_seconds = any.statistics.seconds.refit;
    answer_.any_seconds = any_seconds - any.statistics.seconds.refit;
    answer_.collides.assign(pairs.size(), false);
    for (const auto& pair : any.pairs)
      if (const auto place = place_of(pair, pairs); place < pairs.size()) answer_.collides[place] = pair.collides;

    timer.lap();
    const Frame& all = all_.detect();
    answer_.all_seconds = timer.lap() - all.statistics.seconds.refit;
    answer_.contacts.assign(pairs.size(), {});
    for (const auto& pair : all.pairs)
      if (const auto place = place_of(pair, pairs); place < pairs.size()) {
        const auto contacts = all.contacts(pair);
        answer_.contacts[place].assign(contacts.begin(), contacts.end());
      }
    return answer_;
  }

 private:
  /// The first call builds.
  void build(Detector<Surface_mesh>& detector) {
    for (const auto& mesh : meshes_) detector.add(*mesh.mesh);
    detector.detect();
  }

  static std::size_t place_of(const Pair_result& pair, std::span<const Object_pair> pairs) {
    return static_cast<std::size_t>(std::ranges::find(pairs, Object_pair{pair.a, pair.b}) - pairs.begin());
  }

  std::vector<Peer_mesh> meshes_;
  Detector<Surface_mesh> any_, all_;
  Answer answer_;
};

Entry entry(std::size_t threads) {
  return {.library = "Lodestone",
          .method = threads == 1 ? "exact" : fmt::format("exact, {} threads", threads),
          .volume = "AABB",
          .threads = threads,
          .build = [threads](std::span<const Peer_mesh> meshes) -> std::unique_ptr<Entrant> {
            return std::make_unique<Lodestone_entrant>(meshes, threads);
          }};
}

}  // namespace

std::vector<Entry> lodestone_entries() { return {entry(1), entry(2)}; }

}  // namespace lodestone
