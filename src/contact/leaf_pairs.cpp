// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/leaf_pairs.h"

#include "contact/leaf_pair_kernel.h"
#include "contact/leaf_scratch.h"

namespace lodestone {

namespace {

kernel::Leaf_view view(const Posed_tree& posed, std::uint32_t leaf) {
  const Region_tree& tree = *posed.tree;
  return {.coordinates = posed.coordinates.data(),
          .vertices = tree.vertices(leaf).data(),
          .corners = tree.corners(leaf).data(),
          .vertex_count = tree.vertices(leaf).size(),
          .face_count = tree.faces(leaf).size(),
          .box = &tree.box(tree.leaf_node(leaf))};
}

}  // namespace

Leaf_pairs::Leaf_pairs() : scratch_(std::make_unique<Leaf_scratch>()) {}
Leaf_pairs::~Leaf_pairs() = default;
Leaf_pairs::Leaf_pairs(Leaf_pairs&&) noexcept = default;
Leaf_pairs& Leaf_pairs::operator=(Leaf_pairs&&) noexcept = default;

std::span<const Face_places> Leaf_pairs::near_faces(const Posed_tree& a, std::uint32_t leaf_a, const Posed_tree& b,
                                                    std::uint32_t leaf_b, double margin) {
  return find(a, leaf_a, b, leaf_b, margin, false);
}

std::span<const Face_places> Leaf_pairs::near_faces_within(const Posed_tree& tree, std::uint32_t leaf_a,
                                                           std::uint32_t leaf_b) {
  return find(tree, leaf_a, tree, leaf_b, 0, true);
}

std::span<const Face_places> Leaf_pairs::find(const Posed_tree& a, std::uint32_t leaf_a, const Posed_tree& b,
                                              std::uint32_t leaf_b, double margin, bool one_mesh) {
  const auto view_a = view(a, leaf_a), view_b = view(b, leaf_b);
  near_.resize(std::max(near_.size(), view_a.face_count * view_b.face_count));
  const std::size_t count =
      kernel::near_faces(view_a, view_b, margin, one_mesh && leaf_a == leaf_b, one_mesh, *scratch_, near_.data());
  return {near_.data(), count};
}

}  // namespace lodestone
