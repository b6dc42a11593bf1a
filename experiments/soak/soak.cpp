// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the mode exact with the plainest possible check, on meshes that are made to be hard.
#include "soak/soak.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "lodestone/io/results/text_table.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/triangles/neighbour_check.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/sharded_rows.h"
#include "soak/soak_meshes.h"

namespace lodestone {

namespace {

/// The boxes of faces, coordinate by coordinate: one branchless pass finds all those that overlap a given box.
class Face_boxes {
 public:
  Face_boxes(const Positions& positions, std::span<const Corners> faces) {
    for (const auto& [a, b, c] : faces)
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({positions(a, axis), positions(b, axis), positions(c, axis)});
        low_[axis].push_back(low);
        high_[axis].push_back(high);
      }
    overlaps_.resize(faces.size());
  }
  /// Calls `visit(face)` for each face from index `first` on whose box overlaps that of a face of `other`.
  template <class Visit_face>
  void overlapping(const Face_boxes& other, std::size_t other_face, std::size_t first, Visit_face visit) {
    std::array<double, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = other.low_[axis][other_face];
      high[axis] = other.high_[axis][other_face];
    }
    for (std::size_t f = first; f < overlaps_.size(); ++f)
      overlaps_[f] = (low_[0][f] <= high[0]) & (low[0] <= high_[0][f]) & (low_[1][f] <= high[1]) &
                     (low[1] <= high_[1][f]) & (low_[2][f] <= high[2]) & (low[2] <= high_[2][f]);
    for (std::size_t f = first; f < overlaps_.size(); ++f)
      if (overlaps_[f] != 0) visit(static_cast<std::uint32_t>(f));
  }

 private:
  std::array<std::vector<double>, 3> low_, high_;
  std::vector<std::uint8_t> overlaps_;
};

/// One mesh of a round in one pose.
struct Posed_mesh {
  const std::vector<Corners>& faces;
  const Positions& positions;

  Triangle triangle(std::uint32_t face) const {
    return face_triangle(faces[face], [&](std::uint32_t vertex) { return positions.row(vertex); });
  }
  Coordinates coordinates() const { return {positions.data(), static_cast<std::size_t>(positions.size())}; }
};

std::vector<Face_pair> checked_between(const Posed_mesh& a, const Posed_mesh& b, std::size_t& pairs) {
  const Face_boxes boxes_a(a.positions, a.faces);
  Face_boxes boxes_b(b.positions, b.faces);
  std::vector<Face_pair> found;
  for (std::uint32_t f = 0; f < a.faces.size(); ++f) {
    const Triangle triangle = a.triangle(f);
    boxes_b.overlapping(boxes_a, f, 0, [&](std::uint32_t g) {
      ++pairs;
      if (triangles_intersect(triangle, b.triangle(g))) found.push_back({f, g});
    });
  }
  return found;
}

std::vector<Face_pair> checked_within(const Posed_mesh& mesh, std::size_t& pairs) {
  Face_boxes boxes(mesh.positions, mesh.faces);
  std::vector<Face_pair> found;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle triangle = mesh.triangle(f);
    boxes.overlapping(boxes, f, f + 1, [&](std::uint32_t g) {
      ++pairs;
      // Equals `triangles_intersect` for faces without a common vertex.
      if (faces_intersect(mesh.faces[f], triangle, mesh.faces[g], mesh.triangle(g))) found.push_back({f, g});
    });
  }
  return found;
}

/// Checks two meshes in all their poses.
class Round {
 public:
  Round(const std::array<Soak_mesh, 2>& meshes, std::size_t regions, std::size_t leaf_faces, std::size_t threads)
      : meshes_(meshes), workers_(threads), search_(workers_) {
    for (std::size_t m = 0; m < 2; ++m) {
      objects_[m] = Tree_surface(meshes[m].faces);
      const Posed_mesh first = posed(m, 0);
      objects_[m].build(region_labels(first.positions.rows(), regions), first.coordinates(),
                        {.leaf_faces = leaf_faces});
    }
  }

  void run(Soak_kind& kind) {
    ++kind.rounds;
    for (std::size_t pose = 0; pose < soak_poses; ++pose) {
      const Posed_mesh a = posed(0, pose), b = posed(1, pose);
      if (pose > 0) {
        const std::array<Tree_surface*, 2> objects{&objects_[0], &objects_[1]};
        const std::array<Coordinates, 2> coordinates{a.coordinates(), b.coordinates()};
        refit(objects, coordinates, workers_);
      }
      for (std::size_t m = 0; m < 2; ++m)
        if (!objects_[m].tree().validate(meshes_[m].faces, posed(m, pose).coordinates()).empty()) ++kind.invalid_trees;

      std::vector<Face_pair> found;
      search_.between(objects_[0], objects_[1], {}, found);
      compare(checked_between(a, b, kind.pairs), found, kind);
      // Only one of the two meshes, so that most of the time goes into pairs between them.
      const std::size_t m = pose % 2;
      found.clear();
      search_.within(objects_[m], {}, found);
      compare(checked_within(posed(m, pose), kind.pairs), found, kind);
    }
  }

 private:
  /// Regions of consecutive vertices: often neighbours in a surface, unrelated in a soup.
  static std::vector<Region_index> region_labels(Eigen::Index vertices, std::size_t regions) {
    std::vector<Region_index> labels(static_cast<std::size_t>(vertices));
    for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = static_cast<Region_index>(v * regions / labels.size());
    return labels;
  }

  Posed_mesh posed(std::size_t mesh, std::size_t pose) const {
    return {meshes_[mesh].faces, meshes_[mesh].poses[pose]};
  }

