// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract/volume_leaves.h"

namespace lodestone {

std::vector<Volume_leaf> solid_leaves() {
  std::mt19937_64 random(3);
  const Face_soup sheet(cloth(7, 7));
  const auto centred = [](const Point& p) { return Point(p.x() - 0.5, p.y() - 0.5, p.z()); };
  auto lattice = placed(lattice_soup(60, 30, 5, 4), 0.25, -0.5);
  return {{"sphere", placed(posed_at_random(icosphere(2), 0, random), 0.9)},
          {"cap", faces_where(icosphere(5), [](const Point& p) { return p.z() > 0.7; })},
          {"shallow cap",
           bent(sheet, [](const Point& p) { return Point(p.x() - 0.5, p.y(), 0.01 * std::cos(p.x() + p.y())); })},
          {"saddle", bent(sheet,
                          [&](const Point& p) {
                            const Point q = centred(p);
                            return Point(q.x(), q.y(), q.x() * q.x() - q.y() * q.y());
                          })},
          {"tube",
           bent(sheet, [](const Point& p) { return Point(0.9 * std::cos(6 * p.x()), p.y(), std::sin(6 * p.x())); })},
          {"cube", placed(cube(2), 0.8, -0.3)},
          {"turned cube", posed_at_random(placed(cube(3), 0.5, -0.25), 0.3, random)},
          {"long beam",
           posed_at_random(bent(cube(3), [](const Point& p) { return Point(p.x() - 0.5, 0.01 * p.y(), 0.02 * p.z()); }),
                           0.1, random)},
          {"loose triangles", placed(loose_triangles(30, 0.3, 5), 0.7)},
          {"far apart",
           joined(placed(loose_triangles(3, 0.3, 6), 0.01, -0.9), placed(loose_triangles(2, 1, 7), 0.01, 0.9))},
          {"any faces", lattice}};
}

std::vector<Volume_leaf> flat_leaves() {
  std::mt19937_64 random(4);
  const auto line = [](double x, double y, double z) {
    auto soup = lattice_soup(40, 30, 9, 8);
    deform(soup, [&](const Point& p) { return Point(p.x() * x, p.x() * y, p.x() * z); });
    return soup;
  };
  auto many = soup_of({{Point(0.1, 0.2, 0.3), Point(0.9, 0.3, -0.4), Point(0.2, 0.6, 0.5)}});
  many.faces.resize(100, many.faces[0]);
  const Point p(0.3, 0.7, -0.1), q(-0.6, 0.2, 0.9);
  const Face_soup sheet = placed(cloth(6, 5), 1, -0.4);
  auto grid_on_axis = sheet;
  deform(grid_on_axis, [](const Point& r) { return Point(r.x(), 0.25, r.y()); });
  return {{"triangle", soup_of({{Point(0.1, 0.7, -0.2), Point(-0.9, 0.3, 0.4), Point(0.8, -0.6, 0.5)}})},
          {"right triangle", soup_of({{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)}})},
          {"obtuse triangle", soup_of({{Point(0, 0, 0), Point(1, 0.2, 0), Point(0.5, 0.11, 0.01)}})},
          {"sliver", soup_of({{Point(0, 0, 0), Point(1, 0.3, 0.7), Point(0.5, 0.15, 0.35 + 1e-13)}})},
          {"needle", soup_of({{p, Point(p.x(), p.y() + 1e-16, p.z()), q}})},
          {"segment", soup_of({{p, q, p}})},
          {"point", soup_of({{p, p, p}})},
          {"origin", soup_of({{Point(0, 0, 0), Point(0, 0, 0), Point(0, 0, 0)}})},
          {"nearly a point", crumpled(soup_of({{p, p, p}, {p, p, p}}), 1e-16, 1)},
          {"line", line(0.125, 0.0625, -0.125)},
          {"line but for rounding", line(0.1, 0.07, -0.03)},
          {"line on an axis", line(0, 0.1, 0)},
          {"flat", sheet},
          {"flat on another axis", grid_on_axis},
          {"flat but for rounding", posed_at_random(sheet, 0.1, random)},
          {"lattice in a plane", bent(placed(lattice_soup(50, 20, 6, 9), 0.125),
                                      [](const Point& r) { return Point(r.x(), r.y(), r.x() - r.y()); })},
          {"two triangles on an edge",
           Face_soup(mesh_of({{0, 0, 0.1}, {1, 0, 0}, {0, 1, 0}, {0.8, 0.9, 0.3}}, {{0, 1, 2}, {2, 1, 3}}))},
          {"one face many times", many}};
}

