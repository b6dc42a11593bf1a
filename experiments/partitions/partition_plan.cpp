// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/partition_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <random>

#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/results/animation_output.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/errors.h"
#include "shared/made_object.h"

namespace lodestone {

namespace {

Eigen::Vector3d position(const Surface_mesh& mesh, Surface_mesh::Vertex_index v) { return coordinates(mesh.point(v)); }

void transform(Surface_mesh& mesh, double scale, const Eigen::Vector3d& centre) {
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d p = scale * (position(mesh, v) - centre);
    mesh.point(v) = Point(p.x(), p.y(), p.z());
  }
}

/// Moved to the origin and scaled, so that the farthest vertex is one unit from the mean.
Surface_mesh unit(Surface_mesh mesh) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto v : mesh.vertices()) centre += position(mesh, v);
  centre /= static_cast<double>(mesh.number_of_vertices());
  double radius = 0;
  for (const auto v : mesh.vertices()) radius = std::max(radius, (position(mesh, v) - centre).norm());
  transform(mesh, 1 / radius, centre);
  return mesh;
}

Surface_mesh knot(std::size_t segments, std::size_t sides) {
  return unit(torus_knot({.segments = segments, .sides = sides}));
}

constexpr auto meshes = std::to_array<Partition_mesh>({
    {"teapot_coarse", [] { return unit(teapot({.u = 6, .v = 6})); }, [] { return icosphere(8); }},
    {"teapot_fine", [] { return unit(teapot({.u = 13, .v = 12})); }, [] { return icosphere(16); }},
    {"sphere_coarse", [] { return icosphere(10); }, [] { return icosphere(8); }},
    {"sphere_fine", [] { return icosphere(22); }, [] { return icosphere(16); }},
    {"torus_knot_coarse", [] { return knot(120, 9); }, [] { return icosphere(8); }},
    {"torus_knot_fine", [] { return knot(280, 18); }, [] { return icosphere(16); }},
    {"cloth_coarse", [] { return unit(cloth(32, 32)); }, [] { return icosphere(8); }},
    {"cloth_fine", [] { return unit(cloth(71, 71)); }, [] { return icosphere(16); }},
});

constexpr double ball_radius = 0.5;
constexpr double frames_per_visit = 40;
constexpr std::size_t visits = 3;

/// Far from a place on the surface, then pressed into it by a fifth of the ball's radius, then away again.
void visit(const Eigen::Vector3d& place, double start, std::vector<Way_point>& way) {
  const Eigen::Vector3d outward = place.norm() > 1e-3 ? place.normalized() : Eigen::Vector3d(0, 0, 1);
  const auto at = [&](double frame, double distance) {
    const Eigen::Vector3d p = place + distance * outward;
    way.push_back({.frame = frame, .at = {p.x(), p.y(), p.z()}});
  };
  at(start, 2.2 * ball_radius);
  at(start + frames_per_visit / 2, 0.8 * ball_radius);
  at(start + frames_per_visit - 1, 2.2 * ball_radius);
}

/// A whole number below `end`, the same from any standard library.
std::size_t draw(std::mt19937_64& random, std::size_t end) { return static_cast<std::size_t>(random() % end); }

void add_lbg_variants(std::vector<Partition_variant>& variants) {
  Partition_variant other{.name = "lbg, multiplicative", .strategy = Lbg::name};
  other.settings.lbg.split_rule = Split::multiplicative;
  variants.push_back(other);
  variants.push_back({.name = "lbg, islands kept", .strategy = Lbg::name, .options = {.keep_islands = true}});
  for (const double weight : {0.1, 0.25, 0.5, 2.0, 4.0}) {
    Partition_variant weighted{.name = fmt::format("lbg, normals x {}", weight), .strategy = Lbg::name};
    weighted.settings.lbg.features.normal_weight = weight;
    variants.push_back(weighted);
  }
}

/// The numbers of regions into which a variant divides a mesh.
std::vector<std::size_t> counts_of(const Partition_variant& variant, const Partition_mesh& mesh) {
  if (variant.labels.empty()) return {std::begin(partition_counts), std::end(partition_counts)};
  std::vector<std::size_t> counts;
  for (const auto& labels : variant.labels)
    if (labels.mesh == mesh.name) counts.push_back(labels.regions);
  return counts;
}

bool fits(const Partition_variant& variant, const Partition_mesh& mesh) {
  if (!variant.labels.empty()) return true;
  const auto entry = std::ranges::find(strategies(), variant.strategy, &Strategy_entry::name);
  return mesh.make().number_of_vertices() <= entry->most_vertices;
}

