// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/meeting_search.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace lodestone {

namespace {

/// Rings of faces around the two ends of a meeting that are checked.
constexpr std::size_t checked_rings = 2;
/// Hops of two particles from where they met in the last frame. It takes some ten where surfaces slide on each other.
/// Beside a face as wide as a floor, a particle at its far corner would draw the other across the whole surface.
constexpr std::size_t most_hops_back = 64;

}  // namespace

void Meeting_search::start_frame() {
  memory_.start_frame();
  curves_.start_frame();
  rings_.reset_counts();
  counts_ = {};
  near_regions_.clear();
  seeds_.clear();
  opened_.clear();
  compared_.clear();
}

void Meeting_search::look(Met_pair& pair, Workers& workers) {
  pair.seeds.first = seeds_.size();
  revisit(pair);
  if (!decided(pair)) {
    list_regions(pair);
    if (pair.near.count > 0) open(pair, workers);
  }
}

/// Looks where the particles met in the last frame: at the same two faces, then where a meeting from there leads to.
void Meeting_search::revisit(Met_pair& pair) {
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

bool Meeting_search::still_meet(const Met_pair& pair, Face_pair contact) {
  counts_.vertices_read += 6;
  ++counts_.exact_tests;
  return triangles_intersect(read_face(pair.a->walked_surface(), contact.a).triangle,
                             read_face(pair.b->walked_surface(), contact.b).triangle);
}

/// Lets two particles meet, and checks the faces around.
/// @return the hops that they took
std::size_t Meeting_search::meet_from(Met_pair& pair, Meeting start, std::size_t most_hops) {
  const Walked_surface a = pair.a->walked_surface(), b = pair.b->walked_surface();
  const Ended_meeting ended = meet(a, b, start, most_hops);
  ++counts_.meetings;
  counts_.vertices_read += ended.vertices_read;
  Remembered_meeting meeting{.at = ended.at, .contact = {}};
  if (rings_.check(a, b, ended.at, checked_rings, meeting.contact)) add_seed(pair, meeting);
  return ended.hops;
}

std::size_t Meeting_search::hop_limit(const Met_pair& pair) {
  return pair.a->particles().hop_limit + pair.b->particles().hop_limit;
}

void Meeting_search::list_regions(Met_pair& pair) {
  pair.near.first = near_regions_.size();
  list_near_regions(pair.a->regions(), pair.b->regions(), near_regions_);
  pair.near.count = near_regions_.size() - pair.near.first;
}

void Meeting_search::open(Met_pair& pair, Workers& workers) {
  begin_openings(pair, false);
  pair.opened.first = opened_.size();
  if (wants_all() && openings_.is_limited()) follow_known_curves(pair, workers);
  pair.followed_count = opened_.size() - pair.opened.first;
  openings_.open(opened_, workers);
  pair.opened.count = opened_.size() - pair.opened.first;
  pair.out_of_budget = openings_.out_of_budget();
  count_openings();
  pair.compared.first = compared_.size();
  compared_.insert(compared_.end(), openings_.compared().begin(), openings_.compared().end());
  pair.compared.count = openings_.compared().size();
  if (pair.seeds.count == 0 && pair.opened.count > 0) add_seed(pair, met_at(pair, opened_[pair.opened.first]));
}

/// How many vertices are read as a whole. In order that takes a small fraction of the time per vertex that openings
/// take.
std::size_t Meeting_search::most_whole() const {
  return 4 * std::min(options_.opening_budget, std::numeric_limits<std::size_t>::max() / 4);
}

/// Starts a search below the regions that may touch.
/// @param opened  they have been opened in this frame
void Meeting_search::begin_openings(const Met_pair& pair, bool opened) {
  starts_.clear();
  for (const auto& near : near_regions(pair))
    starts_.push_back({{pair.a->regions().node(near.a), pair.b->regions().node(near.b)}, near.order});
  const Opening_request request{.all = wants_all(),
                                .reach = options_.opening_reach,
                                .budget = options_.opening_budget,
                                .most_whole = most_whole(),
                                .opened = opened};
  openings_.begin(pair.a->tree(), pair.b->tree(), request, starts_);
}

/// The curves of the last frame come first: it is known where they are, so the budget goes farther. A pair of leaves
/// that had a contact in the last frame mostly has one in this frame.
void Meeting_search::follow_known_curves(const Met_pair& pair, Workers& workers) {
  contacts_.clear();
  for (const auto& seed : seeds(pair)) contacts_.push_back(seed.contact);
  const auto known = curves_.recall(pair.ids);
  contacts_.insert(contacts_.end(), known.begin(), known.end());
  if (contacts_.empty()) return;
  openings_.follow(pair.a->leaf_neighbours(), pair.b->leaf_neighbours(), {.contacts = contacts_}, opened_, workers);
}

/// Particles of both surfaces at a contact.
Remembered_meeting Meeting_search::met_at(const Met_pair& pair, Face_pair contact) {
  const Meeting corners{.a = pair.a->walked_surface().walked[contact.a][0],
                        .b = pair.b->walked_surface().walked[contact.b][0]};
  return {.at = corners, .contact = contact};
}

void Meeting_search::count_openings() {
  counts_.openings += openings_.leaf_tests();
  counts_.exact_tests += openings_.exact_tests();
}

void Meeting_search::meet_nearest(Met_pair& pair) {
  const Particles &a = pair.a->particles(), &b = pair.b->particles();
  nearest_.clear();
  for (const auto& near : near_regions(pair)) {
    const Region_index region_a = pair.a->regions().region(near.a), region_b = pair.b->regions().region(near.b);
    nearest_.push_back({(a.positions[region_a] - b.positions[region_b]).squaredNorm(), region_a, region_b});
  }
  const std::size_t count = std::min(options_.meetings, nearest_.size());
  std::ranges::partial_sort(nearest_, nearest_.begin() + static_cast<std::ptrdiff_t>(count), is_nearer);

  // The seeds of a pair must stay next to each other.
  const std::size_t old = pair.seeds.first;
  pair.seeds.first = seeds_.size();
  for (std::size_t seed = 0; seed < pair.seeds.count; ++seed) seeds_.push_back(Remembered_meeting(seeds_[old + seed]));
  for (std::size_t i = 0; i < count && !decided(pair); ++i)
    meet_from(pair, {a.at[nearest_[i].a], b.at[nearest_[i].b]}, hop_limit(pair));
}

void Meeting_search::add_seed(Met_pair& pair, const Remembered_meeting& seed) {
  seeds_.push_back(seed);
  ++pair.seeds.count;
}

void Meeting_search::report(const Met_pair& pair, std::vector<Face_pair>& found, Workers& workers) {
  if (pair.seeds.count == 0) return;
  if (wants_all()) {
    const std::size_t first = found.size();
    follow_curves(pair, found, workers);
    remember_some(pair, std::span(found).subspan(first));
    if (openings_.is_limited()) remember_curves(pair, std::span(found).subspan(first));
  } else {
    found.push_back(seeds(pair).front().contact);
    remember_one(pair);
  }
}

/// Remembers contacts at equal steps in the list of all.
void Meeting_search::remember_some(const Met_pair& pair, std::span<const Face_pair> contacts) {
  const std::size_t step = contacts.size() / options_.meetings + (contacts.size() % options_.meetings > 0 ? 1 : 0);
  for (std::size_t i = 0; i < contacts.size(); i += step) memory_.keep(pair.ids, met_at(pair, contacts[i]));
}

/// Remembers a contact in each pair of leaves that has any. Those of one pair mostly follow each other in the list.
void Meeting_search::remember_curves(const Met_pair& pair, std::span<const Face_pair> contacts) {
  const Leaf_neighbours &a = pair.a->leaf_neighbours(), &b = pair.b->leaf_neighbours();
  std::optional<Leaf_pair> last;
  for (const Face_pair contact : contacts)
    if (const Leaf_pair leaves{a.leaf_of(contact.a), b.leaf_of(contact.b)}; leaves != last) {
      curves_.keep(pair.ids, contact);
      last = leaves;
    }
}

/// Reports the curves on which the seeds lie.
void Meeting_search::follow_curves(const Met_pair& pair, std::vector<Face_pair>& found, Workers& workers) {
  const auto opened = pair.opened.of(opened_);
  contacts_.assign(opened.begin(), opened.end());
  for (const auto& seed : seeds(pair)) contacts_.push_back(seed.contact);
  const auto compared = pair.compared.of(compared_);
  begin_openings(pair, true);
  openings_.follow(pair.a->leaf_neighbours(), pair.b->leaf_neighbours(),
                   {.contacts = contacts_, .compared = compared, .followed = pair.followed_count}, found, workers);
  count_openings();
}

/// Remembers the contact that was found, and the meetings of the last frame: one of them may be of use once this one
/// parts.
void Meeting_search::remember_one(const Met_pair& pair) {
  const Remembered_meeting& found = seeds(pair).front();
  memory_.keep(pair.ids, found);
  std::size_t kept = 1;
  for (const auto& meeting : memory_.recall(pair.ids))
    if (meeting.contact != found.contact && kept++ < options_.meetings) memory_.keep(pair.ids, meeting);
}

Meeting_counts Meeting_search::counts() const {
  Meeting_counts counts = counts_;
  counts.exact_tests += rings_.exact_tests();
  counts.vertices_read += rings_.vertices_read();
  return counts;
}

}  // namespace lodestone
