// SPDX-License-Identifier: GPL-3.0-or-later
// ODE: triangle meshes in OPCODE's box hierarchy, refitted. It merges contacts and has no list of face pairs.
#include <ode/ode.h>

#include "peers/peer.h"

namespace lodestone {

namespace {

/// Initialises the library, and closes it again.
class Library {
 public:
  Library() { dInitODE2(0); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { dCloseODE(); }
};

class Ode_peer : public Peer {
 public:
  ~Ode_peer() override {
    for (const auto& [data, geometry] : objects_) {
      dGeomDestroy(geometry);
      dGeomTriMeshDataDestroy(data);
    }
  }

  /// ODE keeps a pointer to the positions and reads them in every call.
  void add(const Moving_mesh& mesh) override {
    const auto data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, mesh.coordinates().data(), sizeof(Point), static_cast<int>(mesh.points().size()),
                                mesh.corners.data(), static_cast<int>(3 * mesh.corners.size()), sizeof(Corners));
    objects_.push_back({data, dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr)});
  }

  void update(std::size_t object) override { dGeomTriMeshDataUpdate(objects_[object].data); }

  bool any(std::size_t a, std::size_t b) override {
    dContactGeom contact;
    return dCollide(objects_[a].geometry, objects_[b].geometry, 1 | CONTACTS_UNIMPORTANT, &contact, sizeof(contact)) >
           0;
  }

  void all(std::size_t /*a*/, std::size_t /*b*/, std::vector<Face_pair>& /*found*/) override {}

 private:
  struct Object {
    dTriMeshDataID data;
    dGeomID geometry;
  };

  Library library_;
  std::vector<Object> objects_;
};

}  // namespace

std::vector<Peer_kind> ode_peers() {
  return {{.entry = {.library = "ODE", .method = "OPCODE, refit", .volume = "AABB", .reports_pairs = false},
           .make = []() -> std::unique_ptr<Peer> { return std::make_unique<Ode_peer>(); }}};
}

}  // namespace lodestone
