// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/paraview_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/results/page_frame.h"
#include "lodestone/mesh/region_maps.h"

namespace lodestone {

namespace {

using Numbers = std::vector<std::uint32_t>;
using Marks = std::vector<std::uint8_t>;

/// Per vertex the region whose particle is there, or `no_particle`. Meshes whose positions are computed have none.
std::vector<Region_index> particles_at(const Surface_mesh& mesh) {
  std::vector<Region_index> particles(mesh.number_of_vertices(), no_particle);
  const auto [map, exists] = mesh.property_map<Surface_mesh::Vertex_index, Region_index>("v:particle");
  if (exists)
    for (const auto v : mesh.vertices()) particles[v] = map[v];
  return particles;
}

Triangle triangle_of(const Surface_mesh& mesh, std::uint32_t face) {
  Triangle corners;
  std::size_t corner = 0;
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(Surface_mesh::Face_index(face))))
    corners[corner++] = mesh.point(v);
  return corners;
}

/// Per object and face: 1 if it is part of a contact.
std::vector<Marks> touched_faces(const Scene& scene, const Frame& result) {
  std::vector<Marks> touched;
  touched.reserve(scene.objects.size());
  for (const auto& object : scene.objects) touched.emplace_back(object.mesh.number_of_faces());
  for (const auto& pair : result.pairs)
    for (const auto& [a, b] : result.contacts(pair)) touched[pair.a][a] = touched[pair.b][b] = 1;
  return touched;
}

/// All objects as one surface, with the data of each vertex and face.
Vtp_data meshes_of(const Scene& scene, const Scene_detector& detector, const Frame& result) {
  Vtp_data data;
  Numbers region, object_of_vertex, vertex, object_of_face, face;
  Marks particle, contact;
  const auto touched = touched_faces(scene, result);
  for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
    const auto& [mesh, file_vertex] = std::tie(scene.objects[o].mesh, scene.objects[o].file_vertex);
    const auto first = static_cast<std::uint32_t>(data.points.size());
    const auto regions = detector.regions(o), particles = particles_at(mesh);
    for (const auto v : mesh.vertices()) {
      data.points.push_back(mesh.point(v));
      region.push_back(regions[v]);
      particle.push_back(particles[v] == no_particle ? 0 : 1);
      object_of_vertex.push_back(o);
      vertex.push_back(file_vertex[v]);
    }
    for (const auto f : mesh.faces()) {
      auto& corners = data.polygons.emplace_back();
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        corners.push_back(first + static_cast<std::uint32_t>(v));
      object_of_face.push_back(o);
      face.push_back(scene.objects[o].file_face[f]);
    }
    contact.insert(contact.end(), touched[o].begin(), touched[o].end());
  }
  data.point_data = {{"region", std::move(region)},
                     {"particle", std::move(particle)},
                     {"object", std::move(object_of_vertex)},
                     {"vertex", std::move(vertex)}};
  data.cell_data = {{"object", std::move(object_of_face)}, {"face", std::move(face)}, {"contact", std::move(contact)}};
  return data;
}

using Numbered_vertices = std::vector<std::pair<std::uint32_t, Surface_mesh::Vertex_index>>;

/// The particles of an object, as their number and vertex, in the order of vertices. Several can be at one vertex in
/// mode `senin`, of which the map of the mesh tells only one.
Numbered_vertices numbered_particles(const Surface_mesh& mesh, Object_id o, const Scene_detector& detector, Mode mode) {
  Numbered_vertices particles;
  if (!finds_all(mode)) {
    for (const std::uint32_t vertex : detector.object(o).particles().at)
      particles.emplace_back(static_cast<std::uint32_t>(particles.size()), Surface_mesh::Vertex_index(vertex));
    std::ranges::stable_sort(particles, {}, [](const auto& particle) { return particle.second; });
    return particles;
  }
  const auto at = particles_at(mesh);
  for (const auto v : mesh.vertices())
    if (at[v] != no_particle) particles.emplace_back(at[v], v);
  return particles;
}

Vtp_data particles_of(const Scene& scene, const Scene_detector& detector, Mode mode) {
  Vtp_data data;
  Numbers region, object;
  for (Object_id o = 0; o < scene.objects.size(); ++o) {
    const auto& mesh = scene.objects[o].mesh;
    for (const auto& [particle, vertex] : numbered_particles(mesh, o, detector, mode)) {
      data.vertices.push_back({static_cast<std::uint32_t>(data.points.size())});
      data.points.push_back(mesh.point(vertex));
      region.push_back(particle);
      object.push_back(o);
    }
  }
  data.point_data = {{"region", std::move(region)}, {"object", std::move(object)}};
  return data;
}

/// Contacts of one kind: points, segments or polygons.
struct Contact_cells {
  std::vector<std::vector<std::uint32_t>> cells = {};
  std::array<Numbers, 5> sources = {};  ///< object a, object b, face a, face b, whether they intersect
};

Vtp_data contacts_of(const Scene& scene, const Frame& result) {
  Vtp_data data;
  std::array<Contact_cells, 3> kinds;
  for (const auto& pair : result.pairs)
    for (std::size_t contact = pair.first_contact; contact < pair.first_contact + pair.contacts; ++contact) {
      const auto [a, b] = result.face_pairs[contact];
      const auto points = meeting_points(result, pair, contact, [&scene](Object_id object, std::uint32_t face) {
        return triangle_of(scene.objects[object].mesh, face);
      });
      auto& kind = kinds[std::min<std::size_t>(points.size(), 3) - 1];
      auto& cell = kind.cells.emplace_back();
      for (const Point& point : points) {
        cell.push_back(static_cast<std::uint32_t>(data.points.size()));
        data.points.push_back(point);
      }
      const std::array<std::uint32_t, 5> source{pair.a, pair.b, scene.objects[pair.a].file_face[a],
                                                scene.objects[pair.b].file_face[b], result.intersects(contact)};
      for (std::size_t i = 0; i < source.size(); ++i) kind.sources[i].push_back(source[i]);
    }
  constexpr std::array names{"object_a", "object_b", "face_a", "face_b", "intersects"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    Numbers values;
    for (const auto& kind : kinds) values.insert(values.end(), kind.sources[i].begin(), kind.sources[i].end());
    data.cell_data.push_back({names[i], std::move(values)});
  }
  data.vertices = std::move(kinds[0].cells);
  data.lines = std::move(kinds[1].cells);
  data.polygons = std::move(kinds[2].cells);
  return data;
}

}  // namespace

Paraview_log::Paraview_log(const std::filesystem::path& folder, std::size_t frames, Mode mode)
    : files_(folder), digits_(std::max<std::size_t>(4, fmt::formatted_size("{}", frames - 1))), mode_(mode) {}

void Paraview_log::add(std::size_t frame, const Scene& scene, const Scene_detector& detector, const Frame& result) {
  write(meshes_, frame, meshes_of(scene, detector, result));
  write(particles_, frame, particles_of(scene, detector, mode_));
  write(contacts_, frame, contacts_of(scene, result));
}

void Paraview_log::write(Series& series, std::size_t frame, const Vtp_data& data) {
  const auto name = fmt::format("frames/{}_{:0{}}.vtp", series.name, frame, digits_);
  Atomic_file file = files_.open(name);
  write_vtp(file, data);
  series.steps.push_back({static_cast<double>(frame), name});
}

void Paraview_log::finish() {
  for (const Series* series : {&meshes_, &particles_, &contacts_}) {
    Atomic_file file = files_.open(std::string(series->name) + ".pvd");
    file.write(pvd_text(series->steps));
    file.commit();
  }
}

}  // namespace lodestone
