// SPDX-License-Identifier: GPL-3.0-or-later
// How partition, detection and repartition check grow, beside the paper's O(kMN), O(N^2) and O(N). In O(kMN) k is the
// number of Lloyd iterations, M that of vertices and N that of particles.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

#include "lodestone/io/results/text_table.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/partition/lbg.h"
#include "scaling/detection_scaling.h"
#include "scaling/median_seconds.h"
#include "shared/experiment.h"
#include "shared/fit.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// Feature vectors of a teapot with n x n quads per patch: M = 32 n^2 - 4 n + 2.
Feature_vectors teapot_vectors(std::size_t n) {
  const Surface_mesh mesh = teapot({.u = n, .v = n});
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  return feature_vectors(read_positions(numbering, mesh.points()), numbering.corners());
}

/// The first columns of 6-D vectors; beyond the sixth, smooth functions of these.
Feature_vectors with_dimension(const Feature_vectors& six, Eigen::Index dimension) {
  Feature_vectors vectors(six.rows(), dimension);
  for (Eigen::Index c = 0; c < dimension; ++c)
    vectors.col(c) =
        c < 6 ? six.col(c).eval() : (2.0 * six.col(c % 3) + six.col((c + 1) % 3)).array().sin().matrix().eval();
  return vectors;
}

/// Time of LBG from one code vector to N. Plain and bounded search give the same labels after as many iterations.
struct Quantise_time {
  double plain = 0, bounded = 0;  ///< seconds for the whole quantisation
  std::size_t iterations = 0;     ///< k: Lloyd iterations between all splits together
  double per_iteration() const { return plain / static_cast<double>(iterations); }
};

Quantise_time time_quantise(const Feature_vectors& vectors, std::size_t cells, Lbg_options options = {}) {
  Quantise_time time;
  options.sample = 0;  // the paper's formula counts all vectors
  options.search = Nearest_search::bounded;
  time.bounded = median_seconds([&] {
    const auto result = quantise(vectors, cells, options);
    time.iterations = 0;
    for (const auto& run : result.runs) time.iterations += run.distortion.size();
  });
  options.search = Nearest_search::plain;
  time.plain = median_seconds([&] { quantise(vectors, cells, options); });
  return time;
}

/// The parameter that is the number of iterations: it is measured, not chosen.
constexpr std::string_view iterations_parameter = "k";

/// A series of measurements against one parameter, with the exponents that fit.
class Series {
 public:
  explicit Series(std::string parameter) : parameter_(std::move(parameter)) {}

  void add(double x, const Quantise_time& time) {
    x_.push_back(x);
    times_.push_back(time);
  }

  std::string text() const {
    const bool against_iterations = parameter_ == iterations_parameter;
    std::vector<std::string> header{parameter_, "plain (ms)", "bounded (ms)", "plain / bounded",
                                    "plain per iteration (ms)"};
    if (!against_iterations) header.insert(header.end() - 1, std::string(iterations_parameter));
    Text_table table(header);
    for (std::size_t i = 0; i < x_.size(); ++i) {
      std::vector<std::string> row{fmt::format("{}", x_[i]), fmt::format("{:.2f}", 1e3 * times_[i].plain),
                                   fmt::format("{:.2f}", 1e3 * times_[i].bounded),
                                   fmt::format("{:.1f}", times_[i].plain / times_[i].bounded),
                                   fmt::format("{:.3f}", 1e3 * times_[i].per_iteration())};
      if (!against_iterations) row.insert(row.end() - 1, std::to_string(times_[i].iterations));
      table.add(std::move(row));
    }
    const auto [plain, iteration, bounded] = exponents();
    return table.text() + fmt::format(
                              "\nExponent of {}: {:.2f} for a plain run, {:.2f} for one of its iterations, {:.2f} for "
                              "a bounded run.\n\n",
                              parameter_, plain, iteration, bounded);
  }

  Json json() const {
    Json rows = Json::array();
    for (std::size_t i = 0; i < x_.size(); ++i)
      rows.push_back({{parameter_, x_[i]},
                      {"plain_seconds", times_[i].plain},
                      {"bounded_seconds", times_[i].bounded},
                      {"iterations", times_[i].iterations}});
    const auto [plain, iteration, bounded] = exponents();
    return {{"rows", rows}, {"exponents", {{"plain", plain}, {"plain_iteration", iteration}, {"bounded", bounded}}}};
  }

