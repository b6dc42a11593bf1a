// SPDX-License-Identifier: GPL-3.0-or-later
// How much faster several threads are than one.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <thread>

#include "certified/character.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/mesh/errors.h"
#include "many_bodies/crowd.h"
#include "program/installed_files.h"
#include "program/measurement.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "threads/threaded_work.h"

namespace lodestone {

namespace {

/// Triangles of both objects together.
constexpr std::size_t published_sizes[] = {20'000, 200'000, 1'000'000};

std::vector<std::size_t> sizes_of(const Experiment_context& context) {
  if (context.only.empty()) return {std::begin(published_sizes), std::end(published_sizes)};
  std::vector<std::size_t> sizes;
  for (const auto& text : context.only) {
    std::size_t size = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error != std::errc() || end != text.data() + text.size() || size < 1000)
      throw Bad_argument(fmt::format("--only of threads takes numbers of triangles from 1000 on, not '{}'", text));
    sizes.push_back(size);
  }
  return sizes;
}

/// 1, 2, 4, 8, 16: as far as the machine goes.
std::vector<std::size_t> thread_counts() {
  std::vector<std::size_t> counts{1};
  const std::size_t most = std::min(16U, std::max(2U, std::thread::hardware_concurrency()));
  while (2 * counts.back() <= most) counts.push_back(2 * counts.back());
  return counts;
}

struct Thread_figures {
  std::string work;
  std::size_t triangles = 0;
  std::vector<double> seconds;  ///< per number of threads: the median over the rounds
};

/// The numbers of threads take turns in each round, and each round begins with another one.
Thread_figures measure(const Threaded_work& work, std::size_t triangles, std::span<const std::size_t> threads) {
  work.pose(0);
  std::vector<std::function<double()>> workers;
  for (const auto count : threads) workers.push_back(work.make(count));
  std::vector<std::vector<double>> seconds(threads.size());
  for (std::size_t round = 0; round < work.rounds; ++round) {
    work.pose(1 + round);
    for (const std::size_t turn : order_of_turns(round, workers.size())) seconds[turn].push_back(workers[turn]());
  }
  Thread_figures figures{.work = work.name, .triangles = triangles, .seconds = {}};
  for (auto& times : seconds) figures.seconds.push_back(median(std::move(times)));
  return figures;
}

Character_scene hands_of(std::size_t triangles) {
  const auto hand = *read_character(installed_files() / "characters" / "hand.glb");
  return with_triangles(touching("hands", hand, hand), triangles / 2);
}

/// Bodies of some 3000 triangles each.
Scene crowd_of(std::size_t triangles) { return crowd(std::max<std::size_t>(3, triangles / 3000), 16); }

std::size_t triangles_of(const Scene& scene) {
  std::size_t sum = 0;
  for (const auto& object : scene.objects) sum += object.mesh.number_of_faces();
  return sum;
}

std::size_t triangles_of(const Character_scene& scene) {
  std::size_t sum = 0;
  for (const auto& character : scene.characters) sum += character.mesh.number_of_faces();
  return sum;
}

std::string report(std::span<const Thread_figures> all, std::span<const std::size_t> threads) {
  std::vector<std::string> header{"work", "triangles", "1 thread (ms)"};
  for (const auto count : threads.subspan(1)) header.push_back(fmt::format("{} threads: times faster", count));
  Text_table table(header);
  for (const auto& figures : all) {
    std::vector<std::string> row{figures.work, figures.triangles == 0 ? "-" : std::to_string(figures.triangles),
                                 fmt::format("{:.3f}", 1e3 * figures.seconds.front())};
    for (const double seconds : std::span(figures.seconds).subspan(1))
      row.push_back(fmt::format("{:.2f}", figures.seconds.front() / seconds));
    table.add(row);
  }
  return table.text();
}

}  // namespace

std::string run_threads(const Experiment_context& context) {
  const auto threads = thread_counts();
  std::vector<Thread_figures> all;
  const auto sizes = sizes_of(context);
  std::size_t done = 0;
  for (const auto& work : works_without_memory()) all.push_back(measure(work, 0, threads));
  for (const auto size : sizes) {
    Moving_pair pair(size);
    Character_scene hands = hands_of(size);
    Scene bodies = crowd_of(size);
    auto works = works_on(pair);
    const std::size_t of_pair = works.size();
    std::ranges::move(works_on(hands), std::back_inserter(works));
    const std::size_t of_hands = works.size();
    std::ranges::move(works_on(bodies), std::back_inserter(works));
    for (std::size_t i = 0; i < works.size(); ++i) {
      const std::size_t triangles = i < of_pair    ? pair.triangles()
                                    : i < of_hands ? triangles_of(hands)
                                                   : triangles_of(bodies);
      all.push_back(measure(works[i], triangles, threads));
      context.progress(++done, sizes.size() * works.size());
    }
  }
  nlohmann::ordered_json json;
  for (const auto& figures : all)
    json.push_back(
        {{"work", figures.work}, {"triangles", figures.triangles}, {"threads", threads}, {"seconds", figures.seconds}});
  write_json(context.out, "threads", json);
  return "Two spheres, two hands in mode certified, and many bodies; first what the machine allows. Medians.\n\n" +
         report(all, threads);
}

}  // namespace lodestone
