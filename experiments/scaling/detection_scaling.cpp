// SPDX-License-Identifier: GPL-3.0-or-later
#include "scaling/detection_scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lodestone/detection/particle_object.h"
#include "lodestone/io/results/text_table.h"
#include "scaling/median_seconds.h"
#include "shared/fit.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr auto no_progress = [](std::size_t, std::size_t) {};

/// Seconds of one growth check of an object, whether or not a region has grown.
double growth_check_seconds(const Surface_mesh& mesh, std::size_t particles) {
  Particle_object object(std::make_unique<Typed_watched_mesh<Surface_mesh, Own_points<Surface_mesh>, Lbg>>(
      mesh, mesh.points(), std::make_shared<const Lbg>()));
  object.find_edges();
  const Positions positions = object.read_positions();
  object.take_division(object.divide(positions, particles, {}), positions);
  constexpr int checks = 1000;
  return median_seconds([&] {
           for (int check = 0; check < checks; ++check) object.has_outgrown(2);
         }) /
         checks;
}

/// Median time of an iteration of the relaxation over the frames that have one, in microseconds.
double median_iteration(const Measurement& measurement) {
  std::vector<double> per_iteration;
  for (const auto& frame : measurement.frames)
    if (frame.iterations > 0)
      per_iteration.push_back(1e6 * frame.seconds.relaxation / static_cast<double>(frame.iterations));
  return median(per_iteration);
}

/// The stages of the published method, each N a row.
std::string stages_against_particles(const Surface_mesh& mesh, std::span<const Measurement> published,
                                     const std::function<void()>& step, nlohmann::ordered_json& json) {
  Text_table table(
      {"N", "relaxation (us)", "iterations", "per iteration (us)", "candidates (us)", "growth check (us)"});
  std::vector<double> n, iteration, candidates, check;
  for (const auto& m : published) {
    const auto particles = m.setting.options.particles;
    n.push_back(static_cast<double>(particles));
    iteration.push_back(median_iteration(m));
    candidates.push_back(median_microseconds(m, &Stage_times::candidates));
    check.push_back(1e6 * growth_check_seconds(mesh, particles));
    step();
    table.add({std::to_string(particles), fmt::format("{:.1f}", median_microseconds(m, &Stage_times::relaxation)),
               fmt::format("{:.1f}", mean_count(m, &Frame_statistics::iterations)),
               fmt::format("{:.2f}", iteration.back()), fmt::format("{:.2f}", candidates.back()),
               fmt::format("{:.2f}", check.back())});
  }
  const double of_iteration = fitted_exponent(n, iteration);
  const double of_candidates = fitted_exponent(n, candidates);
  const double of_check = fitted_exponent(n, check);
  json = {{"N", n},
          {"iteration_microseconds", iteration},
          {"candidate_microseconds", candidates},
          {"growth_check_microseconds", check},
          {"exponents", {{"iteration", of_iteration}, {"candidates", of_candidates}, {"check", of_check}}}};
  return table.text() +
         fmt::format(
             "\nExponent of N: {:.2f} for one iteration of the relaxation, {:.2f} for the candidate pairs (the paper: "
             "O(N^2)), {:.2f} for the repartition check (the paper: O(N)).\n",
             of_iteration, of_candidates, of_check);
}

/// Measurements of several settings against one number, with the exponents of their times.
class Frame_series {
 public:
  explicit Frame_series(const std::string& parameter)
      : parameter_(parameter),
        table_({parameter, "particles", "recall", "median (us)", "mean (us)", "hops", "meetings", "positions read"}) {}

