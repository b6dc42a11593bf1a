// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/meeting_search.h"

#include <algorithm>
#include <limits>

namespace lodestone {

namespace {

/// Rings of faces around the two ends of a meeting that are checked.
constexpr std::size_t checked_rings = 2;

}  // namespace

void Meeting_search::start_frame() {
  memory_.start_frame();
  rings_.reset_counts();
  counts_ = {};
  near_regions_.clear();
}

bool Meeting_search::list_regions(Met_pair& pair) {
  pair.first_near = near_regions_.size();
  list_near_regions(pair.a->regions(), pair.b->regions(), near_regions_);
  pair.near_count = near_regions_.size() - pair.first_near;
  return pair.near_count > 0;
}

bool Meeting_search::revisit(Met_pair& pair) {
  for (const auto& meeting : memory_.recall(pair.ids)) {
    if (still_meet(pair, meeting.contact)) {
      pair.found = meeting;
      pair.met = true;
      return true;
    }
    if (meet_from(pair, meeting.at)) return true;
  }
  return false;
}

bool Meeting_search::still_meet(const Met_pair& pair, Face_pair contact) {
  counts_.vertices_read += 6;
  ++counts_.exact_tests;
  return triangles_intersect(read_face(pair.a->walked_surface(), contact.a).triangle,
                             read_face(pair.b->walked_surface(), contact.b).triangle);
}

bool Meeting_search::meet_from(Met_pair& pair, Meeting start) {
  const Walked_surface a = pair.a->walked_surface(), b = pair.b->walked_surface();
  const Ended_meeting ended = meet(a, b, start, pair.a->particles().hop_limit + pair.b->particles().hop_limit);
  ++counts_.meetings;
  counts_.vertices_read += ended.vertices_read;
  pair.met = rings_.check(a, b, ended.at, checked_rings, pair.found.contact);
  pair.found.at = ended.at;
  return pair.met;
}

void Meeting_search::begin_search(const Met_pair& pair) {
  openings_.begin(pair.a->tree(), pair.b->tree(),
                  {.all = options_.contacts == Contact_query::all,
                   .reach = options_.opening_reach,
                   .budget = options_.opening_budget});
  for (const auto& near : near_regions(pair))
    openings_.add_start({pair.a->regions().node(near.a), pair.b->regions().node(near.b)}, near.order);
}

bool Meeting_search::open(Met_pair& pair) {
  begin_search(pair);
  opened_.clear();
  pair.met = openings_.open(opened_);
  counts_.openings += openings_.leaf_tests();
  counts_.exact_tests += openings_.exact_tests();
  if (pair.met) pair.found = meeting_at(pair, opened_.front());
  return pair.met;
}

/// The meeting of two particles that stand on faces in contact.
Remembered_meeting Meeting_search::meeting_at(const Met_pair& pair, Face_pair contact) {
  return {.at = {pair.a->walked_surface().walked[contact.a][0], pair.b->walked_surface().walked[contact.b][0]},
          .contact = contact};
}

bool Meeting_search::find_all(Met_pair& pair, std::vector<Face_pair>& found) {
  const std::size_t before = found.size();
  opened_.clear();
  curves_.begin(pair.a->walked_surface(), pair.b->walked_surface());
  std::size_t kept = 0;
  const auto follow = [&](const Remembered_meeting& meeting) {
    const std::size_t first = found.size();
    curves_.follow(meeting.contact, found);
    if (found.size() > first && kept++ < options_.meetings) memory_.keep(pair.ids, meeting);
  };
  for (const auto& meeting : memory_.recall(pair.ids)) {
    if (still_meet(pair, meeting.contact))
      follow(meeting);
    else if (meet_from(pair, meeting.at))
      follow(pair.found);
  }
  if (list_regions(pair)) open(pair);
  for (const auto& contact : opened_) follow(meeting_at(pair, contact));
  pair.met = found.size() > before;
  counts_.exact_tests += curves_.exact_tests();
  counts_.vertices_read += curves_.vertices_read();
  return pair.met;
}

void Meeting_search::remember(const Met_pair& pair) {
  if (!pair.met) return;
  memory_.keep(pair.ids, pair.found);
  // The others of the last frame may be of use once this one parts.
  std::size_t kept = 1;
  for (const auto& meeting : memory_.recall(pair.ids))
    if (meeting.contact != pair.found.contact && kept++ < options_.meetings) memory_.keep(pair.ids, meeting);
}

}  // namespace lodestone
