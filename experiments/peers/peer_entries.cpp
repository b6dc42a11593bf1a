// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers/peer_entries.h"

#include <limits>

#include "peers/peer.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

/// Asks a library one question per round. In each frame of a round the library updates, then answers.
class Peer_entrant : public Entrant {
 public:
  Peer_entrant(std::unique_ptr<Peer> peer, bool reports_pairs, std::span<const Moving_mesh> meshes)
      : peer_(std::move(peer)), reports_pairs_(reports_pairs), objects_(meshes.size()) {
    for (const auto& mesh : meshes) peer_->add(mesh);
  }

  std::optional<std::size_t> bytes() const override { return peer_->bytes(); }
  std::size_t rounds() const override { return reports_pairs_ ? 2 : 1; }
  void start_round(std::size_t round) override { asks_all_ = round == 1; }

  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.any_seconds = answer_.all_seconds = std::numeric_limits<double>::infinity();
    Lap_timer timer;
    for (std::size_t object = 0; object < objects_; ++object) peer_->update(object);
    answer_.update_seconds = timer.lap();
    try {
      (asks_all_ ? answer_.all_seconds : answer_.any_seconds) = asks_all_ ? ask_all(pairs) : ask_any(pairs);
    } catch (const Gave_up&) {
      answer_.gave_up = true;
    }
    return answer_;
  }

 private:
  double ask_any(std::span<const Object_pair> pairs) {
    answer_.collides.assign(pairs.size(), false);
    const Lap_timer timer;
    for (std::size_t p = 0; p < pairs.size(); ++p) answer_.collides[p] = peer_->any(pairs[p].a, pairs[p].b);
    return timer.seconds();
  }
  double ask_all(std::span<const Object_pair> pairs) {
    answer_.contacts.resize(pairs.size());
    for (auto& contacts : answer_.contacts) contacts.clear();
    const Lap_timer timer;
    for (std::size_t p = 0; p < pairs.size(); ++p) peer_->all(pairs[p].a, pairs[p].b, answer_.contacts[p]);
    return timer.seconds();
  }

  std::unique_ptr<Peer> peer_;
  bool reports_pairs_;
  std::size_t objects_;
  bool asks_all_ = false;
  Answer answer_;
};

Entry entry_of(const Peer_kind& kind) {
  Entry entry = kind.entry;
  entry.build = [make = kind.make,
                 reports_pairs = entry.reports_pairs](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
    return std::make_unique<Peer_entrant>(make(), reports_pairs, meshes);
  };
  return entry;
}

}  // namespace

std::vector<Entry> all_entries() {
  std::vector<Entry> all{read_bound_entry()};
  for (auto& own : lodestone_entries()) all.push_back(std::move(own));
  for (const auto& kind : all_peers()) all.push_back(entry_of(kind));
  return all;
}

}  // namespace lodestone