  void add(std::size_t x, const std::string& name, const Measurement& m) {
    Curve& curve = curve_of(name);
    curve.x.push_back(static_cast<double>(x));
    curve.medians.push_back(median_microseconds_without_build(m));
    curve.means.push_back(mean_microseconds_without_build(m));
    curve.reads.push_back(mean_count(m, &Frame_statistics::vertices_read));
    table_.add(
        {std::to_string(x), name, fmt::format("{:.3f}", m.score.recall()), fmt::format("{:.1f}", curve.medians.back()),
         fmt::format("{:.1f}", curve.means.back()), fmt::format("{:.1f}", mean_count(m, &Frame_statistics::moves)),
         fmt::format("{:.2f}", mean_count(m, &Frame_statistics::meetings)), fmt::format("{:.0f}", curve.reads.back())});
    rows_.push_back({{parameter_, x}, {"name", name}, {"figures", to_json(m)}});
  }

  std::string text() const {
    std::string text =
        table_.text() + fmt::format("\nExponents of {}, of the median, the mean and the positions read:", parameter_);
    for (const auto& curve : curves_)
      text += fmt::format(" {:.2f}, {:.2f} and {:.2f} ({});", fitted_exponent(curve.x, curve.medians),
                          fitted_exponent(curve.x, curve.means), fitted_exponent(curve.x, curve.reads), curve.name);
    text.back() = '.';
    return text + "\n";
  }

  nlohmann::ordered_json json() const {
    nlohmann::ordered_json exponents;
    for (const auto& curve : curves_)
      exponents[curve.name] = {{"median", fitted_exponent(curve.x, curve.medians)},
                               {"mean", fitted_exponent(curve.x, curve.means)},
                               {"positions_read", fitted_exponent(curve.x, curve.reads)}};
    return {{"rows", rows_}, {"exponents", exponents}};
  }

 private:
  struct Curve {
    std::string name;
    std::vector<double> x = {}, medians = {}, means = {}, reads = {};
  };

  Curve& curve_of(const std::string& name) {
    const auto found = std::ranges::find(curves_, name, &Curve::name);
    return found != curves_.end() ? *found : curves_.emplace_back(name);
  }

  std::string parameter_;
  Text_table table_;
  std::vector<Curve> curves_;
  nlohmann::ordered_json rows_;
};

Setting particle_setting(const std::string& name, std::size_t particles, std::size_t meetings) {
  return {name, {.mode = Mode::particles, .particles = particles, .meetings = meetings}};
}

}  // namespace

std::string detection_against_particles(Scene scene, const std::function<void()>& step, nlohmann::ordered_json& json) {
  std::vector<Setting> settings;
  for (const std::size_t meetings : {std::size_t{0}, Detector_options().meetings})
    for (const auto particles : scaling_particle_counts)
      settings.push_back(particle_setting(meetings > 0 ? "with meetings" : "published", particles, meetings));
  const auto run = measure({&scene, 1}, settings, no_progress, {.truth = Truth_source::exact_mode});
  step();

  const auto published = std::span(run.measurements).first(std::size(scaling_particle_counts));
  std::string text = stages_against_particles(scene.objects[0].mesh, published, step, json["detection"]);
  Frame_series frames("N");
  for (const auto& m : run.measurements) frames.add(m.setting.options.particles, m.setting.name, m);
  json["detection"]["frames"] = frames.json();
  return text + "\nFrames of the same run, with meetings and without:\n\n" + frames.text();
}

std::string detection_against_triangles(std::span<Scene> scenes, const std::function<void()>& step,
                                        nlohmann::ordered_json& json) {
  const std::size_t meetings = Detector_options().meetings;
  const std::vector<Setting> settings{
      particle_setting("12, with meetings", 12, meetings),
      particle_setting("128, with meetings", 128, meetings),
      particle_setting("12, published", 12, 0),
      particle_setting("128, published", 128, 0),
      {"exact", {.mode = Mode::exact}},
  };
  Frame_series frames("triangles");
  for (auto& scene : scenes) {
    std::size_t triangles = 0;
    for (const auto& object : scene.objects) triangles += object.mesh.number_of_faces();
    const auto run = measure({&scene, 1}, settings, no_progress, {.truth = Truth_source::exact_mode});
    for (const auto& m : run.measurements) frames.add(triangles, m.setting.name, m);
    step();
  }
  json["triangles"] = frames.json();
  return frames.text();
}

}  // namespace lodestone
