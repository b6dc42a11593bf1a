// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "lodestone/io/scenes/scene_file.h"
#include "support/temporary_folder.h"

/// Scenes and meshes in a few lines.
namespace lodestone::test {

/// The corner of the unit cube at the origin, as a closed tetrahedron, moved by `x` along the x-axis.
inline std::string tetrahedron_off(int x = 0) {
  const std::string here = std::to_string(x);
  const std::string next = std::to_string(x + 1);
  return "OFF\n4 4 0\n" + here + " 0 0\n" + next + " 0 0\n" + here + " 1 0\n" + here +
         " 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
}

inline Scene read(const Temporary_folder& folder, std::string_view text) {
  return read_scene(folder.write("scene.json", text));
}

/// A scene of one object with these keys besides its name.
inline std::string with_object(std::string_view keys) {
  return R"({"objects": [{"name": "a", )" + std::string(keys) + "}]}";
}

}  // namespace lodestone::test
