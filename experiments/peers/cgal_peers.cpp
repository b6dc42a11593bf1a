// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL: what a user of CGAL alone would write.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>

#include "lodestone/mesh/box.h"
#include "peers/peer.h"
#include "shared/read_bound.h"

namespace lodestone {

namespace {

using Triangle_3 = Kernel::Triangle_3;
using Face_box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

/// From the list of corners, or from the mesh itself where there is no list.
Corners corners_of(const Moving_mesh& mesh, std::uint32_t face) {
  if (!mesh.corners.empty()) return mesh.corners[face];
  const auto h = mesh.mesh->halfedge(Surface_mesh::Face_index(face));
  const auto next = mesh.mesh->next(h);
  return {mesh.mesh->source(h).idx(), mesh.mesh->target(h).idx(), mesh.mesh->target(next).idx()};
}

Triangle_3 triangle(const Moving_mesh& mesh, std::uint32_t face) {
  const auto points = mesh.points();
  const auto [p, q, r] = corners_of(mesh, face);
  return {points[p], points[q], points[r]};
}

/// `CGAL::Polygon_mesh_processing::do_intersect`.
class Do_intersect_peer : public Peer {
 public:
  void add(const Moving_mesh& mesh) override { meshes_.push_back(mesh); }
  void update(std::size_t /*object*/) override {}
  bool any(std::size_t a, std::size_t b) override {
    return CGAL::Polygon_mesh_processing::do_intersect(*meshes_[a].mesh, *meshes_[b].mesh);
  }
  void all(std::size_t /*a*/, std::size_t /*b*/, std::vector<Face_pair>& /*found*/) override {}

 private:
  std::vector<Moving_mesh> meshes_;
};

/// `CGAL::AABB_tree`, rebuilt in every frame. A query takes one triangle of the smaller mesh; only triangles that reach
/// the other mesh's box are queried.
class Tree_peer : public Peer {
 public:
  void add(const Moving_mesh& mesh) override {
    objects_.push_back({mesh, std::make_unique<Tree>()});
    update(objects_.size() - 1);
  }

  void update(std::size_t object) override {
    const auto& [mesh, tree] = objects_[object];
    tree->rebuild(faces(*mesh.mesh).begin(), faces(*mesh.mesh).end(), *mesh.mesh);
    tree->build();  // otherwise the first query builds it
  }

  bool any(std::size_t a, std::size_t b) override {
    const auto& [smaller, larger, swapped] = by_size(a, b);
    const auto bounds = larger->tree->bbox();
    for (std::uint32_t face = 0; face < smaller->mesh.corners.size(); ++face) {
      const auto query = triangle(smaller->mesh, face);
      if (CGAL::do_overlap(query.bbox(), bounds) && larger->tree->do_intersect(query)) return true;
    }
    return false;
  }

  void all(std::size_t a, std::size_t b, std::vector<Face_pair>& found) override {
    const auto& [smaller, larger, swapped] = by_size(a, b);
    const auto bounds = larger->tree->bbox();
    for (std::uint32_t face = 0; face < smaller->mesh.corners.size(); ++face) {
      const auto query = triangle(smaller->mesh, face);
      if (!CGAL::do_overlap(query.bbox(), bounds)) continue;
      hits_.clear();
      larger->tree->all_intersected_primitives(query, std::back_inserter(hits_));
      for (const auto hit : hits_) {
        const auto other = static_cast<std::uint32_t>(hit);
        found.push_back(swapped ? Face_pair{other, face} : Face_pair{face, other});
      }
    }
  }

 private:
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface_mesh>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

  struct Object {
    Moving_mesh mesh;
    std::unique_ptr<Tree> tree;
  };
  struct By_size {
    const Object *smaller, *larger;
    bool swapped;
  };

  By_size by_size(std::size_t a, std::size_t b) const {
    const bool swapped = objects_[b].mesh.corners.size() < objects_[a].mesh.corners.size();
    return swapped ? By_size{&objects_[b], &objects_[a], true} : By_size{&objects_[a], &objects_[b], false};
  }

