// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/meshes/label_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/files/small_text.h"
#include "io/files/text_scanner.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/formats/mesh_file_options.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// The label on the current line.
Region_index read_label(Text_scanner& text, std::size_t vertices) {
  const auto word = text.next_word();
  const auto label = text.count(word);
  if (const auto more = text.next_word(); !more.empty())
    text.fail(fmt::format("expected one label on a line, found also {}", in_quotes(more)));
  if (label >= vertices)
    text.fail(fmt::format("region {} of {} vertices: regions are counted from 0", label, vertices));
  return static_cast<Region_index>(label);
}

void check_every_region_has_a_vertex(const std::filesystem::path& file, std::span<const Region_index> labels) {
  if (labels.empty()) return;
  std::vector<bool> used(std::size_t{std::ranges::max(labels)} + 1);
  for (const auto label : labels) used[label] = true;
  const auto missing = std::ranges::find(used, false);
  if (missing != used.end())
    throw Bad_mesh(fmt::format("{}: region {} has no vertex; the regions go from 0 to {}", file.string(),
                               missing - used.begin(), used.size() - 1));
}

}  // namespace

std::vector<Region_index> read_labels(const std::filesystem::path& file, std::size_t vertices) {
  const File_bytes bytes(file, Mesh_file_options().max_bytes);
  Text_scanner text(bytes, '#');
  std::vector<Region_index> labels;
  labels.reserve(vertices);
  while (text.next_line()) {
    if (labels.size() == vertices) text.fail(fmt::format("more labels than the {} vertices of the mesh", vertices));
    labels.push_back(read_label(text, vertices));
  }
  if (labels.size() < vertices)
    throw Bad_mesh(
        fmt::format("{}: {}, but the mesh has {} vertices", file.string(), counted(labels.size(), "label"), vertices));
  check_every_region_has_a_vertex(file, labels);
  return labels;
}

void write_labels(const std::filesystem::path& file, std::span<const Region_index> labels) {
  Atomic_file out(file);
  for (const auto label : labels) out.write(fmt::format("{}\n", label));
  out.commit();
}

}  // namespace lodestone
