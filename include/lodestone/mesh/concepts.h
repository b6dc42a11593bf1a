// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Lodestone refuses NaN and infinite coordinates, and exact answers need exact rounding: do not use -ffast-math"
#endif

/// What a mesh and its property maps must offer.
namespace lodestone {

/// Kernel of the meshes that Lodestone itself reads and makes: double coordinates, exact predicates.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// A point of space: three double coordinates.
using Point = Kernel::Point_3;
/// The mesh type of the program, and the one the compiled part is instantiated for.
using Surface_mesh = CGAL::Surface_mesh<Point>;

/// Vertex descriptor of a mesh type.
template <class Mesh>
using Vertex = typename boost::graph_traits<Mesh>::vertex_descriptor;
/// Halfedge descriptor of a mesh type.
template <class Mesh>
using Halfedge = typename boost::graph_traits<Mesh>::halfedge_descriptor;
/// Face descriptor of a mesh type.
template <class Mesh>
using Face = typename boost::graph_traits<Mesh>::face_descriptor;

/// Index of a region of one object, from 0.
using Region_index = std::uint32_t;

/// A number that converts to double without loss: no `long double`, no integer of 64 bits.
template <class Number>
concept Exact_as_double =
    std::convertible_to<Number, double> && (!std::numeric_limits<std::remove_cvref_t<Number>>::is_specialized ||
                                            std::numeric_limits<std::remove_cvref_t<Number>>::digits <= 53);

/// A coordinate triple whose values convert to double without loss: any CGAL point over float or double.
template <class P>
concept Point_like = requires(const P& p) {
  { p.x() } -> Exact_as_double;
  { p.y() } -> Exact_as_double;
  { p.z() } -> Exact_as_double;
};

/// A readable property map from the vertices of `Mesh` to points. Detectors keep a copy of it.
template <class Map, class Mesh>
concept Vertex_point_map =
    std::copy_constructible<std::remove_cvref_t<Map>> && requires(const Map& map, Vertex<Mesh> v) {
      { get(map, v) } -> Point_like;
    };

/// A property map whose value type, as its traits tell it, is a number too small for the index of a region. There are
/// no more regions than vertices, so 31 bits are enough.
template <class Map>
concept Narrow_map = requires { typename boost::property_traits<Map>::value_type; } &&
                     std::numeric_limits<typename boost::property_traits<Map>::value_type>::is_specialized &&
                     std::numeric_limits<typename boost::property_traits<Map>::value_type>::digits < 31;

/// A readable and writable property map from the vertices of `Mesh` to region indices. Its values must be wide enough:
/// an `int` is, but an `unsigned char` would wrap beyond 255.
template <class Map, class Mesh>
concept Region_map = !Narrow_map<Map> && requires(const Map& map, Vertex<Mesh> v, Region_index region) {
  put(map, v, region);
  { get(map, v) } -> std::convertible_to<Region_index>;
};

/// A matrix of Eigen, or a sequence such as std::vector. `Triangle_mesh` excludes them first, because
/// boost::graph_traits of them is a hard error rather than a failed constraint. Meshes that are arrays: Indexed_mesh.
template <class M>
concept Array = requires { M::RowsAtCompileTime; } || requires(const M& sequence) {
  typename M::value_type;
  sequence.data();
};

/// A model of CGAL's FaceListGraph with a vertex point map, all of whose faces are triangles.
///
/// Models: CGAL::Surface_mesh, CGAL::Polyhedron_3, OpenMesh through CGAL's wrapper,
/// CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper, and Indexed_mesh. The concept checks syntax only;
/// `Mesh_numbering` checks that every face is a triangle.
template <class Mesh>
concept Triangle_mesh = std::is_class_v<Mesh> && !Array<Mesh> &&
                        requires(const Mesh& mesh, Vertex<Mesh> v, Face<Mesh> f, Halfedge<Mesh> h) {
  vertices(mesh);
  faces(mesh);
  { num_vertices(mesh) } -> std::convertible_to<std::size_t>;
  { num_faces(mesh) } -> std::convertible_to<std::size_t>;
  { halfedge(f, mesh) } -> std::convertible_to<Halfedge<Mesh>>;
  { next(h, mesh) } -> std::convertible_to<Halfedge<Mesh>>;
  { target(h, mesh) } -> std::convertible_to<Vertex<Mesh>>;
  { get(CGAL::vertex_point, mesh) } -> Vertex_point_map<Mesh>;
};

/// The vertex point map of a named-parameter pack, or the mesh's own.
template <Triangle_mesh Mesh, class Named_parameters>
auto vertex_points(const Mesh& mesh, const Named_parameters& np) {
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  return choose_parameter(get_parameter(np, CGAL::internal_np::vertex_point),
                          CGAL::get_const_property_map(CGAL::vertex_point, mesh));
}

}  // namespace lodestone
