// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/partition_checks.h"

namespace lodestone {

std::vector<Surface_soup> odd_surfaces() {
  std::vector<Surface_soup> all;
  const auto add = [&](const Surface_mesh& mesh) { all.push_back(surface_soup(mesh)); };
  auto mesh = sphere(4);
  for (int i = 0; i < 10; ++i) mesh.add_vertex({100.0 + 10 * i, 0, 0});
  add(mesh);  // with isolated vertices
  mesh = sphere(4);
  deform(mesh, [](const Point& p) { return Point(p.x(), 0, 0); });
  add(mesh);  // all faces without area
  deform(mesh, [](const Point&) { return Point(3, 1, 2); });
  add(mesh);  // without extent
  mesh = sphere(4);
  deform(mesh, [](const Point& p) { return p.x() > 0.3 ? p : Point(0, 0, 0); });
  add(mesh);  // some faces without area
  mesh = Surface_mesh();
  for (int i = 0; i < 5; ++i) append(mesh, sphere(1 + i, 0.3, {1.0 * i, 0, 0}));
  add(mesh);  // components
  append(mesh, Surface_mesh(mesh));
  add(mesh);  // every face twice
  for (const double size : {1e-300, 1e-160, 1e160, 1e300}) {
    mesh = potato(4);
    scale(mesh, size);
    add(mesh);
  }
  mesh = potato(4);
  mesh.point(Surface_mesh::Vertex_index(7)) = Point(1e200, 0, 0);
  add(mesh);  // a spike that dwarfs everything else
  mesh = potato(4);
  deform(mesh, [](const Point& p) { return Point(1e9 + p.x() * 1e-9, p.y() * 1e-9, p.z() * 1e-9); });
  add(mesh);  // smaller than the spacing of doubles at its position
  mesh = potato(4);
  deform(mesh, [](const Point& p) { return Point(p.x(), p.y() * 1e-170, p.z() * 1e-200); });
  add(mesh);                                                                    // nearly, but not quite, a line
  all.push_back({Positions::Random(5, 3), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}});  // an edge of three faces
  all.push_back({Positions::Random(5, 3), {{0, 1, 2}, {0, 3, 4}}});             // two fans at a vertex
  all.push_back({Positions::Random(4, 3), {{0, 1, 2}, {0, 1, 3}}});             // neighbours disagree
  all.push_back({Positions::Random(6, 3), {{0, 0, 1}, {1, 2, 3}, {4, 4, 4}, {4, 4, 5}}});  // corners twice
  all.push_back({Positions::Random(3, 3), {{0, 0, 1}}});                                   // and nothing else
  all.push_back({Positions::Random(3, 3), {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}}});             // one face three times
  std::vector<Corners> loose;
  for (std::uint32_t i = 0; i < 40; ++i) loose.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  all.push_back({Positions::Random(120, 3), loose});  // triangles without neighbours
  return all;
}

}  // namespace lodestone
