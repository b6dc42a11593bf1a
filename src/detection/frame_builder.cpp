// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/frame_builder.h"

#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

Frame_builder::Frame_builder(const Detector_options& options)
    : points_(options.contact_points || options.exact.patches),
      normals_(options.contact_normals || options.exact.patches),
      patches_(options.exact.patches),
      contacts_may_be_apart_(options.exact.tolerance > 0 || options.exact.self_tolerance > 0) {}

void Frame_builder::reserve(std::size_t pairs, std::size_t face_pairs) {
  frame_.pairs.reserve(pairs);
  frame_.face_pairs.reserve(face_pairs);
}

void Frame_builder::start(const Frame_statistics& statistics) {
  ++frame_.number;
  frame_.pairs.clear();
  frame_.face_pairs.clear();
  frame_.contact_points.clear();
  frame_.contact_normals.clear();
  frame_.patches.clear();
  frame_.candidates.clear();
  frame_.statistics = statistics;
}

void Frame_builder::add_patches(const Object_surface& a, const Object_surface& b, double tolerance) {
  if (!patches_) return;
  Pair_result& pair = frame_.pairs.back();
  const auto of_pair = [&pair](const auto& list) { return std::span(list).subspan(pair.first_contact, pair.contacts); };
  const Contact_geometry contacts{frame_.contacts(pair), of_pair(frame_.contact_points),
                                  of_pair(frame_.contact_normals)};
  for (Contact_patch& patch : contact_patches(a, b, contacts, tolerance)) frame_.patches.push_back(std::move(patch));
  pair.patches = frame_.patches.size() - pair.first_patch;
}

const Frame& Frame_builder::finish() {
  frame_.statistics.object_candidates = frame_.pairs.size();
  frame_.statistics.contacts = frame_.face_pairs.size();
  return frame_;
}

void Frame_builder::add_geometry(const Triangle& a, const Triangle& b) {
  if (contacts_may_be_apart_ && !triangles_intersect(a, b)) {
    const Closest_points nearest = closest_points(a, b);
    if (points_) frame_.contact_points.push_back({nearest.a, nearest.b});
    if (normals_) frame_.contact_normals.push_back(gap_normal(nearest));
    return;
  }
  if (points_) frame_.contact_points.push_back(triangle_intersection(a, b));
  if (normals_) frame_.contact_normals.push_back(contact_normal(a, b));
}

}  // namespace lodestone
