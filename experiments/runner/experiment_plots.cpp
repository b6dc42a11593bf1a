// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/experiment_plots.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view extension = ".vl.json";

Json read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Bad_argument(file.string() + ": cannot be read");
  Json json = Json::parse(in, nullptr, false);
  if (json.is_discarded()) throw Bad_argument(file.string() + ": is not JSON");
  return json;
}

/// The file that a specification's `data` refers to; empty if it refers to none.
std::string data_file(const Json& data) {
  if (data.contains("url") && data["url"].is_string()) return data["url"];
  if (data.contains("name") && data["name"].is_string()) return data["name"].get<std::string>() + ".json";
  return {};
}

bool leaves_its_folder(const std::filesystem::path& path) {
  return path.is_absolute() || std::ranges::find(path, "..") != path.end() ||
         path.string().find(':') != std::string::npos;
}

Json rows_of(const Json& data, const std::string& name, const std::filesystem::path& spec,
             const std::filesystem::path& out) {
  if (leaves_its_folder(name))
    throw Bad_argument(spec.string() + ": data '" + name + "' are outside the folder of the figures");
  Json rows = read(out / name);
  if (data.contains("format") && data["format"].contains("property"))
    rows = rows.value(data["format"]["property"].get<std::string>(), Json());
  if (!rows.is_array() || rows.empty() || !std::ranges::all_of(rows, [](const Json& row) { return row.is_object(); }))
    throw Bad_argument(spec.string() + ": its data " + (out / name).string() + " are not a list of rows");
  return rows;
}

/// Replaces each `data` that refers to a file by its rows.
void inline_data(Json& node, const std::filesystem::path& spec, const std::filesystem::path& out) {
  if (!node.is_structured()) return;
  if (node.is_object() && node.contains("data") && node["data"].is_object() && !node["data"].contains("values"))
    if (const auto name = data_file(node["data"]); !name.empty())
      node["data"] = {{"values", rows_of(node["data"], name, spec, out)}};
  for (auto& [key, child] : node.items())
    if (key != "values") inline_data(child, spec, out);
}

/// A title is text, several lines of it, or an object that holds either.
std::string title_of(const Json& spec, const std::string& name) {
  Json title = spec.value("title", Json());
  if (title.is_object()) title = title.value("text", Json());
  if (title.is_string()) return title;
  std::string text;
  if (title.is_array())
    for (const auto& line : title) {
      if (!text.empty()) text += ' ';
      if (line.is_string()) text += line.get<std::string>();
    }
  return text.empty() ? name : text;
}

Page_plot read_plot(const std::filesystem::path& file, const std::filesystem::path& out) {
  Json spec = read(file);
  if (!spec.is_object()) throw Bad_argument(file.string() + ": is not a Vega-Lite specification");
  inline_data(spec, file, out);
  std::string name = file.filename().string();
  name.resize(name.size() - extension.size());
  const Json description = spec.value("description", Json(""));
  return {.name = name,
          .title = title_of(spec, name),
          .description = description.is_string() ? description.get<std::string>() : "",
          .spec = spec.dump()};
}

}  // namespace

std::vector<Page_plot> experiment_plots(const std::filesystem::path& specs, const std::filesystem::path& out) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(specs, none))
    if (entry.path().filename().string().ends_with(extension)) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Page_plot> plots;
  for (const auto& file : files) plots.push_back(read_plot(file, out));
  return plots;
}

}  // namespace lodestone
