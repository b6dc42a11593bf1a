// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/given_labels.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "lodestone/io/meshes/label_file.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/mesh/errors.h"
#include "partitions/partition_plan.h"
#include "partitions/partition_report.h"
#include "partitions/partition_run.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

const Partition_mesh& mesh_of(std::string_view name) {
  return *std::ranges::find(partition_meshes(), name, &Partition_mesh::name);
}

/// The labels that `lbg` gives a mesh of the experiment as it lies in the first frame.
std::vector<Region_index> labels_of_lbg(std::string_view name, std::size_t regions, std::uint64_t seed) {
  Scene scene = partition_scene(mesh_of(name), seed);
  pose(scene.objects[0], 0);
  auto& mesh = scene.objects[0].mesh;
  const auto map = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
  partition(mesh, regions, map, Lbg{});
  std::vector<Region_index> labels;
  for (const auto v : mesh.vertices()) labels.push_back(map[v]);
  return labels;
}

class Given_labels_of : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& file, const std::vector<Region_index>& labels) const {
    write_labels(folder.path() / file, labels);
    return folder.path() / file;
  }
  static std::vector<Region_index> stripes(std::string_view mesh, std::size_t regions) {
    std::vector<Region_index> labels(mesh_of(mesh).make().number_of_vertices());
    for (std::size_t v = 0; v < labels.size(); ++v) labels[v] = static_cast<Region_index>(v * regions / labels.size());
    return labels;
  }
  static std::string error_of(const std::filesystem::path& given) {
    try {
      read_given_labels({given});
    } catch (const Bad_argument& error) {
      return error.what();
    }
    return "no error";
  }

  test::Temporary_folder folder;
};

TEST_F(Given_labels_of, a_folder_are_a_strategy_of_its_name) {
  write("mine/cloth_coarse.labels", stripes("cloth_coarse", 32));
  write("mine/sphere_coarse.8.labels", stripes("sphere_coarse", 8));
  write("mine/sphere_coarse.12.labels", stripes("sphere_coarse", 11));
  for (const auto& given : {folder.path() / "mine" / "*.labels", folder.path() / "mine", folder.path() / "mine/"}) {
    const auto variants = read_given_labels({given});
    ASSERT_EQ(variants.size(), 1U);
    EXPECT_EQ(variants[0].name, "mine");
    EXPECT_EQ(variants[0].labels.size(), 3U);
    std::multiset<std::string> runs;
    for (const auto& run : partition_plan({"mine"}, variants)) {
      EXPECT_NE(run.labels(), nullptr);
      runs.insert(std::string(run.mesh.name) + " " + std::to_string(run.regions));
    }
    EXPECT_EQ(runs.size(), 15U);
    for (const std::string run : {"cloth_coarse 32", "sphere_coarse 8", "sphere_coarse 12"})
      EXPECT_EQ(runs.count(run), 5U);
  }
}

TEST_F(Given_labels_of, files_take_part_beside_the_strategies_of_the_library) {
  const auto variants = read_given_labels({write("a/cloth_coarse.labels", stripes("cloth_coarse", 32)),
                                           write("b/cloth_coarse.labels", stripes("cloth_coarse", 32))});
  EXPECT_EQ(variants.size(), 2U);
  EXPECT_EQ(partition_plan({}, variants).size(), partition_plan().size() + 10);
}

TEST_F(Given_labels_of, lbg_give_the_row_of_lbg) {
  const auto file = write("mine/cloth_coarse.labels", labels_of_lbg("cloth_coarse", 32, 1));
  const auto given = partition_plan({"mine"}, read_given_labels({file}));
  const auto row = execute(given.at(0));
  auto plan = partition_plan({"cloth_coarse", "lbg"});
  const auto own = std::ranges::find_if(plan, [](const auto& run) { return run.regions == 32 && run.seed == 1; });
  const auto expected = execute(*own);
  EXPECT_EQ(row["regions"], 32);
  for (const char* key : {"size_balance", "border_length", "normal_deviation", "box_volume"})
    EXPECT_EQ(row.at(key), expected.at(key)) << key;
  EXPECT_EQ(row["variant"], "mine");
  EXPECT_GT(row["recall"], 0.5);
  EXPECT_NE(partition_report({{"id", row}}).find("| mine "), std::string::npos);
}

