// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/filter/face_filter.h"

#include <algorithm>
#include <limits>

#include "filter/face_columns.h"
#include "filter/face_filter_kernel.h"
#include "filter/filter_request.h"
#include "filter/filter_scratch.h"
#include "tree/shared_vertices.h"

namespace lodestone {

namespace {

/// Leaves that are kept per tree: a walk meets most leaves again soon or not at all.
constexpr std::size_t slot_count = 32;
constexpr auto no_leaf = std::numeric_limits<std::uint32_t>::max();

/// The vertices that all faces of a leaf have.
const Shared_vertices& shared_by(const Tree_layout& layout, std::uint32_t leaf, Face_columns& faces) {
  if (!faces.knows_shared) {
    faces.shared = shared_vertices(layout, leaf);
    faces.knows_shared = true;
  }
  return faces.shared;
}

}  // namespace

struct Face_filter::Alone {
  kernel::Filter_request request;
  std::array<Face_columns, 2> faces;
};

Face_filter::Face_filter()
    : request_(std::make_unique<kernel::Filter_request>()),
      scratch_(std::make_unique_for_overwrite<Filter_scratch>()) {}
Face_filter::~Face_filter() = default;
Face_filter::Face_filter(Face_filter&&) noexcept = default;
Face_filter& Face_filter::operator=(Face_filter&&) noexcept = default;

void Face_filter::Side::begin(const Layout_view& tree) {
  view = tree;
  slots.resize(slot_count);
  for (Slot& slot : slots) slot.leaf = no_leaf;
}

Face_filter::Slot& Face_filter::Side::slot_of(std::uint32_t leaf) {
  Slot& slot = slots[leaf % slot_count];
  if (!slot.faces) slot.faces = std::make_unique_for_overwrite<Face_columns>();
  if (slot.leaf != leaf) {
    slot.leaf = leaf;
    slot.faces->clear();
    if (view.boxes.empty()) slot.box.enclose(view.leaf(leaf));
  }
  return slot;
}

kernel::Leaf_input Face_filter::Side::input(std::uint32_t leaf) {
  Slot& slot = slot_of(leaf);
  const auto& [layout, coordinates, bounds, boxes] = view;
  return {.coordinates = coordinates.data(),
          .vertices = layout->vertices(leaf).data(),
          .corners = layout->corners(leaf).data(),
          .vertex_count = layout->vertices(leaf).size(),
          .face_count = layout->faces(leaf).size(),
          .box = boxes.empty() ? &slot.box : &boxes[layout->leaf_node(leaf)],
          .faces = slot.faces.get()};
}

void Face_filter::begin(const Layout_view& a, const Layout_view& b, double margin) {
  sides_[0].begin(a);
  sides_[1].begin(b);
  *request_ = filter_request(a.bounds, b.bounds, margin);
}

void Face_filter::begin_within(const Layout_view& tree, double margin) {
  begin(tree, tree, margin);
  request_->one_mesh = true;
}

/// Fine parts of a coarse surface: steps that span the surface would leave all pairs of their faces. What is rounded
/// depends on the two leaves alone, and is not kept: candidates must not depend on the order in which leaves meet.
const kernel::Filter_request& Face_filter::round_alone(kernel::Leaf_input& a, kernel::Leaf_input& b) {
  if (!alone_) alone_ = std::make_unique_for_overwrite<Alone>();
  auto& [request, faces] = *alone_;
  request = filter_request(*a.box, *b.box, request_->margin);
  request.one_mesh = request_->one_mesh;
  request.one_leaf = request_->one_leaf;
  for (Face_columns& columns : faces) columns.clear();
  a.faces = &faces[0];
  b.faces = &faces[1];
  return request;
}

std::span<const Face_candidate> Face_filter::face_candidates(std::uint32_t leaf_a, std::uint32_t leaf_b) {
  const bool one_mesh = request_->one_mesh;
  request_->one_leaf = one_mesh && leaf_a == leaf_b;
  auto a = sides_[0].input(leaf_a);
  // One tree has its leaves in one side, so that each is read once. The second side is for two leaves of one slot.
  const bool one_side = one_mesh && (leaf_a == leaf_b || leaf_a % slot_count != leaf_b % slot_count);
  auto b = sides_[one_side ? 0 : 1].input(leaf_b);
  const Tree_layout& layout = *sides_[0].view.layout;
  // All pairs of such leaves share a vertex. To look at each would take n^2 steps for n faces around one vertex.
  if (one_mesh && have_one_in_common(shared_by(layout, leaf_a, *a.faces), shared_by(layout, leaf_b, *b.faces)))
    return {};
  candidates_.resize(std::max(candidates_.size(), a.face_count * b.face_count + most_float_lanes));
  const auto& request = is_too_coarse(*request_, *a.box, *b.box) ? round_alone(a, b) : *request_;
  const std::size_t count = kernel::face_candidates(a, b, request, *scratch_, candidates_.data());
  return {candidates_.data(), count};
}

}  // namespace lodestone
