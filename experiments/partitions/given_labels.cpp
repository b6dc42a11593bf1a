// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/given_labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "lodestone/io/meshes/label_file.h"
#include "lodestone/mesh/errors.h"
#include "partitions/hash.h"
#include "partitions/partition_plan.h"

namespace lodestone {

namespace {

namespace fs = std::filesystem;

constexpr const char* extension = ".labels";
constexpr std::size_t usual_regions = 32;

struct Given_labels_strategy {
  static constexpr std::string_view name = "labels";
  std::shared_ptr<const std::vector<Region_index>> labels;

  Labelling label(const Numbered_surface& surface, std::size_t regions) const {
    if (static_cast<std::size_t>(surface.positions.rows()) != labels->size()) return Lbg{}.label(surface, regions);
    return {.labels = *labels};
  }
};

/// All files of labels in a folder, sorted.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  if (files.empty()) throw Bad_argument(fmt::format("{}: there is no file *{}", folder.string(), extension));
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> files_of(const fs::path& given) {
  const auto absolute = fs::absolute(given).lexically_normal();
  if (absolute.filename() == fmt::format("*{}", extension)) return files_in(absolute.parent_path());
  if (fs::is_directory(absolute)) return files_in(absolute);
  if (absolute.extension() != extension)
    throw Bad_argument(fmt::format("{}: expected a file *{} or a folder of such files", given.string(), extension));
  return {absolute};
}

std::string hash_of(const std::vector<Region_index>& labels) {
  Hash hash;
  for (const auto label : labels) hash.add(label);
  return hash.text();
}

Partition_mesh mesh_of(const fs::path& file, const std::string& name) {
  const auto mesh = std::ranges::find(partition_meshes(), name, &Partition_mesh::name);
  if (mesh != partition_meshes().end()) return *mesh;
  std::vector<std::string_view> names;
  for (const auto& known : partition_meshes()) names.push_back(known.name);
  throw Bad_argument(
      fmt::format("{}: there is no mesh '{}'; the meshes are {}", file.string(), name, fmt::join(names, ", ")));
}

/// @param text  the number in the name of the file; empty: there is none
std::size_t regions_of(const fs::path& file, const std::string& text) {
  if (text.empty()) return usual_regions;
  for (const auto count : partition_counts)
    if (text == std::to_string(count)) return count;
  throw Bad_argument(fmt::format("{}: '{}' is no number of regions that the experiment compares: {}", file.string(),
                                 text, fmt::join(partition_counts, ", ")));
}

Given_labels read_one(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto dot = stem.find('.');
  const auto mesh = mesh_of(file, stem.substr(0, dot));
  const auto regions = regions_of(file, dot == stem.npos ? "" : stem.substr(dot + 1));
  auto labels = read_labels(file, mesh.make().number_of_vertices());
  const auto hash = hash_of(labels);
  return {.mesh = std::string(mesh.name),
          .regions = regions,
          .hash = hash,
          .labels = std::make_shared<const std::vector<Region_index>>(std::move(labels))};
}

void check_name(const std::string& name) {
  const auto variants = partition_variants();
  if (std::ranges::find(variants, name, &Partition_variant::name) != variants.end())
    throw Bad_argument(fmt::format("labels of '{}': the experiment has a strategy of that name", name));
}

}  // namespace

Any_strategy strategy_of(const Given_labels& labels, std::string_view name) {
  Any_strategy strategy(Given_labels_strategy{labels.labels});
  strategy.name = name;
  return strategy;
}

std::vector<Partition_variant> read_given_labels(const std::vector<fs::path>& given) {
  std::map<std::string, std::vector<Given_labels>> by_name;
  for (const auto& argument : given)
    for (const auto& file : files_of(argument)) {
      auto& list = by_name[file.parent_path().filename().string()];
      auto labels = read_one(file);
      for (const auto& other : list)
        if (other.mesh == labels.mesh && other.regions == labels.regions)
          throw Bad_argument(fmt::format("{}: there is another file for {} in {} regions", file.string(), labels.mesh,
                                         labels.regions));
      list.push_back(std::move(labels));
    }
  std::vector<Partition_variant> variants;
  for (auto& [name, labels] : by_name) {
    check_name(name);
    variants.push_back({.name = name, .strategy = Given_labels_strategy::name, .labels = std::move(labels)});
  }
  return variants;
}

}  // namespace lodestone
