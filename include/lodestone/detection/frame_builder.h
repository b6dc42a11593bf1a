// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"
#include "lodestone/mesh/workers.h"

namespace lodestone {

/// Makes the frames of a mode, pair by pair. Reuses its memory from frame to frame.
class Frame_builder {
 public:
  /// @param options  which points and normals a frame has; the tolerance below which faces are contacts
  explicit Frame_builder(const Detector_options& options);
  /// Makes room for so many pairs and contacts.
  void reserve(std::size_t pairs, std::size_t face_pairs);

  /// Starts the next frame: without pairs.
  /// @param statistics  what happened since the frame before
  void start(const Frame_statistics& statistics = {});

  /// Of the current frame, to be added to.
  Frame_statistics& statistics() { return frame_.statistics; }
  /// Of the current frame, to be added to.
  Stage_times& seconds() { return frame_.statistics.seconds; }
  /// Number of the frame, from 1.
  std::uint64_t number() const { return frame_.number; }
  /// The contacts of all pairs so far. A stage appends those of its pair between `start_pair` and `end_pair`.
  std::vector<Face_pair>& face_pairs() { return frame_.face_pairs; }
  /// `Frame::contact_intersects`, to be appended to. Contacts without an entry at the end of their pair intersect.
  std::vector<std::uint8_t>& contact_intersects() { return frame_.contact_intersects; }
  /// Candidate regions of all pairs so far, to be appended to.
  std::vector<Candidate_regions>& candidates() { return frame_.candidates; }
  /// `Frame::object_iterations`, to be written.
  std::vector<std::size_t>& object_iterations() { return frame_.object_iterations; }

  /// Starts a pair: what is appended from now on is its own.
  Pair_result start_pair(Object_pair pair) const {
    return {.a = pair.a, .b = pair.b, .first_contact = frame_.face_pairs.size(), .first_patch = frame_.patches.size()};
  }
  /// Ends a pair: counts its contacts, and computes their points and normals if the options ask for them.
  /// @param triangle_of  gives the triangle of an object's face: called with Object_id and face index, by any worker
  /// @param workers      that share the work
  template <class Triangle_of>
  void end_pair(Pair_result result, Triangle_of triangle_of, Workers& workers = Workers::alone()) {
    result.contacts = frame_.face_pairs.size() - result.first_contact;
    if (contacts_may_be_apart_) frame_.contact_intersects.resize(frame_.face_pairs.size(), 1);
    if (points_ || normals_) {
      make_room_for_geometry();
      const std::size_t batches = (result.contacts + most_faces - 1) / most_faces;
      Workers& sharing = batches < batches_worth_sharing ? Workers::alone() : workers;
      sharing.run(batches, [&](std::size_t batch, std::size_t) {
        Faces_in_contact faces;
        for (std::size_t i = first_of(batch, result); i < first_of(batch + 1, result); ++i) {
          const auto [face_a, face_b] = frame_.face_pairs[i];
          faces.push_back({triangle_of(result.a, face_a), triangle_of(result.b, face_b)});
        }
        add_geometry({faces.data(), faces.size()}, first_of(batch, result));
      });
    }
    frame_.pairs.push_back(result);
  }

  /// Groups the contacts of the last pair into contact patches, if the options ask for them.
  /// @param a, b       surfaces of its objects
  /// @param tolerance  below which faces are contacts
  /// @param workers    that share the work
  void add_patches(const Object_surface& a, const Object_surface& b, double tolerance,
                   Workers& workers = Workers::alone());

  /// Forgets what the pairs hold, to find it anew.
  void clear_pairs();

  /// Ends the frame: sums up what the pairs hold.
  const Frame& finish();
  /// The same, where the builder is not needed any more.
  Frame take() {
    finish();
    return std::move(frame_);
  }

 private:
  /// So many contacts share a pass, which stays in the caches.
  static constexpr std::size_t most_faces = 64;
  /// Fewer take less time than waking another thread.
  static constexpr std::size_t batches_worth_sharing = 8;

  using Faces_in_contact = boost::container::static_vector<Triangle_pair, most_faces>;

  /// The first contact of a batch of a pair's contacts; that past the last batch is past the last contact.
  static std::size_t first_of(std::size_t batch, const Pair_result& pair) {
    return pair.first_contact + std::min(batch * most_faces, pair.contacts);
  }
  void make_room_for_geometry();
  void add_geometry(std::span<const Triangle_pair> faces, std::size_t first);
  void add_intersections(std::span<const Triangle_pair> faces, std::size_t first);
  void add_gap(const Closest_points& nearest, std::size_t contact);

  bool points_, normals_, patches_;
  bool contacts_may_be_apart_;  ///< a contact can be two faces that are near without intersecting
  Frame frame_;
};

}  // namespace lodestone
