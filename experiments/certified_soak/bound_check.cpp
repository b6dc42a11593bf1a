// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified_soak/bound_check.h"

#include "lodestone/bounds/placed_bound.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

namespace {

std::vector<double> positions_of(const Random_body& body) {
  std::vector<double> coordinates(3 * std::size_t{body.positions().vertex_count()});
  body.positions().pose_all(coordinates);
  return coordinates;
}

}  // namespace

Bound_check::Bound_check(const Random_body& body, std::size_t leaf_faces)
    : body_(body),
      corners_(Mesh_numbering<Surface_mesh>(body.mesh()).corners()),
      rest_(positions_of(body)),
      surface_(corners_, rest_, {.leaf_faces = leaf_faces}),
      bound_(body.bound({surface_.tree(), {}, rest_, body.positions()})) {}

/// @param placed  where a box of the bound comes to lie
template <class Placed>
void Bound_check::compare(Count& count, const Placed& placed) const {
  for (std::uint32_t node = 0; node < fitted_.size(); ++node) {
    ++count.boxes;
    if (!contains(placed(bound_->box(node)), fitted_[node])) ++count.outside;
  }
}

Bound_check::Count Bound_check::check(Random& random) {
  Count count;
  if (!bound_) return count;
  now_ = positions_of(body_);
  if (const auto placement = body_.placement()) {
    const Rigid_motion motion(*placement);
    std::vector<double> placed;
    fitted_ = fitted_boxes(surface_.tree(), motion(now_, placed));
    compare(count, [&](const Aabb& box) { return placed_box(motion.rotation(), motion.translation(), box); });
  }
  fitted_ = fitted_boxes(surface_.tree(), now_);
  compare(count, [](const Aabb& box) { return box; });
  const Tree_layout& layout = surface_.tree();
  if (random.one_in(4) && bound_->notes_all() && !bound_->note_all(fitted_, now_, true)) ++count.refused;
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf)
    if (random.one_in(4) && !bound_->note_read(leaf, fitted_[layout.leaf_node(leaf)], now_)) ++count.refused;
  return count;
}

}  // namespace lodestone
