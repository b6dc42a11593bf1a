// SPDX-License-Identifier: GPL-3.0-or-later
// Lodestone's mode exact, as a user of `Detector` gets it: with broad phase and sorted results.
#include <fmt/format.h>

#include <limits>

#include "lodestone/detector.h"
#include "peers/peer_entries.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

/// One detector for each of the two questions.
class Lodestone_entrant : public Entrant {
 public:
  Lodestone_entrant(std::span<const Moving_mesh> meshes, std::size_t threads)
      : meshes_(meshes.begin(), meshes.end()),
        any_({.mode = Mode::exact, .contacts = Contact_query::yes_no, .threads = threads}),
        all_({.mode = Mode::exact, .contacts = Contact_query::all, .threads = threads}) {
    build(any_);
  }

  void prepare() override { build(all_); }

  std::size_t rounds() const override { return 2; }
  void start_round(std::size_t round) override { asks_all_ = round == 1; }

  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.any_seconds = answer_.all_seconds = std::numeric_limits<double>::infinity();
    asks_all_ ? ask_all(pairs) : ask_any(pairs);
    return answer_;
  }

 private:
  void ask_any(std::span<const Object_pair> pairs) {
    const Lap_timer timer;
    const Frame& frame = any_.detect();
    answer_.update_seconds = update_seconds(frame);
    answer_.any_seconds = timer.seconds() - answer_.update_seconds;
    answer_.collides.assign(pairs.size(), false);
    answer_.elsewhere = 0;
    for (const auto& pair : frame.pairs)
      if (const auto index = index_of({pair.a, pair.b}, pairs); index < pairs.size())
        answer_.collides[index] = pair.collides;
      else
        answer_.elsewhere += pair.collides ? 1 : 0;
  }

  void ask_all(std::span<const Object_pair> pairs) {
    const Lap_timer timer;
    const Frame& frame = all_.detect();
    answer_.update_seconds = update_seconds(frame);
    answer_.all_seconds = timer.seconds() - answer_.update_seconds;
    answer_.contacts.assign(pairs.size(), {});
    answer_.elsewhere = 0;
    for (const auto& pair : frame.pairs)
      if (const auto index = index_of({pair.a, pair.b}, pairs); index < pairs.size()) {
        const auto contacts = frame.contacts(pair);
        answer_.contacts[index].assign(contacts.begin(), contacts.end());
      } else {
        answer_.elsewhere += pair.collides ? 1 : 0;
      }
  }

  /// Whatever makes a tree follow its mesh: rebuilding a loose one counts too.
  static double update_seconds(const Frame& frame) {
    return frame.statistics.seconds.refit + frame.statistics.seconds.repartition;
  }

  /// The first call of `detect` builds the trees.
  void build(Detector<>& detector) {
    for (const auto& mesh : meshes_) detector.add(*mesh.mesh);
    detector.detect();
  }

  std::vector<Moving_mesh> meshes_;
  Detector<> any_, all_;
  Answer answer_;
  bool asks_all_ = false;
};

Entry entry(std::size_t threads) {
  return {.library = "Lodestone",
          .method = threads == 1 ? "exact" : fmt::format("exact, {} threads", threads),
          .volume = "AABB",
          .threads = threads,
          .build = [threads](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
            return std::make_unique<Lodestone_entrant>(meshes, threads);
          }};
}

}  // namespace

std::vector<Entry> lodestone_entries() { return {entry(1), entry(2)}; }

}  // namespace lodestone
