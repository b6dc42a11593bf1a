// SPDX-License-Identifier: GPL-3.0-or-later
#include "peer_entries.h"

#include "lap_timer.h"
#include "peer.h"

namespace lodestone {

namespace {

class Peer_entrant : public Entrant {
 public:
  Peer_entrant(std::unique_ptr<Peer> peer, bool reports_pairs, std::span<const Moving_mesh> meshes)
      : peer_(std::move(peer)), reports_pairs_(reports_pairs), objects_(meshes.size()) {
    for (const auto& mesh : meshes) peer_->add(mesh);
  }

  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.collides.assign(pairs.size(), false);
    answer_.contacts.resize(pairs.size());
    for (auto& contacts : answer_.contacts) contacts.clear();

    Lap_timer timer;
    for (std::size_t object = 0; object < objects_; ++object) peer_->update(object);
    answer_.update_seconds = timer.lap();
    try {
      for (std::size_t p = 0; p < pairs.size(); ++p) answer_.collides[p] = peer_->any(pairs[p].a, pairs[p].b);
      answer_.any_seconds = timer.lap();
      if (!reports_pairs_) return answer_;
      for (std::size_t p = 0; p < pairs.size(); ++p) peer_->all(pairs[p].a, pairs[p].b, answer_.contacts[p]);
      answer_.all_seconds = timer.lap();
    } catch (const Gave_up&) {
      answer_.gave_up = true;
    }
    return answer_;
  }

 private:
  std::unique_ptr<Peer> peer_;
  bool reports_pairs_;
  std::size_t objects_;
  Answer answer_;
};

Entry entry(const Peer_kind& kind) {
  return {.library = kind.library,
          .method = kind.method,
          .volume = kind.volume,
          .threads = kind.threads,
          .reports_pairs = kind.reports_pairs,
          .build = [kind](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
            return std::make_unique<Peer_entrant>(kind.make(), kind.reports_pairs, meshes);
          }};
}

}  // namespace

std::vector<Entry> all_entries() {
  std::vector<Entry> all{read_bound_entry()};
  for (auto& own : lodestone_entries()) all.push_back(std::move(own));
  for (const auto& kind : all_peers()) all.push_back(entry(kind));
  return all;
}

}  // namespace lodestone
