// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/frame_at_once.h"

#include <algorithm>

#include "lodestone/detection/frame_builder.h"
#include "lodestone/mesh/arithmetic.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/overlap_search.h"
#include "lodestone/queries/surface_triangle.h"

namespace lodestone {

namespace {

/// The triangle of a face that is among those in the box.
Triangle triangle_in(const Faces_in_box& faces, std::uint32_t face) {
  const auto found = std::ranges::lower_bound(faces.faces, face);
  const Corners& corners = faces.corners[static_cast<std::size_t>(found - faces.faces.begin())];
  return face_triangle(corners, [&](auto corner) { return faces.coordinates.data() + 3 * std::size_t{corner}; });
}

void count_tests(const Contact_summary& contacts, Pair_result& result, Frame_statistics& statistics) {
  result.leaf_tests = statistics.leaf_tests = contacts.leaf_tests;
  statistics.exact_tests = contacts.exact_tests;
}

/// The contacts of faces that may meet, by trees of them.
Contact_summary contacts_by_trees(const Faces_in_box& a, const Faces_in_box& b, const Detector_options& options,
                                  std::vector<Face_pair>& found) {
  Workers workers(options.threads);
  Tree_surface tree_a(a.corners), tree_b(b.corners);
  tree_a.build({}, a.coordinates, options.tree, workers);
  tree_b.build({}, b.coordinates, options.tree, workers);
  const Contact_summary contacts = Contact_search(workers).between(tree_a, tree_b, {.query = options.contacts}, found);
  // Faces of a box are in the order of the mesh, so that pairs stay sorted.
  for (Face_pair& pair : found) pair = {a.faces[pair.a], b.faces[pair.b]};
  return contacts;
}

Contact_summary contacts_of(const Overlapping_surfaces& surfaces, const Detector_options& options,
                            std::vector<Face_pair>& found) {
  const auto& [box_a, box_b, a, b] = surfaces;
  Overlap_search search;
  if (const auto contacts = search.run(a, box_a, b, box_b, options.contacts, found)) return *contacts;
  found.clear();
  Contact_summary contacts = contacts_by_trees(a, b, options, found);
  contacts.leaf_tests += search.leaf_tests();
  contacts.exact_tests += search.exact_tests();
  return contacts;
}

/// Of surfaces whose boxes overlap.
Frame contact_frame(const Overlapping_surfaces& surfaces, const Detector_options& options) {
  Frame_builder builder(options);
  builder.start();
  timed(builder.seconds().confirmation, [&] {
    Pair_result result = builder.start_pair({0, 1});
    const Contact_summary contacts = contacts_of(surfaces, options, builder.face_pairs());
    result.collides = contacts.found;
    count_tests(contacts, result, builder.statistics());
    builder.end_pair(
        result, [&](Object_id id, std::uint32_t face) { return triangle_in(id == 0 ? surfaces.a : surfaces.b, face); });
  });
  return builder.take();
}

}  // namespace

bool can_answer_at_once(const Detector_options& options) {
  check(options);
  const Exact_options& exact = options.exact;
  const bool limited =
      options.contacts == Contact_query::all && options.most_contacts < Detector_options().most_contacts;
  return options.mode == Mode::exact && exact.tolerance == 0 && !exact.containment && !exact.parting &&
         !exact.patches && !limited;
}

void make_overlap_frame(const Overlapping_surfaces& surfaces, const Detector_options& options, double reading,
                        Frame& frame) {
  check_arithmetic();
  if (surfaces.box_a.intersects(surfaces.box_b)) frame = contact_frame(surfaces, options);
  frame.number = 1;
  frame.statistics.seconds.broad_phase = reading;
}

Frame self_frame(std::span<const Corners> corners, Coordinates coordinates, const Detector_options& options) {
  check_arithmetic();
  Frame_builder builder(options);
  builder.start();
  builder.statistics().vertices_read = coordinates.size() / 3;
  builder.statistics().builds = 1;
  Workers workers(options.threads);
  Tree_surface surface(corners);
  const double tolerance = options.exact.self_tolerance;
  timed(builder.seconds().build, [&] {
    surface.build({}, coordinates, options.tree, workers);
    if (tolerance > 0) surface.keep_rest();
  });
  timed(builder.seconds().confirmation, [&] {
    Pair_result result = builder.start_pair({0, 0});
    const Contact_summary contacts = Contact_search(workers).within(
        surface, {.query = options.contacts, .tolerance = tolerance, .most = options.most_contacts},
        builder.face_pairs());
    // All faces are where they are at rest, where a pair that is only near is not reported: see `self_tolerance`.
    result.collides = contacts.found;
    result.near = tolerance > 0 && contacts.found;
    result.capped = contacts.capped;
    count_tests(contacts, result, builder.statistics());
    builder.end_pair(
        result, [&](Object_id, std::uint32_t face) { return surface_triangle(surface, face); }, workers);
    builder.add_patches(surface, surface, tolerance, workers);
  });
  return builder.take();
}

}  // namespace lodestone
