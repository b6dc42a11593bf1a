// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/spectral.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>
#include <queue>
#include <random>
#include <string>

#include "lodestone/mesh/errors.h"
#include "partition/islands_of.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

using Vertices = std::vector<std::uint32_t>;
using Sparse_matrix = Eigen::SparseMatrix<double>;

void check(const Spectral_options& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw Bad_argument("spectral: tolerance must be between 0 and 1");
  if (options.max_iterations < 1 || options.max_iterations > 1000000)
    throw Bad_argument("spectral: max_iterations must be between 1 and 1e6");
}

/// The eigenvalue problem L x = lambda M x of a part of the mesh, with its vertices indexed from 0.
struct Problem {
  Sparse_matrix laplacian;  // D - A
  Eigen::VectorXd masses;   // the diagonal of M: 1, or D for the normalised Laplacian
};

constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// @param local  V: the index within the part of each of its vertices; no_vertex for the others
Problem make_problem(const Vertex_graph& graph, const Vertices& part, const std::vector<std::uint32_t>& local,
                     Laplacian kind) {
  const auto size = static_cast<Eigen::Index>(part.size());
  std::vector<Eigen::Triplet<double>> entries;
  Problem problem{.laplacian = Sparse_matrix(size, size), .masses = Eigen::VectorXd::Ones(size)};
  for (const auto v : part) {
    const auto row = static_cast<int>(local[v]);
    int degree = 0;
    for (const auto w : neighbours(graph, v)) {
      if (local[w] == no_vertex) continue;
      entries.emplace_back(row, static_cast<int>(local[w]), -1.0);
      ++degree;
    }
    entries.emplace_back(row, row, degree);
    if (kind == Laplacian::normalised) problem.masses[row] = degree;
  }
  problem.laplacian.setFromTriplets(entries.begin(), entries.end());
  return problem;
}

/// All eigenvectors at once, for few vertices.
Fiedler_vector solve_dense(const Problem& problem) {
  const Eigen::MatrixXd masses = problem.masses.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(problem.laplacian), masses);
  return {.eigenvalue = solver.eigenvalues()[1], .values = solver.eigenvectors().col(1), .iterations = 1};
}

/// Inverse iteration on a block of vectors.
class Inverse_iteration {
 public:
  Inverse_iteration(const Problem& problem, const Spectral_options& options);
  Fiedler_vector run();

 private:
  void start();
  void apply_inverse();
  void take_out_constants();
  void rotate_to_eigenvectors();
  double residual() const;

  // Each iteration multiplies the error by the second eigenvalue over the eighth: about 1/6 on a surface.
  static constexpr Eigen::Index block_size = 6;

  const Problem& problem_;
  const Spectral_options& options_;
  Eigen::SimplicialLDLT<Sparse_matrix> factors_;
  Eigen::MatrixXd block_;   // V x block_size
  Eigen::VectorXd values_;  // eigenvalues, ascending
};

Inverse_iteration::Inverse_iteration(const Problem& problem, const Spectral_options& options)
    : problem_(problem), options_(options) {
  // The Laplacian maps constants to 0. Without its last row and column it has an inverse, whose result differs from a
  // solution of the whole by a constant only.
  const Eigen::Index last = problem.laplacian.rows() - 1;
  factors_.compute(problem.laplacian.topLeftCorner(last, last));
}

void Inverse_iteration::start() {
  std::mt19937_64 random(options_.seed);
  block_.resize(problem_.laplacian.rows(), block_size);
  for (Eigen::Index column = 0; column < block_size; ++column)
    for (Eigen::Index row = 0; row < block_.rows(); ++row)
      block_(row, column) = static_cast<double>(random() >> 11) * 0x1p-52 - 1;  // the same on every platform
  take_out_constants();
}

void Inverse_iteration::take_out_constants() {
  const Eigen::RowVectorXd means = problem_.masses.transpose() * block_ / problem_.masses.sum();
  block_.rowwise() -= means;
}

void Inverse_iteration::apply_inverse() {
  const Eigen::Index last = block_.rows() - 1;
  const Eigen::MatrixXd right_side = problem_.masses.asDiagonal() * block_;
  block_.topRows(last) = factors_.solve(right_side.topRows(last));
  block_.row(last).setZero();
  take_out_constants();
}

/// The best approximations of eigenvectors in the space of the block (Rayleigh-Ritz).
void Inverse_iteration::rotate_to_eigenvectors() {
  for (auto column : block_.colwise()) column.normalize();
  const Eigen::MatrixXd stiffness = block_.transpose() * (problem_.laplacian * block_);
  const Eigen::MatrixXd mass = block_.transpose() * problem_.masses.asDiagonal() * block_;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spread(mass);
  // If vectors have become linearly dependent, the directions in which the block has no extent are left out.
  const Eigen::Index lost = (spread.eigenvalues().array() < 1e-12 * spread.eigenvalues().maxCoeff()).count();
  const Eigen::Index kept = block_.cols() - lost;
  const Eigen::MatrixXd basis =
      spread.eigenvectors().rightCols(kept) * spread.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(basis.transpose() * stiffness * basis);
  block_ = (block_ * (basis * solver.eigenvectors())).eval();
  values_ = solver.eigenvalues();
}

double Inverse_iteration::residual() const {
  const Eigen::VectorXd image = problem_.masses.asDiagonal() * block_.col(0);
  return (problem_.laplacian * block_.col(0) - values_[0] * image).norm() / (values_[0] * image.norm());
}

Fiedler_vector Inverse_iteration::run() {
  start();
  std::size_t iterations = 0;
  do {
    apply_inverse();
    rotate_to_eigenvectors();
    ++iterations;
  } while (residual() > options_.tolerance && iterations < options_.max_iterations);
  return {.eigenvalue = values_[0], .values = block_.col(0), .iterations = iterations};
}