  std::vector<Object> objects_;
  std::vector<Surface_mesh::Face_index> hits_;
};

/// Thrown to stop `CGAL::box_intersection_d`, which has no other way to stop early.
struct Found_one {};

/// `CGAL::box_intersection_d` on boxes around the faces: all faces, or those inside the overlap of the objects' boxes.
/// Of meshes that come without lists of corners, the first query reads the faces that it needs where they are; those of
/// the next frames read lists.
template <bool culled>
class Boxes_peer : public Peer {
 public:
  void add(const Moving_mesh& mesh) override {
    objects_.push_back({.mesh = mesh});
    read_bounds(objects_.back());
  }

  void update(std::size_t index) override {
    Object& object = objects_[index];
    if (object.mesh.corners.empty()) {
      object.numbering = std::make_unique<Mesh_numbering<Surface_mesh>>(*object.mesh.mesh);
      object.mesh.corners = object.numbering->corners();
    }
    read_bounds(object);
  }

  bool any(std::size_t a, std::size_t b) override {
    try {
      visit(a, b, [](std::uint32_t, std::uint32_t) { throw Found_one(); });
    } catch (const Found_one&) {
      return true;
    }
    return false;
  }

  void all(std::size_t a, std::size_t b, std::vector<Face_pair>& found) override {
    visit(a, b, [&](std::uint32_t face_a, std::uint32_t face_b) { found.push_back({face_a, face_b}); });
  }

 private:
  struct Object {
    Moving_mesh mesh;
    Box bounds = {};
    std::unique_ptr<Mesh_numbering<Surface_mesh>> numbering = nullptr;
  };

  static void read_bounds(Object& object) {
    if (culled) object.bounds = read_every_vertex(object.mesh.coordinates());
  }

  template <class Visitor>
  void visit(std::size_t a, std::size_t b, const Visitor& visitor) {
    const Moving_mesh &mesh_a = objects_[a].mesh, &mesh_b = objects_[b].mesh;
    const Box overlap = culled ? objects_[a].bounds.intersection(objects_[b].bounds) : Box();
    if (culled && overlap.isEmpty()) return;
    make_boxes(mesh_a, overlap, boxes_a_);
    make_boxes(mesh_b, overlap, boxes_b_);
    CGAL::box_intersection_d(boxes_a_.begin(), boxes_a_.end(), boxes_b_.begin(), boxes_b_.end(),
                             [&](const Face_box& face_a, const Face_box& face_b) {
                               if (CGAL::do_intersect(triangle(mesh_a, face_a.info()), triangle(mesh_b, face_b.info())))
                                 visitor(face_a.info(), face_b.info());
                             });
  }

  static void make_boxes(const Moving_mesh& mesh, const Box& overlap, std::vector<Face_box>& boxes) {
    const auto points = mesh.points();
    boxes.clear();
    for (std::uint32_t face = 0; face < mesh.mesh->number_of_faces(); ++face) {
      const auto [p, q, r] = corners_of(mesh, face);
      std::array<double, 3> low, high;
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min({points[p][axis], points[q][axis], points[r][axis]});
        high[axis] = std::max({points[p][axis], points[q][axis], points[r][axis]});
      }
      if (culled && !((low[0] <= overlap.max()[0]) & (high[0] >= overlap.min()[0]) & (low[1] <= overlap.max()[1]) &
                      (high[1] >= overlap.min()[1]) & (low[2] <= overlap.max()[2]) & (high[2] >= overlap.min()[2])))
        continue;
      boxes.emplace_back(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), face);
    }
  }

  std::vector<Object> objects_;
  std::vector<Face_box> boxes_a_, boxes_b_;
};

template <class Kind>
std::unique_ptr<Peer> make() {
  return std::make_unique<Kind>();
}

}  // namespace

std::vector<Peer_kind> cgal_peers() {
  const std::string library = "CGAL", no_tree = "boxes, no tree";
  return {{.entry = {.library = library, .method = "PMP::do_intersect", .volume = no_tree, .reports_pairs = false},
           .make = make<Do_intersect_peer>,
           .takes_meshes = true},
          {.entry = {.library = library, .method = "AABB_tree, rebuilt", .volume = "AABB"}, .make = make<Tree_peer>},
          {.entry = {.library = library, .method = "box_intersection_d, all faces", .volume = no_tree},
           .make = make<Boxes_peer<false>>,
           .takes_meshes = true},
          {.entry = {.library = library, .method = "box_intersection_d, overlap only", .volume = no_tree},
           .make = make<Boxes_peer<true>>,
           .takes_meshes = true}};
}

}  // namespace lodestone
