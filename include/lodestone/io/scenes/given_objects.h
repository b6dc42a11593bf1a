// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "lodestone/io/motion/animation.h"
#include "lodestone/io/scenes/scene_file.h"

/// Objects from files that are given without a scene, and the way back from an object to an animation.
namespace lodestone {

/// An object from any input of `read_animation` that has faces. Its mesh is in the pose of frame 0.
/// @throws Bad_mesh, Bad_motion  as read_animation
/// @throws Bad_argument          a point cache without its mesh
Scene_object read_object(std::string name, const std::filesystem::path& input);

/// A scene of such objects, named after their files; equal names get a number. It has as many frames as the longest
/// motion. An object whose motion is shorter keeps its last pose.
/// @param inputs  at least one
Scene scene_of(std::span<const std::filesystem::path> inputs);

/// A built-in shape, by its name if it has defaults for all its fields, else as a scene describes it: `teapot`,
/// `{"icosphere": {"frequency": 8}}`.
/// @throws Bad_scene
Scene_object shape_object(const std::string& shape);

/// The object as an animation of its file vertices.
/// @param frames  number of frames of the scene, for an object whose motion does not end
Animation animation_of(const Scene_object& object, std::size_t frames);

}  // namespace lodestone