 private:
  std::tuple<double, double, double> exponents() const {
    std::vector<double> plain, iteration, bounded;
    for (const auto& time : times_) {
      plain.push_back(time.plain);
      iteration.push_back(time.per_iteration());
      bounded.push_back(time.bounded);
    }
    return {fitted_exponent(x_, plain), fitted_exponent(x_, iteration), fitted_exponent(x_, bounded)};
  }

  std::string parameter_;
  std::vector<double> x_;
  std::vector<Quantise_time> times_;
};

/// Moves the progress bar by a step after each measurement.
class Steps {
 public:
  Steps(const Experiment_context& context, std::size_t of) : context_(context), of_(of) {}
  void next() { context_.progress(++done_, of_); }

 private:
  const Experiment_context& context_;
  std::size_t of_, done_ = 0;
};

/// Rounds between two splits end after a number of iterations; the tolerance ends none before the distortion stands
/// still.
std::string partition_against_iterations(Steps& steps, Json& json) {
  Series series{std::string(iterations_parameter)};
  const auto vectors = teapot_vectors(28);
  for (const std::size_t of_a_round : {2, 4, 8, 16, 32}) {
    const auto time = time_quantise(vectors, 64, {.tolerance = 1e-300, .max_iterations = of_a_round});
    series.add(static_cast<double>(time.iterations), time);
    steps.next();
  }
  json["k"] = series.json();
  return fmt::format(
             "Against k, at M = {}, N = 64 and dimension 6; every round between two splits ends after at most 2, 4, 8, "
             "16 or 32 iterations:\n\n",
             vectors.rows()) +
         series.text();
}

/// Not in the paper's formula.
std::string partition_against_dimension(Steps& steps, Json& json) {
  Series series("dimension");
  const auto six = teapot_vectors(28);
  for (const Eigen::Index dimension : {3, 6, 12, 24}) {
    series.add(static_cast<double>(dimension), time_quantise(with_dimension(six, dimension), 64));
    steps.next();
  }
  json["dimension"] = series.json();
  return fmt::format("In addition, against the dimension of the feature vectors, at M = {} and N = 64:\n\n",
                     six.rows()) +
         series.text();
}

std::string partition_against_vertices(Steps& steps, Json& json) {
  Series series("M");
  for (const std::size_t n : {10, 20, 28, 56}) {
    const auto vectors = teapot_vectors(n);
    series.add(static_cast<double>(vectors.rows()), time_quantise(vectors, 64));
    steps.next();
  }
  json["M"] = series.json();
  return "Against M, at N = 64 and dimension 6:\n\n" + series.text();
}

std::string partition_against_regions(Steps& steps, Json& json) {
  Series series("N");
  const auto vectors = teapot_vectors(28);
  for (const std::size_t cells : {8, 16, 32, 64, 128, 256}) {
    series.add(static_cast<double>(cells), time_quantise(vectors, cells));
    steps.next();
  }
  json["N"] = series.json();
  return fmt::format("Against N, at M = {} and dimension 6:\n\n", vectors.rows()) + series.text();
}

/// Two wobbling spheres that approach, touch and part again.
Scene spheres(const Experiment_context& context, std::string_view name) {
  return read_scene(context.scenes / fmt::format("{}.json", name));
}

/// The same motion at four resolutions.
std::vector<Scene> finer_and_finer_spheres(const Experiment_context& context) {
  std::vector<Scene> scenes;
  for (const auto* name : {"spheres_1k", "spheres_5k", "spheres_50k", "spheres_500k"})
    scenes.push_back(spheres(context, name));
  return scenes;
}

}  // namespace

std::string run_scaling(const Experiment_context& context) {
  auto scenes = finer_and_finer_spheres(context);
  Steps steps(context, 5 + 4 + 6 + 4 + 1 + std::size(scaling_particle_counts) + scenes.size());
  const auto step = [&] { steps.next(); };
  Json json;
  std::string report = fmt::format(
      "Partition: LBG over a teapot, medians of {} runs. The paper: O(kMN), with k Lloyd iterations, M vertices and N "
      "particles. `k` counts the iterations of all rounds, from one code vector to N.\n\n",
      runs_per_figure);
  report += partition_against_iterations(steps, json);
  report += partition_against_vertices(steps, json);
  report += partition_against_regions(steps, json);
  report += partition_against_dimension(steps, json);
  report += "Detection and repartition check against N, two spheres of 50 000 triangles:\n\n";
  report += detection_against_particles(spheres(context, "spheres_50k"), step, json);
  report += "\nDetection against the number of triangles of the two spheres, with 12 and 128 particles each:\n\n";
  report += detection_against_triangles(scenes, step, json);
  write_json(context.out, "scaling", json);
  return report;
}

}  // namespace lodestone
