// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/contact_curve.h"

#include <algorithm>

namespace lodestone {

void Contact_curve::Pair_set::clear() {
  ++round_;
  size_ = 0;
  if (slots_.empty()) slots_.resize(1024);
}

std::size_t Contact_curve::Pair_set::slot_of(Face_pair pair) const {
  const std::size_t mask = slots_.size() - 1;
  std::uint64_t hash = (std::uint64_t{pair.a} << 32 | pair.b) * 0x9E3779B97F4A7C15u;
  std::size_t slot = (hash ^ hash >> 32) & mask;
  while (slots_[slot].round == round_ && slots_[slot].pair != pair) slot = (slot + 1) & mask;
  return slot;
}

bool Contact_curve::Pair_set::insert(Face_pair pair) {
  std::size_t slot = slot_of(pair);
  if (slots_[slot].round == round_) return false;
  if (2 * ++size_ > slots_.size()) {
    grow();
    slot = slot_of(pair);
  }
  slots_[slot] = {pair, round_};
  return true;
}

void Contact_curve::Pair_set::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.round == round_) slots_[slot_of(slot.pair)] = slot;
}

void Contact_curve::begin(const Walked_surface& a, const Walked_surface& b) {
  a_ = a, b_ = b;
  seen_.clear();
  exact_tests_ = vertices_read_ = 0;
}

/// Calls `visit` with each face that shares an edge with a face.
template <class Visit>
void Contact_curve::for_each_beside(const Walked_surface& surface, std::uint32_t face, Visit visit) {
  const Corners& corners = surface.walked[face];
  for (int edge = 0; edge < 3; ++edge) {
    const std::uint32_t from = corners[edge], to = corners[(edge + 1) % 3];
    for (const auto other : surface.vertex_faces->at(from))
      if (other != face && std::ranges::find(surface.walked[other], to) != surface.walked[other].end()) visit(other);
  }
}

void Contact_curve::test(Face_pair pair) {
  if (!seen_.insert(pair)) return;
  const Read_face a = read_face(a_, pair.a), b = read_face(b_, pair.b);
  vertices_read_ += 6;
  if (!a.box.intersects(b.box)) return;
  ++exact_tests_;
  if (triangles_intersect(a.triangle, b.triangle)) waiting_.push_back(pair);
}

void Contact_curve::follow(Face_pair contact, std::vector<Face_pair>& found) {
  if (!seen_.insert(contact)) return;
  waiting_.assign(1, contact);
  while (!waiting_.empty()) {
    const Face_pair pair = waiting_.back();
    waiting_.pop_back();
    found.push_back(pair);
    for_each_beside(a_, pair.a, [&](std::uint32_t face) { test({face, pair.b}); });
    for_each_beside(b_, pair.b, [&](std::uint32_t face) { test({pair.a, face}); });
  }
}

}  // namespace lodestone