TEST_F(Given_labels_of, the_mesh_are_not_applied_to_the_ball) {
  for (const auto& mesh : partition_meshes())
    EXPECT_NE(mesh.make().number_of_vertices(), mesh.make_ball().number_of_vertices()) << mesh.name;
}

TEST_F(Given_labels_of, the_mesh_leave_the_ball_to_lbg) {
  const auto variants = read_given_labels({write("mine/cloth_coarse.labels", stripes("cloth_coarse", 32))});
  const auto strategy = strategy_of(variants.at(0).labels.at(0), "mine");
  const Surface_mesh own = mesh_of("cloth_coarse").make(), other = mesh_of("cloth_coarse").make_ball();
  const Numbered_mesh mesh(own), ball(other);
  EXPECT_EQ(strategy.label({mesh.graph, mesh.positions, mesh.faces}, 8).labels, stripes("cloth_coarse", 32));
  const Numbered_surface surface{ball.graph, ball.positions, ball.faces};
  EXPECT_EQ(strategy.label(surface, 8).labels, Lbg{}.label(surface, 8).labels);
}

TEST_F(Given_labels_of, other_content_are_other_runs) {
  auto labels = stripes("cloth_coarse", 8);
  const auto file = write("mine/cloth_coarse.labels", labels);
  const auto before = partition_plan({"mine"}, read_given_labels({file})).at(0).id();
  std::swap(labels.front(), labels.back());
  write("mine/cloth_coarse.labels", labels);
  EXPECT_NE(partition_plan({"mine"}, read_given_labels({file})).at(0).id(), before);
}

TEST_F(Given_labels_of, no_mesh_no_count_or_no_name_of_their_own_are_refused) {
  const auto labels = stripes("cloth_coarse", 8);
  const auto says = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  says(error_of(write("a/cloth.labels", labels)),
       "cloth.labels: there is no mesh 'cloth'; the meshes are teapot_coarse");
  for (const auto* name : {"b/cloth_coarse.9.labels", "b/cloth_coarse.x.labels", "b/cloth_coarse.8.8.labels"})
    says(error_of(write(name, labels)), "is no number of regions that the experiment compares: 8, 12");
  says(error_of(write("metis/cloth_coarse.labels", labels)), "'metis': the experiment has a strategy of that name");
  write("d/cloth_coarse.labels", labels);
  write("d/cloth_coarse.32.labels", labels);
  says(error_of(folder.path() / "d"), "there is another file for cloth_coarse in 32 regions");
  create_directory(folder.path() / "empty");
  for (const auto* none : {"empty", "empty/*.labels", "none/*.labels"})
    says(error_of(folder.path() / none), "there is no file *.labels");
  says(error_of(folder.path() / "a.txt"), "expected a file *.labels");
  EXPECT_THROW(read_given_labels({folder.write("e.labels", "0\n")}), Bad_argument);
  EXPECT_THROW(read_given_labels({write("f/cloth_fine.labels", labels)}), Bad_mesh);
}

TEST_F(Given_labels_of, files_of_meshes_have_the_vertices_of_the_experiment_in_order) {
  write_partition_meshes(folder.path() / "meshes");
  for (const auto& mesh : partition_meshes()) {
    const auto written = read_mesh(folder.path() / "meshes" / (std::string(mesh.name) + ".off"));
    const auto own = mesh.make();
    ASSERT_EQ(written.file_vertices, own.number_of_vertices()) << mesh.name;
    for (const auto v : written.mesh.vertices())
      EXPECT_EQ(written.mesh.point(v), own.point(Surface_mesh::Vertex_index(written.file_vertex[v])));
  }
}

}  // namespace
}  // namespace lodestone
