// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/rival.h"

#ifdef LODESTONE_PEERS
#include <array>

#include "peers/peer.h"
#endif

namespace lodestone {

#ifdef LODESTONE_PEERS

namespace {

struct Chosen_peer {
  const char *library, *method, *volume;
  std::size_t most_triangles = 0;  ///< as in Rival_kind
};
// FCL and ODE were the slowest at 100 000 triangles.
constexpr Chosen_peer chosen_peers[] = {{"CGAL", "box_intersection_d, overlap only", "boxes, no tree"},
                                        {"Embree", "refit", "AABB"},
                                        {"ODE", "OPCODE, refit", "AABB", 600'000},
                                        {"FCL", "refit", "AABB", 600'000}};

class Library_rival : public Rival {
 public:
  Library_rival(Character_scene& scene, std::unique_ptr<Peer> peer)
      : scene_(scene),
        numberings_{Mesh_numbering<Surface_mesh>(scene.characters[0].mesh),
                    Mesh_numbering<Surface_mesh>(scene.characters[1].mesh)},
        peer_(std::move(peer)) {
    pose_meshes(scene);
    for (const std::size_t i : {0, 1}) peer_->add({&scene.characters[i].mesh, numberings_[i].corners()});
  }

  std::optional<bool> any() override {
    follow();
    try {
      return peer_->any(0, 1);
    } catch (const Gave_up&) {
      return std::nullopt;
    }
  }
  bool all(std::vector<Face_pair>& found) override {
    follow();
    try {
      peer_->all(0, 1, found);
    } catch (const Gave_up&) {
      return false;
    }
    return true;
  }

 private:
  void follow() {
    pose_meshes(scene_);
    for (const std::size_t i : {0, 1}) peer_->update(i);
  }

  Character_scene& scene_;
  std::array<Mesh_numbering<Surface_mesh>, 2> numberings_;
  std::unique_ptr<Peer> peer_;
};

}  // namespace

std::vector<Rival_kind> library_kinds() {
  std::vector<Rival_kind> kinds;
  for (const auto& peer : all_peers())
    for (const auto& chosen : chosen_peers)
      if (peer.entry.library == chosen.library && peer.entry.method == chosen.method &&
          peer.entry.volume == chosen.volume)
        kinds.push_back({.name = "pose everything + " + peer.entry.name(),
                         .lists_pairs = peer.entry.reports_pairs,
                         .is_library = true,
                         .most_triangles = chosen.most_triangles,
                         .make = [make = peer.make](Character_scene& scene) -> std::unique_ptr<Rival> {
                           return std::make_unique<Library_rival>(scene, make());
                         }});
  return kinds;
}

#else

std::vector<Rival_kind> library_kinds() { return {}; }

#endif

}  // namespace lodestone