/// The Fiedler vector of a connected part of two vertices or more.
Fiedler_vector solve(const Problem& problem, const Spectral_options& options) {
  constexpr Eigen::Index few = 48;  // above this number the sparse solver is faster
  auto result = problem.laplacian.rows() <= few ? solve_dense(problem) : Inverse_iteration(problem, options).run();
  if (result.values[0] > 0) result.values = -result.values;  // the sign of an eigenvector is arbitrary
  return result;
}

/// Parts of the mesh. The largest is cut in two, again and again.
class Dissection {
 public:
  Dissection(const Vertex_graph& graph, const Spectral_options& options);
  void run(std::size_t wanted);
  Labelling result() const;

 private:
  Vertices cut_off(const Vertices& part);
  Vertices cut_off_islands(std::vector<Vertices> islands) const;
  Vertices cut_along_fiedler_vector(const Vertices& part);

  const Vertex_graph& graph_;
  const Spectral_options& options_;
  std::vector<Vertices> parts_;
  std::vector<std::uint32_t> local_;  ///< scratch: per vertex its index within the current part, or no_vertex
  std::vector<bool> open_;            ///< buffer of `islands_of`
  std::size_t iterations_ = 0;
};

Dissection::Dissection(const Vertex_graph& graph, const Spectral_options& options)
    : graph_(graph),
      options_(options),
      parts_(1),
      local_(num_vertices(graph), no_vertex),
      open_(num_vertices(graph), false) {
  for (std::uint32_t v = 0; v < num_vertices(graph); ++v)
    if (out_degree(v, graph) > 0) parts_[0].push_back(v);
}

/// Divides islands into two sides of about equal size. Returns the side without the lowest vertex.
Vertices Dissection::cut_off_islands(std::vector<Vertices> islands) const {
  const std::uint32_t lowest = islands.front().front();
  std::ranges::stable_sort(islands, std::greater<>(), &Vertices::size);
  Vertices sides[2];
  for (const auto& island : islands) {
    Vertices& side = sides[sides[0].size() <= sides[1].size() ? 0 : 1];
    side.insert(side.end(), island.begin(), island.end());
  }
  for (auto& side : sides) std::ranges::sort(side);
  return sides[0].front() == lowest ? sides[1] : sides[0];
}

Vertices Dissection::cut_along_fiedler_vector(const Vertices& part) {
  for (std::uint32_t i = 0; i < part.size(); ++i) local_[part[i]] = i;
  const Problem problem = make_problem(graph_, part, local_, options_.laplacian);
  for (const auto v : part) local_[v] = no_vertex;
  const Fiedler_vector fiedler = solve(problem, options_);
  iterations_ += fiedler.iterations;

  std::vector<std::uint32_t> order(part.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](auto i) { return fiedler.values[i]; });
  std::size_t first = (part.size() + 1) / 2;  // of the vertices that leave
  if (options_.cut == Spectral_cut::zero) {
    const auto positive = std::ranges::find_if(order, [&](auto i) { return fiedler.values[i] > 0; });
    first = std::clamp<std::size_t>(positive - order.begin(), 1, part.size() - 1);
  }
  Vertices leaving;
  for (std::size_t i = first; i < order.size(); ++i) leaving.push_back(part[order[i]]);
  std::ranges::sort(leaving);
  return leaving;
}

/// The vertices that leave a part of two or more vertices.
Vertices Dissection::cut_off(const Vertices& part) {
  auto all = islands_of(graph_, part, open_);
  return all.size() > 1 ? cut_off_islands(std::move(all)) : cut_along_fiedler_vector(part);
}

void Dissection::run(std::size_t wanted) {
  const auto smaller = [this](std::uint32_t a, std::uint32_t b) {
    return std::pair(parts_[a].size(), b) < std::pair(parts_[b].size(), a);
  };
  std::priority_queue<std::uint32_t, Vertices, decltype(smaller)> by_size(smaller);
  by_size.push(0);
  while (parts_.size() < wanted && parts_[by_size.top()].size() > 1) {
    const std::uint32_t largest = by_size.top();
    by_size.pop();
    Vertices leaving = cut_off(parts_[largest]), staying;
    std::ranges::set_difference(parts_[largest], leaving, std::back_inserter(staying));
    parts_[largest] = std::move(staying);
    parts_.push_back(std::move(leaving));
    by_size.push(largest);
    by_size.push(static_cast<std::uint32_t>(parts_.size() - 1));
  }
}

Labelling Dissection::result() const {
  Labelling result{.labels = std::vector<Region_index>(num_vertices(graph_), 0), .iterations = iterations_};
  for (Region_index label = 0; label < parts_.size(); ++label)
    for (const auto v : parts_[label]) result.labels[v] = label;
  return result;
}

}  // namespace

Fiedler_vector fiedler_vector(const Vertex_graph& graph, const Spectral_options& options) {
  check(options);
  if (num_vertices(graph) < 2) throw Bad_argument("a Fiedler vector needs at least two vertices");
  Vertices all(num_vertices(graph));
  std::iota(all.begin(), all.end(), 0);
  return solve(make_problem(graph, all, all, options.laplacian), options);
}

Labelling Spectral::label(const Numbered_surface& surface, std::size_t regions) const {
  check(options);
  if (regions == 0) throw Bad_argument("the number of regions must be at least 1");
  if (num_vertices(surface.graph) > most_vertices)
    throw Bad_argument("spectral: the mesh has " + std::to_string(num_vertices(surface.graph)) +
                       " vertices; the strategy takes at most " + std::to_string(most_vertices));
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) {
    Dissection dissection(used.graph, options);
    dissection.run(wanted);
    return dissection.result();
  });
}

}  // namespace lodestone
