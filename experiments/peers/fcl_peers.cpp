// SPDX-License-Identifier: GPL-3.0-or-later
// FCL: one hierarchy per object, refitted bottom-up, for each of its bounding volumes.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/kDOP.h>
#include <fcl/math/bv/kIOS.h>
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <cstring>
#include <limits>

#include "peers/peer.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

/// FCL's traversal for a bounding volume. Volumes without an orientation share one, which may change the models;
/// each oriented volume has its own.
template <class Volume>
struct Traversal {
  using Model = fcl::BVHModel<Volume>;
  using Node = fcl::detail::MeshCollisionTraversalNode<Volume>;
};
template <class Volume>
struct Oriented_traversal {
  using Model = const fcl::BVHModel<Volume>;
};
template <>
struct Traversal<fcl::OBBd> : Oriented_traversal<fcl::OBBd> {
  using Node = fcl::detail::MeshCollisionTraversalNodeOBBd;
};
template <>
struct Traversal<fcl::RSSd> : Oriented_traversal<fcl::RSSd> {
  using Node = fcl::detail::MeshCollisionTraversalNodeRSSd;
};
template <>
struct Traversal<fcl::OBBRSSd> : Oriented_traversal<fcl::OBBRSSd> {
  using Node = fcl::detail::MeshCollisionTraversalNodeOBBRSSd;
};
template <>
struct Traversal<fcl::kIOSd> : Oriented_traversal<fcl::kIOSd> {
  using Node = fcl::detail::MeshCollisionTraversalNodekIOSd;
};

/// A traversal that gives up after `patience`. FCL calls `canStop` between any two nodes.
template <class Volume>
class Impatient_node : public Traversal<Volume>::Node {
 public:
  bool canStop() const override {
    if (++asked_ % steps == 0 && timer_.seconds() > patience) throw Gave_up();
    return Traversal<Volume>::Node::canStop();
  }

 private:
  static constexpr std::size_t steps = std::size_t{1} << 16;  // between two looks at the clock

  mutable std::size_t asked_ = 0;
  Lap_timer timer_;
};

template <class Volume>
class Fcl_peer : public Peer {
 public:
  void add(const Moving_mesh& mesh) override {
    auto& object = objects_.emplace_back(Object{mesh, std::make_unique<Model>(), {}});
    object.read_positions();
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.corners.size());
    for (const auto& [p, q, r] : mesh.corners) triangles.emplace_back(p, q, r);
    object.model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(object.positions.size()));
    object.model->addSubModel(object.positions, triangles);
    object.model->endModel();
  }

  void update(std::size_t object_index) override {
    auto& object = objects_[object_index];
    object.read_positions();
    object.model->beginReplaceModel();
    object.model->replaceSubModel(object.positions);
    object.model->endReplaceModel(true, true);
  }

  bool any(std::size_t a, std::size_t b) override {
    traverse(a, b, 1);
    return result_.isCollision();
  }

  void all(std::size_t a, std::size_t b, std::vector<Face_pair>& found) override {
    traverse(a, b, std::numeric_limits<std::size_t>::max());
    for (std::size_t i = 0; i < result_.numContacts(); ++i) {
      const auto& contact = result_.getContact(i);
      found.push_back({static_cast<std::uint32_t>(contact.b1), static_cast<std::uint32_t>(contact.b2)});
    }
  }

 private:
  using Model = fcl::BVHModel<Volume>;

  struct Object {
    Moving_mesh mesh;
    std::unique_ptr<Model> model;
    std::vector<fcl::Vector3d> positions;

    void read_positions() {
      static_assert(sizeof(fcl::Vector3d) == sizeof(Point));
      const auto coordinates = mesh.coordinates();
      positions.resize(mesh.points().size());
      std::memcpy(positions.data()->data(), coordinates.data(), coordinates.size_bytes());
    }
  };

  /// Does what `fcl::collide` does after its dispatch, but directly on the models. For volumes without an orientation
  /// `fcl::collide` copies both models in every query.
  void traverse(std::size_t a, std::size_t b, std::size_t most_contacts) {
    const fcl::CollisionRequestd request(most_contacts, false);
    fcl::Transform3d still_a = fcl::Transform3d::Identity(), still_b = still_a;
    result_.clear();
    typename Traversal<Volume>::Model &model_a = *objects_[a].model, &model_b = *objects_[b].model;
    Impatient_node<Volume> node;
    initialize(static_cast<typename Traversal<Volume>::Node&>(node), model_a, still_a, model_b, still_b, request,
               result_);
    fcl::detail::collide(&node);
  }

  std::vector<Object> objects_;
  fcl::CollisionResultd result_;
};

template <class Volume>
Peer_kind kind(const char* volume) {
  return {.entry = {.library = "FCL", .method = "refit", .volume = volume},
          .make = []() -> std::unique_ptr<Peer> { return std::make_unique<Fcl_peer<Volume>>(); }};
}

}  // namespace

std::vector<Peer_kind> fcl_peers() {
  return {kind<fcl::AABBd>("AABB"),
          kind<fcl::OBBd>("OBB"),
          kind<fcl::RSSd>("RSS"),
          kind<fcl::OBBRSSd>("OBBRSS"),
          kind<fcl::kIOSd>("kIOS"),
          kind<fcl::KDOP<double, 16>>("KDOP16"),
          kind<fcl::KDOP<double, 24>>("KDOP24")};
}

}  // namespace lodestone
