// SPDX-License-Identifier: GPL-3.0-or-later
// Between two frames a small ball flies through a thin sheet. In neither frame do the two intersect; the first impact
// tells when and where they meet.
#include <cstdio>
#include <exception>

#include "lodestone/find_collisions.h"
#include "lodestone/find_first_impact.h"
#include "lodestone/io/shapes/shapes.h"

using namespace lodestone;

int main() try {
  Surface_mesh sheet = cloth(40, 40);
  Surface_mesh ball = icosphere(8);
  for (const auto v : ball.vertices()) {
    const Point& p = ball.point(v);
    ball.point(v) = Point(0.1 * p.x() + 0.5, 0.1 * p.y() + 0.5, 0.1 * p.z() + 1);
  }

  // Where the vertices are in the next frame: the sheet swings up, the ball falls.
  auto [next_sheet, new_sheet_map] = sheet.add_property_map<Vertex<Surface_mesh>, Point>("v:next");
  auto [next_ball, new_ball_map] = ball.add_property_map<Vertex<Surface_mesh>, Point>("v:next");
  for (const auto v : sheet.vertices()) {
    const Point& p = sheet.point(v);
    next_sheet[v] = Point(p.x(), p.y(), p.z() + 0.3 * p.x() * p.y());
  }
  for (const auto v : ball.vertices()) next_ball[v] = ball.point(v) - Kernel::Vector_3(0.1, 0.2, 2);

  const auto impact = find_first_impact(sheet, next_sheet, ball, next_ball);
  const bool before = find_collisions(sheet, ball).collides;
  for (const auto v : sheet.vertices()) sheet.point(v) = next_sheet[v];
  for (const auto v : ball.vertices()) ball.point(v) = next_ball[v];
  const bool after = find_collisions(sheet, ball).collides;

  std::printf("they intersect before: %s, after: %s\n", before ? "yes" : "no", after ? "yes" : "no");
  if (!impact) return 1;
  std::printf("face %u of the sheet and face %u of the ball meet at t = %.6f, at (%.3f, %.3f, %.3f)\n", impact->faces.a,
              impact->faces.b, impact->time, impact->point.x(), impact->point.y(), impact->point.z());
  return before || after ? 1 : 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
