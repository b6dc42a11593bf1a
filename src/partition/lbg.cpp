// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/lbg.h"

#include <cmath>
#include <utility>

#include "partition/cells.h"
#include "partition/quantiser.h"
#include "partition/training_sample.h"
#include "partition/used_surface.h"

namespace lodestone {

void check(const Lbg_options& options) {
  if (!(options.split > 0) || !std::isfinite(options.split))
    throw Bad_argument("LBG: epsilon, the size of the split, must be finite and > 0");
  if (!(options.tolerance > 0)) throw Bad_argument("LBG: tolerance must be > 0");
  if (options.max_iterations == 0) throw Bad_argument("LBG: max_iterations must be at least 1");
  check(options.features);
}

namespace {

void check(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options) {
  if (vectors.rows() == 0 || vectors.cols() == 0) throw Bad_argument("there is no vector to quantise");
  // Squares and their sums over all vectors must not overflow. The comparison also refuses NaN.
  if (!(vectors.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= 1e100))
    throw Bad_argument("a component of a vector to quantise is not finite, or beyond 1e100");
  if (cells == 0) throw Bad_argument("the number of regions must be at least 1");
  check(options);
}

Quantisation train(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options) {
  Quantiser quantiser(vectors, options);
  quantiser.run_lloyd();
  while (quantiser.size() < cells && quantiser.split(cells)) quantiser.run_lloyd();
  return quantiser.result();
}

/// Assigns all vectors to the code vectors that were trained on a sample, and moves those to the means of their cells.
/// @param trained  its labels are those of the sample
void label_all(const Feature_vectors& vectors, const Lbg_options& options, Quantisation& trained) {
  Workers workers(options.threads);
  Assignment assignment;
  assignment.labels = labels_from_sample(static_cast<std::size_t>(vectors.rows()), trained.labels);
  Feature_vectors& codes = trained.code_vectors;
  if (options.search == Nearest_search::bounded)
    Bounded_assignment(vectors, workers).assign(codes, assignment);
  else
    assign_plain(vectors, codes, assignment, workers);
  refill_empty_cells(vectors, codes, assignment);
  move_codes_to_means(assignment, codes);
  trained.labels = std::move(assignment.labels);
  trained.distance_evaluations += assignment.distance_evaluations;
}

}  // namespace

Quantisation quantise(const Feature_vectors& vectors, std::size_t cells, const Lbg_options& options) {
  check(vectors, cells, options);
  const auto count = static_cast<std::size_t>(vectors.rows());
  const std::size_t size = sample_size(count, cells, options.sample);
  if (size < count) {
    Quantisation trained = train(vectors(draw_sample(count, size), Eigen::all), cells, options);
    // A sample with fewer different values than cells says nothing about all vectors.
    if (static_cast<std::size_t>(trained.code_vectors.rows()) == cells) {
      label_all(vectors, options, trained);
      return trained;
    }
  }
  return train(vectors, cells, options);
}

Labelling Lbg::label(const Numbered_surface& surface, std::size_t regions) const {
  const Used_surface used(surface);
  const Feature_vectors factors = used.picked_rows(surface.picked_rows(extra_factors));
  return label_used(used, regions, [&](const Numbered_surface& part, std::size_t wanted) -> Labelling {
    Feature_vectors vectors = feature_vectors(part.positions, part.faces, options.features);
    if (factors.size() > 0) {
      const Eigen::Index k = vectors.cols();
      vectors.conservativeResize(Eigen::NoChange, k + factors.cols());
      vectors.rightCols(factors.cols()) = factors;
    }
    Quantisation quantisation = quantise(vectors, wanted, options);
    std::size_t iterations = 0;
    for (const auto& run : quantisation.runs) iterations += run.distortion.size();
    return {.labels = std::move(quantisation.labels),
            .vectors = std::move(vectors),
            .iterations = iterations,
            .distance_evaluations = quantisation.distance_evaluations};
  });
}

}  // namespace lodestone
