// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/pair_search.h"

#include <algorithm>
#include <limits>

namespace lodestone {

namespace {

/// Rings of faces around the two ends of a meeting that are checked.
constexpr std::size_t checked_rings = 2;
/// Hops of two particles from where they met in the last frame. It takes some ten where surfaces slide on each other.
/// Beside a face as wide as a floor, a particle at its far corner would draw the other across the whole surface.
constexpr std::size_t most_hops_back = 64;

}  // namespace

Remembered_meeting met_at(const Met_pair& pair, Face_pair contact) {
  const Meeting corners{.a = pair.a->walked_surface().walked[contact.a][0],
                        .b = pair.b->walked_surface().walked[contact.b][0]};
  return {.at = corners, .contact = contact};
}

void Pair_search::start_frame() {
  rings_.reset_counts();
  counts_ = {};
  lists_.clear();
}

void Pair_search::look(Met_pair& pair, Workers& workers) {
  pair.lists = &lists_;
  pair.seed_entries.first = lists_.seeds.size();
  revisit(pair);
  if (!decided(pair)) {
    list_regions(pair);
    if (pair.near_entries.count > 0) open(pair, workers);
  }
}

/// Looks where the particles met in the last frame: at the same two faces, then where a meeting from there leads to.
void Pair_search::revisit(Met_pair& pair) {
  const std::size_t most_hops = std::min(hop_limit(pair), most_hops_back);
  bool walk = true;
  for (const auto& meeting : memory_.recall(pair.ids)) {
    if (still_meet(pair, meeting.contact))
      add_seed(pair, meeting);
    else if (walk)
      walk = meet_from(pair, meeting.at, most_hops) < most_hops_back;
    if (decided(pair)) return;
  }
}

bool Pair_search::still_meet(const Met_pair& pair, Face_pair contact) {
  counts_.vertices_read += 6;
  ++counts_.exact_tests;
  return triangles_intersect(read_face(pair.a->walked_surface(), contact.a).triangle,
                             read_face(pair.b->walked_surface(), contact.b).triangle);
}

/// Lets two particles meet, and checks the faces around.
/// @return the hops that they took
std::size_t Pair_search::meet_from(Met_pair& pair, Meeting start, std::size_t most_hops) {
  const Walked_surface a = pair.a->walked_surface(), b = pair.b->walked_surface();
  const Ended_meeting ended = meet(a, b, start, most_hops);
  ++counts_.meetings;
  counts_.vertices_read += ended.vertices_read;
  Remembered_meeting meeting{.at = ended.at, .contact = {}};
  if (rings_.check(a, b, ended.at, checked_rings, meeting.contact)) add_seed(pair, meeting);
  return ended.hops;
}

std::size_t Pair_search::hop_limit(const Met_pair& pair) {
  return pair.a->particles().hop_limit + pair.b->particles().hop_limit;
}

void Pair_search::list_regions(Met_pair& pair) {
  pair.near_entries.first = lists_.near_regions.size();
  list_near_regions(pair.a->region_anchors(), pair.b->region_anchors(), lists_.near_regions);
  pair.near_entries.count = lists_.near_regions.size() - pair.near_entries.first;
}

void Pair_search::open(Met_pair& pair, Workers& workers) {
  auto& contacts = lists_.of_look;
  begin_openings(pair, false);
  pair.look_entries.first = contacts.size();
  if (wants_all() && openings_.is_limited()) follow_known_curves(pair, workers);
  pair.followed_count = contacts.size() - pair.look_entries.first;
  openings_.open(contacts, workers);
  pair.look_entries.count = contacts.size() - pair.look_entries.first;
  pair.out_of_budget = openings_.out_of_budget();
  count_openings(pair);
  pair.compared_entries = {.first = lists_.compared.size(), .count = openings_.compared().size()};
  lists_.compared.insert(lists_.compared.end(), openings_.compared().begin(), openings_.compared().end());
  if (pair.seed_entries.count == 0 && !pair.contacts_of_look().empty())
    add_seed(pair, met_at(pair, pair.contacts_of_look().front()));
}

/// How many vertices are read as a whole. In order that takes a small fraction of the time per vertex that openings
/// take.
std::size_t Pair_search::most_whole() const {
  return 4 * std::min(options_.opening_budget, std::numeric_limits<std::size_t>::max() / 4);
}

/// Starts a search below the regions that may touch.
/// @param opened  they have been opened in this frame
void Pair_search::begin_openings(const Met_pair& pair, bool opened) {
  starts_.clear();
  for (const auto& near : pair.near_regions())
    starts_.push_back({{pair.a->region_anchors().node(near.a), pair.b->region_anchors().node(near.b)}, near.order});
  const Opening_request request{.all = wants_all(),
                                .reach = options_.opening_reach,
                                .budget = options_.opening_budget,
                                .most_whole = most_whole(),
                                .opened = opened};
  openings_.begin(pair.a->tree(), pair.b->tree(), request, starts_);
}

/// The curves of the last frame come first: it is known where they are, so the budget goes farther. A pair of leaves
/// that had a contact in the last frame mostly has one in this frame.
void Pair_search::follow_known_curves(const Met_pair& pair, Workers& workers) {
  contacts_.clear();
  for (const auto& seed : pair.seeds()) contacts_.push_back(seed.contact);
  const auto known = curves_.recall(pair.ids);
  contacts_.insert(contacts_.end(), known.begin(), known.end());
  if (contacts_.empty()) return;
  openings_.follow(pair.a->leaf_neighbours(), pair.b->leaf_neighbours(), {.contacts = contacts_}, lists_.of_look,
                   workers);
}

void Pair_search::count_openings(Met_pair& pair) {
  pair.leaf_tests += openings_.leaf_tests();
  counts_.leaf_tests += openings_.leaf_tests();
  counts_.exact_tests += openings_.exact_tests();
}

void Pair_search::meet_nearest(Met_pair& pair) {
  const Particles &a = pair.a->particles(), &b = pair.b->particles();
  nearest_.clear();
  for (const auto& near : pair.near_regions()) {
    const Region_index region_a = pair.a->region_anchors().region(near.a),
                       region_b = pair.b->region_anchors().region(near.b);
    nearest_.push_back({(a.positions[region_a] - b.positions[region_b]).squaredNorm(), region_a, region_b});
  }
  const std::size_t count = std::min(options_.meetings, nearest_.size());
  std::ranges::partial_sort(nearest_, nearest_.begin() + static_cast<std::ptrdiff_t>(count), is_nearer);

  // The seeds of a pair must stay next to each other.
  auto& seeds = pair.lists->seeds;
  const std::size_t old = pair.seed_entries.first;
  pair.seed_entries.first = seeds.size();
  for (std::size_t seed = 0; seed < pair.seed_entries.count; ++seed)
    seeds.push_back(Remembered_meeting(seeds[old + seed]));
  for (std::size_t i = 0; i < count && !decided(pair); ++i)
    meet_from(pair, {a.at[nearest_[i].a], b.at[nearest_[i].b]}, hop_limit(pair));
}

void Pair_search::add_seed(Met_pair& pair, const Remembered_meeting& seed) {
  pair.lists->seeds.push_back(seed);
  ++pair.seed_entries.count;
}

void Pair_search::follow_curves(Met_pair& pair, Workers& workers) {
  if (pair.seed_entries.count == 0) return;
  contacts_.assign(pair.contacts_of_look().begin(), pair.contacts_of_look().end());
  for (const auto& seed : pair.seeds()) contacts_.push_back(seed.contact);
  begin_openings(pair, true);
  pair.limited = openings_.is_limited();
  pair.followed_in = &lists_;
  pair.curve_entries.first = lists_.of_curves.size();
  openings_.follow(pair.a->leaf_neighbours(), pair.b->leaf_neighbours(),
                   {.contacts = contacts_, .compared = pair.compared(), .followed = pair.followed_count},
                   lists_.of_curves, workers);
  pair.curve_entries.count = lists_.of_curves.size() - pair.curve_entries.first;
  count_openings(pair);
}

Meeting_counts Pair_search::counts() const {
  Meeting_counts counts = counts_;
  counts.exact_tests += rings_.exact_tests();
  counts.vertices_read += rings_.vertices_read();
  return counts;
}

}  // namespace lodestone
