// SPDX-License-Identifier: GPL-3.0-or-later
// Bullet: the quantised box hierarchy of a GImpact mesh, refitted, and its triangle test.
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include "peers/peer.h"
#include "shared/read_bound.h"

namespace lodestone {

namespace {

class Bullet_peer : public Peer {
 public:
  void add(const Moving_mesh& mesh) override {
    auto& object = *objects_.emplace_back(std::make_unique<Object>());
    object.mesh = mesh;
    object.read_positions();
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(mesh.corners.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.corners.data());
    part.m_triangleIndexStride = sizeof(Corners);
    part.m_numVertices = static_cast<int>(mesh.points().size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(object.positions.data());
    part.m_vertexStride = sizeof(Local_position);
    part.m_vertexType = PHY_FLOAT;
    object.triangles.addIndexedMesh(part, PHY_INTEGER);
    object.shape = std::make_unique<btGImpactMeshShapePart>(&object.triangles, 0);
    object.shape->setMargin(0);
    object.shape->updateBound();
  }

  void update(std::size_t object) override {
    objects_[object]->read_positions();
    objects_[object]->shape->postUpdate();
    objects_[object]->shape->updateBound();
  }

  bool any(std::size_t a, std::size_t b) override {
    return visit(a, b, [](std::uint32_t, std::uint32_t) { return true; });
  }

  void all(std::size_t a, std::size_t b, std::vector<Face_pair>& found) override {
    visit(a, b, [&](std::uint32_t face_a, std::uint32_t face_b) {
      found.push_back({face_a, face_b});
      return false;
    });
  }

 private:
  using Local_position = std::array<float, 3>;

  struct Object {
    Moving_mesh mesh;
    Eigen::Vector3d centre;
    /// Relative to the centre, because a quantised tree keeps the bounds it was built with and misses what leaves them.
    std::vector<Local_position> positions;
    btTriangleIndexVertexArray triangles;
    std::unique_ptr<btGImpactMeshShapePart> shape;

    void read_positions() {
      centre = read_every_vertex(mesh.coordinates()).center();
      const auto points = mesh.points();
      positions.resize(points.size());
      for (std::size_t v = 0; v < points.size(); ++v)
        for (int axis = 0; axis < 3; ++axis) positions[v][axis] = static_cast<float>(points[v][axis] - centre[axis]);
    }
  };

  /// Calls `visitor` with the face pairs that Bullet finds, until it returns true.
  /// @return whether it returned true
  template <class Visitor>
  bool visit(std::size_t a, std::size_t b, const Visitor& visitor) {
    const Object &object_a = *objects_[a], &object_b = *objects_[b];
    const Eigen::Vector3d apart = object_b.centre - object_a.centre;
    const btTransform at_a = btTransform::getIdentity();
    const btTransform at_b(btQuaternion::getIdentity(),
                           btVector3(btScalar(apart.x()), btScalar(apart.y()), btScalar(apart.z())));
    candidates_.resizeNoInitialize(0);
    btGImpactBoxSet::find_collision(object_a.shape->getBoxSet(), at_a, object_b.shape->getBoxSet(), at_b, candidates_);

    object_a.shape->lockChildShapes();
    object_b.shape->lockChildShapes();
    bool stopped = false;
    for (int i = 0; i < candidates_.size() && !stopped; ++i) {
      btPrimitiveTriangle triangle_a, triangle_b;
      object_a.shape->getPrimitiveTriangle(candidates_[i].m_index1, triangle_a);
      object_b.shape->getPrimitiveTriangle(candidates_[i].m_index2, triangle_b);
      triangle_b.applyTransform(at_b);
      triangle_a.buildTriPlane();
      triangle_b.buildTriPlane();
      GIM_TRIANGLE_CONTACT contact;
      if (triangle_a.overlap_test_conservative(triangle_b) &&
          triangle_a.find_triangle_collision_clip_method(triangle_b, contact))
        stopped = visitor(static_cast<std::uint32_t>(candidates_[i].m_index1),
                          static_cast<std::uint32_t>(candidates_[i].m_index2));
    }
    object_b.shape->unlockChildShapes();
    object_a.shape->unlockChildShapes();
    return stopped;
  }

  std::vector<std::unique_ptr<Object>> objects_;
  btPairSet candidates_;
};

}  // namespace

std::vector<Peer_kind> bullet_peers() {
  return {{.entry = {.library = "Bullet", .method = "GImpact, refit", .volume = "AABB, quantised"},
           .make = []() -> std::unique_ptr<Peer> { return std::make_unique<Bullet_peer>(); }}};
}

}  // namespace lodestone
