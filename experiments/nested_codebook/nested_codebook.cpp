// SPDX-License-Identifier: GPL-3.0-or-later
// Below the regions a surface can be divided by LBG's own splits or at medians: which finds more for less?
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "lodestone/detector.h"
#include "nested_codebook/codebook_report.h"
#include "nested_codebook/face_hierarchy.h"
#include "nested_codebook/hierarchy_search.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"
#include "shared/scene_detector.h"

namespace lodestone {

namespace {

const std::vector<std::string> published_scenes{"spheres_5k",   "spheres_50k",     "torus_knots",
                                                "cloth_sphere", "torus_knots_20k", "bodies_20"};
constexpr double reaches[] = {1, 0.7};

/// LBG ends with fewer faces per leaf than medians do, about so many times: with leaves so much smaller, medians are as
/// fine.
constexpr double share_of_lbg_leaves = 0.72;

std::vector<Hierarchy_kind> hierarchy_kinds() {
  std::vector<Hierarchy_kind> kinds;
  for (const std::size_t regions : {12, 1})
    for (const std::size_t leaf_faces : {96, 24}) {
      kinds.push_back({regions, leaf_faces, "median"});
      kinds.push_back({regions, leaf_faces, "median, smaller leaves", share_of_lbg_leaves});
      for (const double weight : {0.0, 0.25, 0.5, 1.0})
        kinds.push_back({regions, leaf_faces, fmt::format("lbg, normals x {}", weight), 1, weight});
    }
  return kinds;
}

/// The hierarchies of one kind over the objects of a scene.
struct Built {
  std::vector<Hierarchy_in_frame> objects;
  double seconds = 0;
};

/// An object in the pose of the first frame.
struct Rest_object {
  std::vector<Corners> corners;
  Positions positions;
  std::map<std::size_t, std::vector<Region_index>> regions = {};  ///< of the faces, by number of regions
};

/// The region of each face: the lowest of its corners' regions, as in Tree_layout.
std::vector<Region_index> face_regions(const Surface_mesh& mesh, std::size_t regions) {
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  const auto graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  const auto positions = read_positions(numbering, mesh.points());
  const Partition_input<Surface_mesh> input{mesh, numbering, graph, positions};
  const auto labels = partition_numbered(input, regions, Any_strategy(), {}).labels;
  std::vector<Region_index> of_faces;
  for (const auto& [a, b, c] : numbering.corners()) of_faces.push_back(std::min({labels[a], labels[b], labels[c]}));
  return of_faces;
}

Built build_once(const Hierarchy_kind& kind, std::vector<Rest_object>& objects, const Scene& scene) {
  Built built;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    auto& object = objects[o];
    const Rest_surface surface{object.corners, object.positions};
    auto& regions = object.regions[kind.regions];
    if (regions.empty()) regions = face_regions(scene.objects[o].mesh, kind.regions);
    const Lap_timer timer;
    const auto split = kind.normal_weight ? split_by_lbg(face_features(surface, *kind.normal_weight))
                                          : split_at_median(surface, kind.most_faces());
    auto hierarchy = build_hierarchy(surface, regions, kind.most_faces(), split);
    built.seconds += timer.seconds();
    built.objects.emplace_back(std::move(hierarchy));
  }
  return built;
}

/// The quickest of three repetitions.
Built build(const Hierarchy_kind& kind, std::vector<Rest_object>& objects, const Scene& scene) {
  Built built = build_once(kind, objects, scene);
  for (int repetition = 1; repetition < 3; ++repetition)
    built.seconds = std::min(built.seconds, build_once(kind, objects, scene).seconds);
  return built;
}

/// One scene, and the hierarchies over its objects in the pose of the first frame.
class Codebook_play {
 public:
  Codebook_play(Scene& scene, std::span<const Hierarchy_kind> kinds)
      : scene_(scene),
        truth_(scene_detector(scene, {.name = "truth", .options = {.mode = Mode::exact}}, Contact_query::all)) {
    read(0);
    std::vector<Rest_object> rest;
    for (std::size_t o = 0; o < scene.objects.size(); ++o)
      rest.push_back({Mesh_numbering<Surface_mesh>(scene.objects[o].mesh).corners(), positions_[o]});
    for (const auto& kind : kinds) {
      built_.push_back(build(kind, rest, scene));
      for (const double reach : reaches) rows_.push_back(row_of(kind, reach, built_.back()));
    }
  }

  void play(std::size_t frame) {
    read(frame);
    const Frame& truth = truth_.detect();
    for (std::size_t kind = 0; kind < built_.size(); ++kind)
      for (std::size_t r = 0; r < std::size(reaches); ++r)
        play(built_[kind].objects, truth, rows_[kind * std::size(reaches) + r]);
  }

  const std::vector<Codebook_row>& rows() const { return rows_; }

 private:
  Codebook_row row_of(const Hierarchy_kind& kind, double reach, const Built& built) const {
    Codebook_row row{
        .scene = scene_.name, .frames = scene_.frames, .kind = kind, .reach = reach, .build_seconds = built.seconds};
    for (const auto& object : scene_.objects) row.faces += object.mesh.number_of_faces();
    for (const auto& object : built.objects) row.leaves += object.leaf_count();
    return row;
  }

  void read(std::size_t frame) {
    positions_.clear();
    for (auto& object : scene_.objects) {
      pose(object, frame);
      positions_.push_back(read_positions(Mesh_numbering<Surface_mesh>(object.mesh), object.mesh.points()));
    }
  }

  void play(std::vector<Hierarchy_in_frame>& objects, const Frame& truth, Codebook_row& row) const {
    for (std::size_t o = 0; o < objects.size(); ++o) objects[o].start_frame(positions_[o]);
    auto result = truth.pairs.begin();
    for (const auto& ids : object_pairs(scene_)) {
      while (result != truth.pairs.end() && Object_pair{result->a, result->b} < ids) ++result;
      const bool listed = result != truth.pairs.end() && Object_pair{result->a, result->b} == ids;
      search(objects[ids.a], objects[ids.b], row.reach, listed ? truth.contacts(*result) : std::span<const Face_pair>(),
             row.counts);
    }
    for (const auto& object : objects) object.add_reads(row.counts);
  }

  Scene& scene_;
  Detector<Any_strategy> truth_;
  std::vector<Positions> positions_;  ///< per object, in this frame
  std::vector<Built> built_;          ///< per kind
  std::vector<Codebook_row> rows_;    ///< per kind and reach
};

}  // namespace

std::string run_nested_codebook(const Experiment_context& context) {
  Experiment_context chosen = context;
  if (chosen.only.empty()) chosen.only = published_scenes;
  const auto kinds = hierarchy_kinds();
  std::vector<Codebook_row> rows;
  for_each_scene(chosen, [&](Scene& scene, const Scene_progress& progress) {
    Codebook_play play(scene, kinds);
    for (std::size_t frame = 0; frame < scene.frames; ++frame) {
      play.play(frame);
      progress(static_cast<double>(frame + 1) / static_cast<double>(scene.frames));
    }
    rows.insert(rows.end(), play.rows().begin(), play.rows().end());
  });
  nlohmann::ordered_json json;
  for (const auto& row : rows) json.push_back(to_json(row));
  write_json(context.out, "nested_codebook", json);

  return codebook_report(rows);
}

}  // namespace lodestone