std::string text(const Placement& p) {
  std::ostringstream out;
  out << "scale " << p.scale << ", offset " << p.offset[0] << ' ' << p.offset[1] << ' ' << p.offset[2];
  return out.str();
}

bool finite(const Face_soup& soup) {
  return std::ranges::all_of(soup.coordinates, [](double x) { return std::isfinite(x); });
}

std::vector<Placement> far_places() {
  return {{1, {0x1p20, 0x1p20, 0x1p20}}, {1, {-1e6, 0, 1e6}}, {1, {0, 1e15, 0}},      {1, {1e15, -1e15, 3e15}},
          {1e-7, {1e9, 1, 1}},           {1e3, {7, -8, 9}},   {0x1p300, {1e6, 0, 5}}, {0x1p-300, {-0x1p20, 0x1p20, 0}}};
}

std::vector<Placement> extreme_scales() {
  std::vector<Placement> all;
  for (const double scale : {0x1p-300, 0x1p300, 0x1p-500, 0x1p-537, 1e-160, 0x1p-1020, 0x1p-1050, 0x1p-1070, 0x1p-1074,
                             0x1p341, 0x1p511, 1e154, 0x1p600, 1e307, 1e308, 1.7e308})
    all.push_back({scale, {}});
  all.push_back({0.2e308, {3, 3, 3}}), all.push_back({0.4e308, {-3, 3, 3}});
  return all;
}

Exact_point between(const Exact_point& p, const Exact_point& q, const Rational& t) { return p + t * (q - p); }

std::vector<Exact_point> points_of(const Triangle& face, const std::vector<Exact_point>& centres,
                                   std::mt19937_64& random) {
  const Exact_triangle t{exact_point(face[0]), exact_point(face[1]), exact_point(face[2])};
  std::vector<Exact_point> points;
  const auto weight = [&]() -> Rational { return Rational(static_cast<double>(random() % 65)) / 64; };
  for (int i = 0; i < 3; ++i) {
    points.push_back(CGAL::midpoint(t[i], t[(i + 1) % 3]));
    points.push_back(between(t[i], t[(i + 1) % 3], weight()));
    points.push_back(between(between(t[0], t[1], weight()), t[2], weight()));
  }
  for (const auto& centre : centres) points.push_back(nearest_point(t, centre));
  return points;
}

std::vector<Exact_point> likely_centres(const Face_soup& soup) {
  const Positions positions = soup.positions();
  const double size = positions.cwiseAbs().maxCoeff();
  std::vector<Exact_point> centres;
  const auto add = [&](const Eigen::Vector3d& p) {
    if (p.allFinite()) centres.push_back(exact_point(Point(p.x(), p.y(), p.z())));
  };
  add(0.5 * positions.colwise().minCoeff() + 0.5 * positions.colwise().maxCoeff());
  if (!(size > 0) || !std::isfinite(1 / size)) return centres;
  const Positions unit = positions / size;
  const Eigen::RowVector3d mean = unit.colwise().mean();
  add(size * mean.transpose());
  // |p|^2 = 2 c . p + d for p relative to the mean.
  const Positions relative = unit.rowwise() - mean;
  Eigen::MatrixX4d equations(relative.rows(), 4);
  equations << 2 * relative, Eigen::VectorXd::Ones(relative.rows());
  const Eigen::Vector4d sphere = equations.colPivHouseholderQr().solve(relative.rowwise().squaredNorm());
  add(size * (mean.transpose() + sphere.head<3>()));
  return centres;
}

}  // namespace lodestone