template <class Named_list>
std::string joined_names(const Named_list& list) {
  std::vector<std::string> names;
  for (const auto& named : list) names.push_back(fmt::format("'{}'", named.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string Partition_run::id() const {
  const auto* given = labels();
  return fmt::format("{}/{}{}/N{}/seed{}", mesh.name, variant.name, given ? "." + given->hash : "", regions, seed);
}

const Given_labels* Partition_run::labels() const {
  const auto found = std::ranges::find_if(
      variant.labels, [&](const auto& given) { return given.mesh == mesh.name && given.regions == regions; });
  return found == variant.labels.end() ? nullptr : &*found;
}

Any_strategy Partition_run::strategy() const {
  if (const auto* given = labels()) return strategy_of(*given, variant.name);
  return make_strategy(variant.strategy, variant.settings);
}

std::vector<Partition_variant> partition_variants() {
  std::vector<Partition_variant> variants;
  for (const auto& entry : strategies()) {
    variants.push_back({.name = std::string(entry.name), .strategy = entry.name});
    if (entry.name == Lbg::name) add_lbg_variants(variants);
  }
  return variants;
}

std::span<const Partition_mesh> partition_meshes() { return meshes; }

std::vector<Partition_run> partition_plan(const std::vector<std::string>& only,
                                          const std::vector<Partition_variant>& given) {
  auto variants = partition_variants();
  variants.insert(variants.end(), given.begin(), given.end());
  const auto named = [&](std::string_view name) { return std::ranges::find(only, name) != only.end(); };
  std::vector<Partition_variant> chosen_variants;
  std::ranges::copy_if(variants, std::back_inserter(chosen_variants), named, &Partition_variant::name);
  std::vector<Partition_mesh> chosen_meshes;
  std::ranges::copy_if(meshes, std::back_inserter(chosen_meshes), named, &Partition_mesh::name);
  for (const auto& name : only)
    if (std::ranges::find(chosen_variants, name, &Partition_variant::name) == chosen_variants.end() &&
        std::ranges::find(chosen_meshes, name, &Partition_mesh::name) == chosen_meshes.end())
      throw Bad_argument(
          fmt::format("there is neither a mesh nor a variant '{}'; the meshes are {}; the variants are {}", name,
                      joined_names(meshes), joined_names(variants)));
  if (chosen_variants.empty()) chosen_variants = variants;
  if (chosen_meshes.empty()) chosen_meshes.assign(meshes.begin(), meshes.end());

  std::vector<Partition_run> plan;
  for (const auto& mesh : chosen_meshes)
    for (const auto& variant : chosen_variants) {
      if (!fits(variant, mesh)) continue;
      for (const auto regions : counts_of(variant, mesh))
        for (const auto seed : partition_seeds) {
          plan.push_back({.variant = variant, .mesh = mesh, .regions = regions, .seed = seed});
          plan.back().variant.settings.seed = seed;
        }
    }
  return plan;
}

void write_partition_meshes(const std::filesystem::path& folder) {
  for (const auto& mesh : meshes)
    write_animation(folder / (std::string(mesh.name) + ".off"), animation_of(made_object("mesh", mesh.make(), {}), 1));
}

Scene partition_scene(const Partition_mesh& mesh, std::uint64_t seed) {
  Surface_mesh surface = mesh.make();
  std::mt19937_64 random(seed);
  Travel travel;
  for (std::size_t i = 0; i < visits; ++i) {
    const Surface_mesh::Vertex_index place(static_cast<std::uint32_t>(draw(random, surface.number_of_vertices())));
    visit(position(surface, place), frames_per_visit * static_cast<double>(i), travel.way_points);
  }
  const double phase = static_cast<double>(draw(random, 1000)) / 1000;

  Scene scene;
  scene.name = mesh.name;
  scene.frames = static_cast<std::size_t>(frames_per_visit) * visits;
  scene.objects.push_back(
      made_object("mesh", std::move(surface), {Wobble{.amplitude = 0.06, .waves = 1, .period = 48, .phase = phase}}));
  Surface_mesh ball = mesh.make_ball();
  transform(ball, ball_radius, Eigen::Vector3d::Zero());
  scene.objects.push_back(made_object("ball", std::move(ball), {Wobble{.period = 36}, std::move(travel)}));
  return scene;
}

}  // namespace lodestone
