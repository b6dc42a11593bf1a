// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/manifest.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <string>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"
#include "partitions/hash.h"
#include "partitions/partition_plan.h"
#include "program/source_revision.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

std::string processor() {
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string hash_of(const Surface_mesh& mesh) {
  Hash hash;
  for (const auto v : mesh.vertices())
    for (int axis = 0; axis < 3; ++axis) hash.add(std::bit_cast<std::uint64_t>(mesh.point(v)[axis]));
  for (const auto f : mesh.faces())
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) hash.add(static_cast<std::uint32_t>(v));
  return hash.text();
}

/// What one key of a manifest says, on one line.
std::string said(const Json& manifest, const std::string& key) {
  return manifest.contains(key) ? manifest[key].dump() : "nothing";
}

}  // namespace

Json partition_manifest() {
  Json inputs;
  for (const auto& mesh : partition_meshes()) {
    inputs[std::string(mesh.name)] = hash_of(mesh.make());
    inputs[std::string(mesh.name) + "/ball"] = hash_of(mesh.make_ball());
  }
  return {{"revision", source_revision()}, {"compiler", "GCC " __VERSION__}, {"processors", {processor()}},
          {"regions", partition_counts},   {"seeds", partition_seeds},       {"inputs", std::move(inputs)}};
}

Json read_manifest(const std::filesystem::path& folder) {
  const auto file = folder / "manifest.json";
  std::ifstream in(file);
  if (!in) throw Bad_argument(file.string() + ": cannot be read; it belongs to every folder of rows");
  Json manifest = Json::parse(in, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("processors") || !manifest["processors"].is_array())
    throw Bad_argument(file.string() + ": is no manifest");
  return manifest;
}

void check_manifest(const std::filesystem::path& folder, const Json& manifest) {
  const Json before = read_manifest(folder);
  for (const char* key : {"revision", "compiler", "regions", "seeds", "inputs"})
    if (said(before, key) != said(manifest, key))
      throw Bad_argument(fmt::format("{}: its rows were made with another {}: {} in place of {}", folder.string(), key,
                                     said(before, key), said(manifest, key)));
}

void write_manifest(const std::filesystem::path& folder, const Json& manifest) {
  Json written = manifest;
  if (exists(folder / "manifest.json")) {
    check_manifest(folder, manifest);
    written["processors"] = read_manifest(folder)["processors"];
    for (const auto& name : manifest["processors"])
      if (std::ranges::find(written["processors"], name) == written["processors"].end())
        written["processors"].push_back(name);
  }
  write_whole(folder / "manifest.json", written.dump(2) + "\n");
}

}  // namespace lodestone
