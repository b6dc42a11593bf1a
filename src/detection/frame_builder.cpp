// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/frame_builder.h"

#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

Frame_builder::Frame_builder(const Detector_options& options)
    : points_(options.contact_points || options.exact.patches),
      normals_(options.contact_normals || options.exact.patches),
      patches_(options.exact.patches),
      contacts_may_be_apart_(has_tolerance(options.exact)) {}

void Frame_builder::reserve(std::size_t pairs, std::size_t face_pairs) {
  frame_.pairs.reserve(pairs);
  frame_.face_pairs.reserve(face_pairs);
}

void Frame_builder::start(const Frame_statistics& statistics) {
  ++frame_.number;
  clear_pairs();
  frame_.statistics = statistics;
}

void Frame_builder::clear_pairs() {
  frame_.pairs.clear();
  frame_.face_pairs.clear();
  frame_.contact_intersects.clear();
  frame_.contact_points.clear();
  frame_.contact_normals.clear();
  frame_.patches.clear();
  frame_.candidates.clear();
  frame_.object_iterations.clear();
}

void Frame_builder::add_patches(const Object_surface& a, const Object_surface& b, double tolerance, Workers& workers) {
  if (!patches_) return;
  Pair_result& pair = frame_.pairs.back();
  const auto of_pair = [&pair](const auto& list) { return std::span(list).subspan(pair.first_contact, pair.contacts); };
  const Contact_geometry contacts{frame_.contacts(pair), of_pair(frame_.contact_points),
                                  of_pair(frame_.contact_normals)};
  for (Contact_patch& patch : contact_patches(a, b, contacts, tolerance, workers))
    frame_.patches.push_back(std::move(patch));
  pair.patches = frame_.patches.size() - pair.first_patch;
}

const Frame& Frame_builder::finish() {
  frame_.statistics.object_candidates = frame_.pairs.size();
  frame_.statistics.contacts = frame_.face_pairs.size();
  return frame_;
}

void Frame_builder::make_room_for_geometry() {
  if (points_) frame_.contact_points.resize(frame_.face_pairs.size());
  if (normals_) frame_.contact_normals.resize(frame_.face_pairs.size());
}

/// Contacts of intersecting faces together; those that are apart one by one.
void Frame_builder::add_geometry(std::span<const Triangle_pair> faces, std::size_t first) {
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i;
    while (end < faces.size() && frame_.intersects(first + end)) ++end;
    add_intersections(faces.subspan(i, end - i), first + i);
    if (end < faces.size()) add_gap(closest_points(faces[end].a, faces[end].b), first + end);
    i = end + 1;
  }
}

void Frame_builder::add_intersections(std::span<const Triangle_pair> faces, std::size_t first) {
  const auto of_faces = [&](auto& list) { return std::span(list).subspan(first, faces.size()); };
  if (points_) triangle_intersections(faces, of_faces(frame_.contact_points));
  if (normals_) contact_normals(faces, of_faces(frame_.contact_normals));
}

void Frame_builder::add_gap(const Closest_points& nearest, std::size_t contact) {
  if (points_) frame_.contact_points[contact] = {nearest.a, nearest.b};
  if (normals_) frame_.contact_normals[contact] = gap_normal(nearest);
}

}  // namespace lodestone
