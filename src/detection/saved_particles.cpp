// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "lodestone/detection/particle_object.h"

namespace lodestone {

namespace {

void save_extent(const Region_extent& extent, State_writer& state) {
  for (const Border_path& path : extent.paths) {
    state.value(path.length);
    state.list(path.samples);
    state.value(path.sampled_length);
  }
}

Region_extent load_extent(State_reader& state, std::size_t vertex_count) {
  Region_extent extent;
  for (Border_path& path : extent.paths) {
    path.length = state.finite();
    path.samples = state.list<std::uint32_t>();
    path.sampled_length = state.finite();
    State_reader::require(std::ranges::all_of(path.samples, [&](auto v) { return v < vertex_count; }),
                          "a path to a border leads to a vertex that does not exist");
  }
  return extent;
}

}  // namespace

void Particle_object::save(State_writer& state) const {
  std::vector<std::uint32_t> joined;
  if (seams_)
    for (std::uint32_t v = 0; v < mesh_->vertex_count(); ++v) joined.push_back(seams_->joined(v));
  state.list(joined);
  state.list(labels_);
  state.list(particles_.at);
  state.value(particles_.effective_radius);
  state.value(particles_.collision_distance);
  state.value(std::uint64_t{particles_.hop_limit});
  state.value(std::uint64_t{rings_});
  state.value(std::uint64_t{homes_.size()});
  for (const Home& home : homes_) {
    state.value(home.vertex);
    state.value(home.compass);
    state.value(home.angle);
  }
  for (const auto& extent : extents_) save_extent(extent, state);
  state.value(last_checked_);
  state.value(largest_area_);
  state.value(rest_compass_);
  state.value(std::uint32_t{tree_.layout().node_count() > 0});
  if (tree_.layout().node_count() == 0) return;
  tree_.save(state);
  region_anchors_.save(state);
}

/// What is read before anything of the object changes.
struct Particle_object::Saved {
  std::vector<std::uint32_t> joined;  ///< V: see `seams_of`; empty: no seams
  std::vector<Region_index> labels;
  Particles particles;
  std::size_t rings = 0;
  std::vector<Home> homes;
  std::vector<Region_extent> extents;
  Region_index last_checked = 0;
  double largest_area = 0, rest_compass = 0;
  Tree_on_demand tree;
  Region_anchors regions;

