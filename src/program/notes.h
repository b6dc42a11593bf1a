// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/files/small_text.h"
#include "io/motion/animation_names.h"
#include "lodestone/io/meshes/file_faces.h"
#include "lodestone/io/motion/motion.h"

/// What a user should know about an input that was accepted: one line each on the standard error output.
namespace lodestone {

/// @param text  empty: there is nothing to know
inline void note(const std::string& text) {
  if (!text.empty()) fmt::print(stderr, "lodestone: {}\n", printable(text));
}

/// Faces that were cut into triangles.
/// @param name  of the file or object
/// @return empty if there are none
inline std::string cut_faces_note(const std::string& name, std::span<const std::uint32_t> file_face) {
  const auto faces = count_file_faces(file_face);
  if (faces.cut == 0) return {};
  return fmt::format("{}: {} of {} faces have more than three corners: cut into triangles, {} in all", name, faces.cut,
                     faces.count, file_face.size());
}

/// Extensions of a glTF file without which its surfaces lie elsewhere.
/// @return empty if there are none
inline std::string ignored_extensions_note(const std::string& name, const std::set<std::string>& extensions) {
  if (extensions.empty()) return {};
  return fmt::format("{}: not read: {}, which {} where surfaces are", name, fmt::join(extensions, ", "),
                     extensions.size() == 1 ? "says" : "say");
}

/// Animations that are not played, since no scene chooses among those of the file.
/// @return empty if there are none
inline std::string other_animations_note(const std::string& name, const File_animations& animations) {
  const auto& [names, played, is_chosen] = animations;
  if (names.size() <= 1 || is_chosen) return {};
  return fmt::format("{}: plays the animation {}, the first of {}: {}; `gltf.animation` of a scene chooses another",
                     name, animation_name(names, played), names.size(), animation_list(names));
}

/// Vertices that lie on others along seams.
/// @param file_vertex  per vertex: its index in the file; several have the same where the reader has made copies
/// @return empty if there are none
inline std::string joined_vertices_note(const std::string& name, std::size_t joined,
                                        std::span<const std::uint32_t> file_vertex) {
  if (joined == 0) return {};
  std::vector<std::uint32_t> in_file(file_vertex.begin(), file_vertex.end());
  std::ranges::sort(in_file);
  const auto copies = in_file.end() - std::unique(in_file.begin(), in_file.end());
  return fmt::format(
      "{}: {} of {} vertices{} lie on others along seams: particles walk across (--open-seams: they do not)", name,
      joined, file_vertex.size(),
      copies > 0 ? fmt::format(" ({} are copies that the reader made)", copies) : std::string());
}

/// A surface in which nothing can lie.
inline std::string open_surface_note(const std::string& name) {
  return fmt::format("{}: the surface is not closed, so nothing counts as inside it; lodestone info tells more", name);
}

/// Contents of a file that a conversion does not keep.
/// @return empty if there are none
inline std::string not_kept_note(const std::string& name, const std::set<std::string>& contents) {
  return contents.empty() ? std::string() : fmt::format("{}: not kept: {}", name, fmt::join(contents, ", "));
}

}  // namespace lodestone
