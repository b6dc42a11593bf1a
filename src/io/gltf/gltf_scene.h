// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/formats/mesh_soup.h"
#include "lodestone/io/formats/joined_vertices.h"
#include "lodestone/io/formats/mesh_file_options.h"

/// A glTF file as Lodestone needs it: triangles, and everything that moves their vertices.
namespace lodestone {

inline constexpr std::size_t no_index = std::numeric_limits<std::size_t>::max();

/// x, y, z of one vertex after the other.
using Coordinate_list = std::vector<double>;

/// A mesh of the file, with its primitives concatenated. Texture seams duplicate vertices: the faces use one index for
/// vertices that always move together.
struct Gltf_shape {
  Coordinate_list positions = {};
  std::vector<Coordinate_list> targets = {};  ///< per morph target: its offsets, or empty
  std::vector<double> weights = {};           ///< of the targets, unless the node has its own
  std::size_t influences = 0;                 ///< joints per vertex
  std::vector<std::uint32_t> joints = {};     ///< `influences` per vertex: indices into the skin's list
  std::vector<double> joint_weights = {};     ///< their sum is 1 for each vertex
  std::vector<Corners> faces = {};
  Joined_vertices joined = {};

  std::size_t vertices() const { return positions.size() / 3; }
};

/// The transformation of a node relative to its parent.
struct Gltf_place {
  Eigen::Vector3d translation{0, 0, 0};
  Eigen::Quaterniond rotation{1, 0, 0, 0};
  Eigen::Vector3d scale{1, 1, 1};
  std::optional<Eigen::Affine3d> matrix = {};  ///< replaces the other three
};

struct Gltf_node {
  std::size_t parent = no_index;
  Gltf_place place = {};
  std::vector<double> weights = {};  ///< of morph targets; empty: those of the mesh
};

struct Gltf_skin {
  std::vector<std::size_t> joints = {};         ///< nodes
  std::vector<Eigen::Affine3d> from_mesh = {};  ///< per joint: from the mesh at rest into the joint's coordinates
};

/// An instance of a mesh, at a node.
struct Gltf_part {
  std::shared_ptr<const Gltf_shape> shape = {};
  std::size_t node = 0;
  std::size_t skin = no_index;
  std::size_t first_vertex = 0;
  std::string name = {};  ///< of the node, else of the mesh, else `node_N`; those of two parts differ
};

enum class Gltf_path { translation, rotation, scale, weights };
enum class Gltf_interpolation { step, linear, cubic };

/// A property of a node over time.
struct Gltf_curve {
  std::size_t node = 0;
  Gltf_path path = Gltf_path::translation;
  Gltf_interpolation interpolation = Gltf_interpolation::linear;
  std::size_t width = 3;            ///< numbers per value
  std::vector<double> times = {};   ///< seconds, increasing
  std::vector<double> values = {};  ///< per time: the value; cubic: in-tangent, value, out-tangent
};

struct Gltf_animation {
  std::string name = {};
  double seconds = 0;  ///< the last time of any curve
  std::vector<Gltf_curve> curves = {};
};

struct Gltf_scene {
  std::string name = {};  ///< of the file
  std::vector<Gltf_node> nodes = {};
  std::vector<std::size_t> order = {};  ///< node indices, parents first
  std::vector<Gltf_skin> skins = {};
  std::vector<Gltf_part> parts = {};
  std::vector<Gltf_animation> animations = {};
  std::size_t vertices = 0;                       ///< of all parts
  std::vector<std::filesystem::path> files = {};  ///< that it is read from
  std::set<std::string> not_read = {};            ///< what else the file holds, such as `texture coordinates`
  std::set<std::string> ignored_extensions = {};  ///< optional ones that say where surfaces are
};

/// Whether the file's extension is that of glTF.
bool is_gltf(const std::filesystem::path& file);

/// Reads a `.gltf` or `.glb` file through its guard and tinygltf. Images are ignored.
/// @throws Bad_mesh
std::shared_ptr<const Gltf_scene> read_gltf_scene(const std::filesystem::path& file,
                                                  const Mesh_file_options& options = {});

/// The vertices of all parts.
Joined_vertices joined_vertices(const Gltf_scene& scene);

/// The triangles of all parts, with vertices at rest.
Polygon_soup soup_of(std::shared_ptr<const Gltf_scene> scene);

}  // namespace lodestone
