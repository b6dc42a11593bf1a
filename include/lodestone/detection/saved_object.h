// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/saved_state.h"
#include "lodestone/partition/partition.h"

/// What a detector has built of an object, as bytes: in front what they are, how many and their hash; then the mode and
/// the mesh that they belong to; then what the mode has written.
namespace lodestone {

/// Puts the front part before the rest.
std::vector<std::byte> seal_saved(std::span<const std::byte> rest);
/// The rest, after a check of the front part.
/// @param bytes              must outlive the result
/// @throws Bad_saved_object  the bytes are something else, of another format, cut off or changed
std::span<const std::byte> open_saved(std::span<const std::byte> bytes);

/// Which mode has built an object, of which mesh.
struct Saved_origin {
  std::string mode;                       ///< as messages name it
  std::uint64_t vertices = 0;             ///< of the mesh
  std::span<const Corners> corners = {};  ///< of its faces
};

/// Writes mode and mesh, the latter by its counts and a hash.
void save_origin(const Saved_origin& origin, State_writer& state);
/// Reads what `save_origin` has written, and compares it.
/// @param title              names the object in the message
/// @throws Bad_saved_object  what was saved is from another mode or another mesh
void check_origin(const Saved_origin& origin, const std::string& title, State_reader& state);

/// Writes a partition, or that there is none.
void save_regions(const std::optional<Numbered_partition>& regions, State_writer& state);
/// Reads what `save_regions` has written.
/// @throws Bad_saved_object  they are not those of a surface with so many vertices
std::optional<Numbered_partition> load_regions(State_reader& state, std::size_t vertex_count);

}  // namespace lodestone
