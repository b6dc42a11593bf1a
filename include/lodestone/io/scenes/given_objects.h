// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "lodestone/io/motion/animation.h"
#include "lodestone/io/scenes/scene_file.h"

/// Objects from files that are given without a scene, and the way back from an object to an animation.
namespace lodestone {

/// An object from any input of `read_animation` that has faces. Its mesh is in the pose of frame 0.
/// @param limits  of every file with faces
/// @throws Bad_mesh, Bad_motion  as read_animation
/// @throws Bad_argument          a point cache without its mesh
Scene_object read_object(std::string name, const std::filesystem::path& input, const Mesh_file_options& limits = {});

/// An object that `input` names: `SCENE.json#OBJECT`, or `shape:SHAPE` as for `shape_object`. Nothing if `input` is of
/// neither form. An object of a scene is alone: groups and ignored pairs are dropped.
/// @throws Bad_scene, Bad_mesh, Bad_motion  as read_scene
/// @throws Bad_argument                     the scene has no object of that name
std::optional<Scene_object> named_object(const std::filesystem::path& input, const Scene_options& options = {});

/// The object of that name; if `name` is empty, the only one. Its motion has as many frames as the scene if it does not
/// end by itself.
/// @throws Bad_scene, Bad_mesh, Bad_motion, Bad_argument  as named_object
Scene_object object_of_scene(const std::filesystem::path& scene, const std::string& name,
                             const Scene_options& options = {});

/// A scene of inputs of `read_object` and `named_object`, named after their files, shapes and objects; equal names get
/// a number. It has as many frames as the longest motion. An object whose motion is shorter keeps its last pose.
/// @param inputs  at least one
/// @throws Bad_scene  more inputs, or faces together, than `options` allow; else as read_object and named_object
Scene scene_of(std::span<const std::filesystem::path> inputs, const Scene_options& options = {});

/// One scene file (.json), or else `scene_of` the inputs.
/// @param inputs  at least one
/// @throws Bad_argument  a scene file beside other inputs; else as read_scene and scene_of
Scene read_inputs(std::span<const std::filesystem::path> inputs, const Scene_options& options = {});

/// A built-in shape, by its name if it has defaults for all its fields, else as a scene describes it: `teapot`,
/// `{"icosphere": {"frequency": 8}}`.
/// @throws Bad_scene
Scene_object shape_object(const std::string& shape);

/// The object as an animation of its file vertices.
/// @param frames  number of frames of the scene, for an object whose motion does not end
Animation animation_of(const Scene_object& object, std::size_t frames);

}  // namespace lodestone