  Saved(State_reader& state, Built built, std::span<const Corners> corners, std::size_t vertex_count);
  void load_homes(State_reader& state, Built built, std::size_t vertex_count);
  void check(Built built, std::span<const Corners> corners, std::size_t vertex_count) const;
  void check_places(std::span<const Corners> corners) const;
};

Particle_object::Saved::Saved(State_reader& state, Built built, std::span<const Corners> corners,
                              std::size_t vertex_count) {
  joined = state.list<std::uint32_t>();
  labels = state.list<Region_index>();
  particles.at = state.list<std::uint32_t>();
  particles.positions.resize(particles.at.size());
  particles.effective_radius = state.finite();
  particles.collision_distance = state.finite();
  particles.hop_limit = state.value<std::uint64_t>();
  rings = state.value<std::uint64_t>();
  load_homes(state, built, vertex_count);
  last_checked = state.value<Region_index>();
  largest_area = state.finite();
  rest_compass = state.finite();
  const auto has_tree = state.value<std::uint32_t>();
  check(built, corners, vertex_count);
  State_reader::require(has_tree == std::uint32_t{built.meetings}, built.meetings
                                                                       ? "it does not have the tree that meetings need"
                                                                       : "it has a tree, which this mode does not use");
  if (!built.meetings) return;
  tree = Tree_on_demand::load(state, corners, vertex_count);
  regions = Region_anchors::load(state, tree.layout(), particles.at.size());
}

void Particle_object::Saved::load_homes(State_reader& state, Built built, std::size_t vertex_count) {
  const auto count = state.value<std::uint64_t>();
  State_reader::require(count == (built.regions ? particles.at.size() : 0),
                        built.regions ? "it does not have one home for each particle"
                                      : "it has homes of particles, which scattered ones do not have");
  homes.resize(count);
  for (Home& home : homes) {
    home.vertex = state.value<std::uint32_t>();
    home.compass = state.value<std::uint32_t>();
    home.angle = state.finite();
  }
  for (std::size_t region = 0; region < count; ++region) extents.push_back(load_extent(state, vertex_count));
}

void Particle_object::Saved::check(Built built, std::span<const Corners> corners, std::size_t vertex_count) const {
  State_reader::require(joined.empty() || joined.size() == vertex_count,
                        "its seams do not have one entry for each vertex");
  State_reader::require(std::ranges::all_of(joined, [&](auto v) { return v < vertex_count; }),
                        "a vertex is joined to one that does not exist");
  State_reader::require(labels.size() == vertex_count, "it does not have one region for each vertex");
  State_reader::require(particles.hop_limit <= vertex_count && rings <= vertex_count, "it reaches too many hops");
  check_places(corners);
  // Scattered particles are all in one region.
  const std::size_t region_count = built.regions ? particles.at.size() : 1;
  State_reader::require(std::ranges::all_of(labels, [&](auto label) { return label < region_count; }),
                        "a vertex is in a region that does not exist");
  for (std::size_t region = 0; region < homes.size(); ++region)
    State_reader::require(labels[particles.at[region]] == region, "a particle is not in its region");
}

/// Particles and the edges by which directions are found are where the surface has faces, with seams closed. Where all
/// faces are points, particles may be anywhere, and there may be none.
void Particle_object::Saved::check_places(std::span<const Corners> corners) const {
  const auto place_of = [&](std::uint32_t vertex) { return joined.empty() ? vertex : joined[vertex]; };
  std::vector<bool> has_faces(labels.size(), false);
  bool has_edge = false;
  for (const auto& [a, b, c] : corners) {
    for (const auto vertex : {a, b, c}) has_faces[place_of(vertex)] = true;
    has_edge = has_edge || place_of(a) != place_of(b) || place_of(b) != place_of(c);
  }
  State_reader::require(!particles.at.empty() || !has_edge, "it has no particle");
  const auto on_surface = [&](std::uint32_t vertex) {
    return vertex < has_faces.size() && (has_faces[vertex] || !has_edge);
  };
  State_reader::require(std::ranges::all_of(particles.at, on_surface), "a particle is not on the surface");
  State_reader::require(
      std::ranges::all_of(homes, [&](const Home& home) { return on_surface(home.vertex) && on_surface(home.compass); }),
      "a particle has not started on the surface");
}

void Particle_object::load(State_reader& state, Built built) {
  Saved saved(state, built, corners(), mesh_->vertex_count());
  state.end();
  std::optional<Closed_seams> seams;
  if (!saved.joined.empty()) {
    seams = seams_of(corners(), saved.joined);
    State_reader::require(seams.has_value(), "its seams are none");
    if (!mesh_->divides_by_index())
      throw Bad_saved_object("the object was saved with closed seams, which this strategy cannot divide");
  }
  if (seams || seams_)
    walk_along(std::move(seams));
  else
    find_edges();
  Region_steps steps(edges_.graph, saved.labels);
  Leaf_neighbours neighbours;
  if (built.meetings) neighbours = Leaf_neighbours(saved.tree.layout(), corners().size());
  // From here on nothing can fail but for want of memory.
  steps_ = std::move(steps);
  labels_ = std::move(saved.labels);
  particles_ = std::move(saved.particles);
  homes_ = std::move(saved.homes);
  extents_ = std::move(saved.extents);
  last_checked_ = saved.last_checked;
  largest_area_ = saved.largest_area;
  rest_compass_ = saved.rest_compass;
  tree_ = std::move(saved.tree);
  neighbours_ = std::move(neighbours);
  region_anchors_ = std::move(saved.regions);
  last_stretch_ = 1;
  if (!built.regions)
    start_patches(saved.rings);
  else if (!built.meetings)
    prepare_patches();
}

}  // namespace lodestone
