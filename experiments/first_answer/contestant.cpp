// SPDX-License-Identifier: GPL-3.0-or-later
#include "first_answer/contestant.h"

#include <boost/container/static_vector.hpp>
#include <span>

#include "lodestone/find_collisions.h"
#include "peers/peer.h"

namespace lodestone {

namespace {

/// One call per question, which keeps nothing.
class One_call : public Session {
 public:
  One_call(const Surface_mesh& a, const Surface_mesh& b) : a_(a), b_(b) {}

  bool any() override { return find_collisions(a_, b_, {.contacts = Contact_query::yes_no}).collides; }
  void all(std::vector<Face_pair>& found) override { found = find_collisions(a_, b_).faces; }

 private:
  const Surface_mesh &a_, &b_;
};

class Detector_session : public Session {
 public:
  Detector_session(const Surface_mesh& a, const Surface_mesh& b, Contact_query query) : detector_({.contacts = query}) {
    detector_.add(a), detector_.add(b);
  }

  bool any() override { return detector_.detect(0, 1).collides(); }
  void all(std::vector<Face_pair>& found) override { found = detector_.detect(0, 1).face_pairs; }

 private:
  Detector<> detector_;
};

/// A library behind the interface of the experiment `peers`. Most take faces by index, so these are read from the meshes
/// first: a program that starts from meshes has to do that too.
class Peer_session : public Session {
 public:
  Peer_session(const Peer_kind& kind, const Surface_mesh& a, const Surface_mesh& b) : peer_(kind.make()) {
    for (const Surface_mesh* mesh : {&a, &b}) {
      if (!kind.takes_meshes) numberings_.emplace_back(*mesh);
      peer_->add({mesh, kind.takes_meshes ? std::span<const Corners>() : numberings_.back().corners()});
    }
  }

  void update() override {
    for (const std::size_t object : {0, 1}) peer_->update(object);
  }
  bool any() override { return peer_->any(0, 1); }
  void all(std::vector<Face_pair>& found) override { peer_->all(0, 1, found); }

 private:
  boost::container::static_vector<Mesh_numbering<Surface_mesh>, 2> numberings_;
  std::unique_ptr<Peer> peer_;
};

Once_contestant contestant_of(const Peer_kind& kind) {
  return {.library = kind.entry.library,
          .method = kind.entry.method + (kind.entry.library == "FCL" ? ", " + kind.entry.volume : ""),
          .reports_pairs = kind.entry.reports_pairs,
          .begin = [kind](const Surface_mesh& a, const Surface_mesh& b, Contact_query) -> std::unique_ptr<Session> {
            return std::make_unique<Peer_session>(kind, a, b);
          }};
}

}  // namespace

std::vector<Once_contestant> once_contestants() {
  std::vector<Once_contestant> all{
      {.library = "Lodestone",
       .method = "find_collisions",
       .begin = [](const Surface_mesh& a, const Surface_mesh& b, Contact_query) -> std::unique_ptr<Session> {
         return std::make_unique<One_call>(a, b);
       }},
      {.library = "Lodestone",
       .method = "Detector",
       .begin = [](const Surface_mesh& a, const Surface_mesh& b, Contact_query query) -> std::unique_ptr<Session> {
         return std::make_unique<Detector_session>(a, b, query);
       }}};
  auto peers = all_peers();
  peers.push_back(embree_built_well());
  for (const auto& kind : peers)
    if (kind.entry.threads == 1) all.push_back(contestant_of(kind));
  return all;
}

}  // namespace lodestone