  static void compare(const std::vector<Face_pair>& checked, const std::vector<Face_pair>& found, Soak_kind& kind) {
    kind.intersecting += checked.size();
    kind.differences += count_differences(checked, found);
  }

  const std::array<Soak_mesh, 2>& meshes_;
  Workers workers_;
  Contact_search search_;
  std::array<Tree_surface, 2> objects_;
};

}  // namespace

std::size_t count_differences(std::span<const Face_pair> sorted_a, std::span<const Face_pair> sorted_b) {
  std::vector<Face_pair> different;
  std::ranges::set_symmetric_difference(sorted_a, sorted_b, std::back_inserter(different));
  return different.size();
}

std::size_t soak_kinds() { return soak_recipes().size(); }

Soak_kind soak_one_kind(std::uint64_t seed, std::size_t kind_index, std::size_t share,
                        const std::function<void(std::size_t)>& progress) {
  const auto recipes = soak_recipes();
  const auto& recipe = recipes[kind_index];
  Soak_kind kind{.name = recipe.name};
  std::mt19937_64 random(seed * recipes.size() + kind_index);
  // Every kind meets every frame of reference, even if few pairs are asked for.
  while (kind.pairs < share || kind.rounds < soak_frames_of_reference) {
    auto meshes = recipe.make(random);
    for (auto& mesh : meshes) move_to_frame_of_reference(mesh, kind.rounds % soak_frames_of_reference);
    const std::size_t regions = 1 + random() % 16, leaf_faces = 2 + random() % 127;
    const std::size_t threads = random() % 4 == 0 ? 3 : 1;
    Round(meshes, regions, leaf_faces, threads).run(kind);
    if (progress) progress(std::min(kind.pairs, share));
  }
  return kind;
}

namespace {

/// Each kind has the same share of the pairs.
std::size_t share_of(std::size_t pairs) { return (pairs + soak_kinds() - 1) / soak_kinds(); }

void add(Soak_kind& sum, const Soak_kind& kind) {
  sum.rounds += kind.rounds;
  sum.pairs += kind.pairs;
  sum.intersecting += kind.intersecting;
  sum.differences += kind.differences;
  sum.invalid_trees += kind.invalid_trees;
}

nlohmann::ordered_json to_json(const Soak_kind& kind) {
  return {{"kind", kind.name},
          {"rounds", kind.rounds},
          {"pairs", kind.pairs},
          {"intersecting", kind.intersecting},
          {"differences", kind.differences},
          {"invalid_trees", kind.invalid_trees}};
}

void add_row(Text_table& table, const Soak_kind& kind) {
  table.add({std::string(kind.name), std::to_string(kind.rounds), std::to_string(kind.pairs),
             std::to_string(kind.intersecting), std::to_string(kind.differences), std::to_string(kind.invalid_trees)});
}

}  // namespace

Soak_result soak(std::uint64_t seed, std::size_t pairs, const std::function<void(std::size_t)>& progress) {
  Soak_result result;
  for (std::size_t index = 0; index < soak_kinds(); ++index) {
    const auto kind = soak_one_kind(seed, index, share_of(pairs), [&](std::size_t done) {
      if (progress) progress(result.pairs + done);
    });
    result.pairs += kind.pairs;
    result.intersecting += kind.intersecting;
    result.differences += kind.differences;
    result.invalid_trees += kind.invalid_trees;
    result.kinds.push_back(kind);
  }
  return result;
}

std::string run_soak(const Experiment_context& context) {
  constexpr std::size_t pairs = 100'000'000;  // of each seed
  const std::size_t kinds = soak_kinds(), share = share_of(pairs);
  const Sharded_experiment work{
      .pieces = kinds * context.seeds, .neighbours = false, .inputs = {{"pairs", pairs}, {"kinds", kinds}}};
  const auto made = rows_of(context, work, [&](const auto& pieces, const auto& add_row_of) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::uint64_t seed = pieces[i] / kinds + 1;
      auto row = to_json(soak_one_kind(seed, pieces[i] % kinds, share, [&](std::size_t done) {
        if (context.progress) context.progress(i * share + done, pieces.size() * share);
      }));
      row["seed"] = seed;
      add_row_of(std::move(row));
    }
  });
  if (made.shard) return *made.shard;

  std::vector<Soak_kind> sums;
  for (const auto& recipe : soak_recipes()) sums.push_back({.name = recipe.name});
  for (std::size_t piece = 0; piece < work.pieces; ++piece) {
    const auto& row = made.rows.at(piece);
    add(sums[piece % kinds], {.name = {},
                              .rounds = row.at("rounds"),
                              .pairs = row.at("pairs"),
                              .intersecting = row.at("intersecting"),
                              .differences = row.at("differences"),
                              .invalid_trees = row.at("invalid_trees")});
  }
  Text_table table({"kind", "rounds", "pairs with overlapping boxes", "intersecting", "differences", "invalid trees"});
  nlohmann::ordered_json json;
  Soak_kind all{.name = "all"};
  for (const auto& kind : sums) {
    add_row(table, kind);
    json.push_back(to_json(kind));
    add(all, kind);
  }
  add_row(table, all);
  write_json(context.out, "soak", json);
  return fmt::format(
             "Each round makes two meshes of 200 to 2000 triangles in {} poses. Their trees are built on the first "
             "pose and refitted to the others. The truth checks every pair of faces whose boxes overlap, one by one, "
             "between the two meshes and within one of them. {}.\n\n",
             soak_poses, context.seeds == 1 ? "Seed 1" : fmt::format("Seeds 1 to {}", context.seeds)) +
         table.text();
}

}  // namespace lodestone
