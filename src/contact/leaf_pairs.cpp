// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/leaf_pairs.h"

#include <algorithm>
#include <limits>

#include "contact/leaf_pair_kernel.h"
#include "contact/leaf_scratch.h"

namespace lodestone {

namespace {

/// Leaves of a tree that are kept at a time: a walk meets most leaves again soon or not at all.
constexpr std::size_t slots = 32;
constexpr auto no_leaf = std::numeric_limits<std::uint32_t>::max();

kernel::Leaf_view view(const Posed_tree& posed, std::uint32_t leaf, Face_columns& faces) {
  const Region_tree& tree = *posed.tree;
  return {.coordinates = posed.coordinates.data(),
          .vertices = tree.vertices(leaf).data(),
          .corners = tree.corners(leaf).data(),
          .vertex_count = tree.vertices(leaf).size(),
          .face_count = tree.faces(leaf).size(),
          .box = &tree.box(tree.leaf_node(leaf)),
          .faces = &faces};
}

}  // namespace

Leaf_pairs::Leaf_pairs() : scratch_(std::make_unique_for_overwrite<Leaf_scratch>()) {}
Leaf_pairs::~Leaf_pairs() = default;
Leaf_pairs::Leaf_pairs(Leaf_pairs&&) noexcept = default;
Leaf_pairs& Leaf_pairs::operator=(Leaf_pairs&&) noexcept = default;

void Leaf_pairs::Side::begin(const Posed_tree& tree) {
  posed = tree;
  leaves.assign(slots, no_leaf);
  faces.resize(slots);
}

Face_columns& Leaf_pairs::Side::at(std::uint32_t leaf) {
  const std::size_t slot = leaf % slots;
  if (!faces[slot]) faces[slot] = std::make_unique_for_overwrite<Face_columns>();
  if (leaves[slot] != leaf) {
    leaves[slot] = leaf;
    faces[slot]->count = 0;
  }
  return *faces[slot];
}

void Leaf_pairs::begin(const Posed_tree& a, const Posed_tree& b, double margin) {
  sides_[0].begin(a);
  sides_[1].begin(b);
  margin_ = margin;
  one_mesh_ = false;
}

void Leaf_pairs::begin_within(const Posed_tree& tree) {
  begin(tree, tree, 0);
  one_mesh_ = true;
}

std::span<const Face_places> Leaf_pairs::near_faces(std::uint32_t leaf_a, std::uint32_t leaf_b) {
  const auto a = view(sides_[0].posed, leaf_a, sides_[0].at(leaf_a));
  // Within one mesh a leaf is kept once, unless the two would be kept in the same place.
  const bool together = one_mesh_ && (leaf_a == leaf_b || leaf_a % slots != leaf_b % slots);
  const auto b = view(sides_[1].posed, leaf_b, sides_[together ? 0 : 1].at(leaf_b));
  near_.resize(std::max(near_.size(), a.face_count * b.face_count));
  const kernel::Leaf_request request{
      .margin = margin_, .one_mesh = one_mesh_, .one_leaf = one_mesh_ && leaf_a == leaf_b};
  const std::size_t count = kernel::near_faces(a, b, request, *scratch_, near_.data());
  return {near_.data(), count};
}

}  // namespace lodestone
