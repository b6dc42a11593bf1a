// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "lodestone/tree/tree_layout.h"
#include "tree/read_ahead.h"

namespace lodestone {

namespace {

/// Trees are some dozen levels deep, also where they have been mended; forged ones may have more.
constexpr std::uint32_t most_levels = 4096;

/// Whether these are the places where the lists of `lists` leaves start in one list of a length, none of them empty and
/// none longer than `most`.
bool are_begins(std::span<const std::uint32_t> begins, std::size_t lists, std::size_t length, std::size_t most) {
  if (begins.size() != lists + 1 || begins.front() != 0 || begins.back() != length) return false;
  return std::ranges::adjacent_find(
             begins, [most](auto begin, auto end) { return end <= begin || end - begin > most; }) == begins.end();
}

bool is_too_deep(std::span<const Tree_layout::Node> nodes) {
  std::vector<std::uint32_t> level(nodes.size(), 0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (level[n] > most_levels) return true;
    if (nodes[n].second_child == 0) continue;
    level[n + 1] = level[nodes[n].second_child] = level[n] + 1;
  }
  return false;
}

}  // namespace

void Tree_layout::save(State_writer& state) const {
  state.list(nodes_);
  state.list(face_begin_);
  state.list(vertex_begin_);
  state.list(std::span(faces_).first(face_begin_.back()));
  state.list(std::span(vertices_).first(vertex_begin_.back()));
  state.list(std::span(corners_).first(face_begin_.back()));
}

Tree_layout Tree_layout::load(State_reader& state, std::span<const Corners> corners, std::size_t vertex_count) {
  Tree_layout layout;
  layout.nodes_ = state.list<Node>();
  layout.face_begin_ = state.list<std::uint32_t>();
  layout.vertex_begin_ = state.list<std::uint32_t>();
  state.list(layout.faces_);
  state.list(layout.vertices_);
  state.list(layout.corners_);
  for (std::uint32_t n = 0; n < layout.nodes_.size(); ++n)
    if (layout.is_leaf(n)) layout.leaf_nodes_.push_back(n);

  const std::size_t leaves = layout.leaf_count();
  State_reader::require(are_begins(layout.face_begin_, leaves, layout.faces_.size(), most_leaf_faces) &&
                            are_begins(layout.vertex_begin_, leaves, layout.vertices_.size(), 3 * most_leaf_faces) &&
                            layout.corners_.size() == layout.faces_.size(),
                        "its tree has lists of other lengths than it needs");
  if (const std::string wrong = layout.validate_layout(corners, vertex_count); !wrong.empty())
    State_reader::fail(wrong);
  State_reader::require(!is_too_deep(layout.nodes_), "its tree has too many levels");
  layout.corners_.resize(layout.corners_.size() + kernel::faces_ahead, {});
  layout.finish();
  return layout;
}

}  // namespace lodestone
