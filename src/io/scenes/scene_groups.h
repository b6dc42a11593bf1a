// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "io/files/json_reader.h"
#include "lodestone/io/scenes/scene_file.h"

namespace lodestone::detail {

/// Reads `groups` and `meets` of all objects into `Scene_object::collision`.
/// @param value    the array of objects
/// @param objects  read from it
/// @throws Bad_scene  more than 32 different groups, a group to meet that no object is in
void read_groups(const Json_value& value, std::vector<Scene_object>& objects);

}  // namespace lodestone::detail
