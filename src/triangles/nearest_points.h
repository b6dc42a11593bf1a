// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "triangles/corner_differences.h"

namespace lodestone {

/// A point of a triangle: a corner, plus s times the way to the next corner, plus r times the way to the one after; s,
/// r >= 0 and s + r <= 1.
template <class Number>
struct Triangle_point {
  int corner = 0;
  Number s = Number(0);
  Number r = Number(0);
};

/// Two points and the gap between them.
template <class Number>
struct Nearest_points {
  Triangle_point<Number> a, b;
  typename Corner_differences<Number>::Vector gap;     ///< from the point on b to the one on a
  typename Corner_differences<Number>::Vector across;  ///< along the gap, but computed from what is orthogonal to it
  Number squared = Number(-1);                         ///< squared length of `gap`; negative: none yet
};

/// Nearest points of two triangles that do not intersect.
///
/// The least distance is that of two corners, of a corner and an inner point of an edge, of inner points of two edges,
/// or of a corner and an inner point of a face. All of these are tried, and the first of the least ones is taken. Edges
/// without length and faces without area are left out, because their corners and edges cover them. With an exact
/// `Number` the result is exact. With double it is a pair of points that need not be the nearest if edges are nearly
/// parallel or faces are nearly segments.
template <class Number>
class Nearest_points_search {
 public:
  using Vector = typename Corner_differences<Number>::Vector;

  explicit Nearest_points_search(const Corner_differences<Number>& differences) : d_(differences) {}

  Nearest_points<Number> operator()() {
    for (int i = 0; i < 3; ++i) squared_a_[i] = d_.edges_a[i].squaredNorm();
    for (int j = 0; j < 3; ++j) squared_b_[j] = d_.edges_b[j].squaredNorm();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) corners_and_edges(i, j);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) edge_to_edge(i, j);
    corners_to_faces();
    return nearest_;
  }

 private:
  /// Keeps a gap that is shorter than the shortest so far.
  bool offer(const Vector& gap) {
    const Number squared = gap.squaredNorm();
    if (nearest_.squared >= 0 && !(squared < nearest_.squared)) return false;
    nearest_.squared = squared;
    nearest_.gap = gap;
    return true;
  }

  /// Corner i of a and corner j of b, and each of them with the edge that starts at the other.
  void corners_and_edges(int i, int j) {
    const Vector& gap = d_.between[i][j];
    if (offer(gap)) {
      nearest_.across = gap;
      nearest_.a = {i}, nearest_.b = {j};
    }
    const Vector& f = d_.edges_b[j];
    if (const Number along = gap.dot(f); along > 0 && along < squared_b_[j]) {
      const Number s = along / squared_b_[j];
      if (const Vector foot = gap - s * f; offer(foot)) {
        nearest_.across = foot - (foot.dot(f) / squared_b_[j]) * f;
        nearest_.a = {i}, nearest_.b = {j, s};
      }
    }
    const Vector& e = d_.edges_a[i];
    if (const Number along = -gap.dot(e); along > 0 && along < squared_a_[i]) {
      const Number s = along / squared_a_[i];
      if (const Vector foot = gap + s * e; offer(foot)) {
        nearest_.across = foot - (foot.dot(e) / squared_a_[i]) * e;
        nearest_.a = {i, s}, nearest_.b = {j};
      }
    }
  }

  /// Edges e and f at inner points: gap + s e - t f is a multiple of n = e x f. Its product with f x n gives s, its
  /// product with e x n gives t.
  void edge_to_edge(int i, int j) {
    const Vector &e = d_.edges_a[i], &f = d_.edges_b[j], &gap = d_.between[i][j];
    const Vector n = e.cross(f);
    const Number squared = n.squaredNorm();
    if (!(squared > 0)) return;
    const Number s = f.cross(gap).dot(n) / squared;
    if (!(s > 0 && s < 1)) return;
    const Number t = e.cross(gap).dot(n) / squared;
    if (!(t > 0 && t < 1)) return;
    if (offer(gap + s * e - t * f)) {
      nearest_.across = n.dot(nearest_.gap) < 0 ? Vector(-n) : n;
      nearest_.a = {i, s}, nearest_.b = {j, t};
    }
  }

  void corners_to_faces() {
    for (int i = 0; i < 3; ++i)
      if (corner_to_face(d_.between[i][0], d_.edges_b)) nearest_.a = {i}, nearest_.b = {0, s_, r_};
    for (int j = 0; j < 3; ++j)
      if (corner_to_face(-d_.between[0][j], d_.edges_a)) {
        nearest_.gap = -nearest_.gap;
        nearest_.across = -nearest_.across;
        nearest_.a = {0, s_, r_}, nearest_.b = {j};
      }
  }

  /// `gap` leads from corner 0 of the face to the corner. The foot of the corner on the face is corner 0 plus
  /// s f + r g.
  bool corner_to_face(const Vector& gap, const std::array<Vector, 3>& edges) {
    const Vector &f = edges[0], g = -edges[2];
    const Vector n = f.cross(g);
    const Number squared = n.squaredNorm();
    if (!(squared > 0)) return false;
    s_ = gap.cross(g).dot(n) / squared;
    if (!(s_ > 0)) return false;
    r_ = f.cross(gap).dot(n) / squared;
    if (!(r_ > 0 && s_ + r_ < 1)) return false;
    if (!offer(gap - s_ * f - r_ * g)) return false;
    nearest_.across = n.dot(nearest_.gap) < 0 ? Vector(-n) : n;
    return true;
  }

  const Corner_differences<Number>& d_;
  std::array<Number, 3> squared_a_, squared_b_;
  Nearest_points<Number> nearest_;
  Number s_ = Number(0), r_ = Number(0);  ///< of the last foot within a face
};

}  // namespace lodestone
