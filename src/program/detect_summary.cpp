// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/detect_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/files/small_text.h"
#include "lodestone/io/meshes/file_faces.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/version.h"
#include "program/standard_input.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// More do not fit on a screen.
constexpr std::size_t most_rows = 20;

/// The standard input is kept in a file that is gone when a summary is read.
std::string shown_file(const std::filesystem::path& file) {
  const std::string text = file.string();
  return naming_standard_input(text) == text ? file.lexically_normal().string() : "-";
}

Json object_summary_json(const Run_subject& subject, Object_id id) {
  const auto& object = subject.scene.objects[id];
  Json files = Json::array();
  for (const auto& file : object.files) files.push_back(shown_file(file));
  Json json{{"name", object.name},
            {"files", std::move(files)},
            {"vertices", object.mesh.number_of_vertices()},
            {"faces", count_file_faces(object.file_face).count},
            {"triangles", object.mesh.number_of_faces()}};
  if (finds_all(subject.command.options.mode)) {
    json["leaves"] = subject.detector->tree(id).leaf_count();
  } else {
    json["particles"] = subject.detector->object(id).particles().at.size();
    json["joined_vertices"] = subject.detector->object(id).joined_vertices();
  }
  return json;
}

Json number_or_null(std::optional<std::size_t> frame) { return frame ? Json(*frame) : Json(); }

Json truth_json(Score score) {
  score.finish();
  return {{"colliding_frames", score.positives()},  {"recall", score.recall()},
          {"precision", score.precision()},         {"accuracy", score.accuracy()},
          {"collisions", score.collisions()},       {"never_seen", score.never_seen()},
          {"mean_delay_frames", score.mean_delay()}};
}

Json pair_summary_json(const Run_subject& subject, Object_pair pair, const Pair_summary& summary) {
  Json json{{"a", subject.scene.objects[pair.a].name},
            {"b", subject.scene.objects[pair.b].name},
            {"colliding_frames", summary.colliding_frames},
            {"first_colliding_frame", number_or_null(summary.first_colliding)},
            {"last_colliding_frame", number_or_null(summary.last_colliding)},
            {"face_pairs", summary.face_pairs}};
  if (tolerance_of(subject.command.options.exact, pair) > 0) json["near_frames"] = summary.near_frames;
  if (summary.capped_frames > 0) json["capped_frames"] = summary.capped_frames;
  if (summary.unfinished_frames > 0) json["unfinished_frames"] = summary.unfinished_frames;
  if (subject.command.options.exact.containment) json["contained_frames"] = summary.contained_frames;
  if (subject.command.options.exact.parting && pair.a != pair.b)
    json["longest_parting"] = summary.longest_parting ? Json(*summary.longest_parting) : Json();
  if (const auto& least = summary.least_distance) {
    json["least_distance"] = least->distance;
    json["least_distance_frame"] = least->frame;
  }
  if (subject.command.impacts) {
    const auto& impact = summary.first_impact;
    json["first_impact"] = impact ? Json{{"frame", impact->frame}, {"time", impact->time}} : Json();
    json["passings"] = summary.passings;
  }
  if (subject.has_truth(pair)) json["truth"] = truth_json(summary.score);
  return json;
}

/// Null for a mode that misses nothing.
Json misses_json(const Run_subject& subject) {
  const auto& options = subject.command.options;
  if (!may_miss(options)) return nullptr;
  const auto missed = expected_misses(options, particle_setting(subject.command, subject.scene));
  if (!missed) return {{"least_share", nullptr}, {"most_share", nullptr}, {"experiment", nullptr}};
  return {{"least_share", missed->least}, {"most_share", missed->most}, {"experiment", missed->experiment}};
}

bool is_empty(const Pair_summary& summary) {
  return summary.colliding_frames == 0 && summary.near_frames == 0 && summary.contained_frames == 0 &&
         !summary.longest_parting && !summary.least_distance && !summary.first_impact && summary.score.positives() == 0;
}

/// The pair with the least distance in any frame; nothing without --closest.
std::optional<Object_pair> closest_pair(const Run_summary& summary) {
  std::optional<Object_pair> closest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [pair, results] : summary.pairs) {
    if (!results.least_distance || results.least_distance->distance >= least) continue;
    least = results.least_distance->distance;
    closest = pair;
  }
  return closest;
}

double in_frames(const First_impact& impact) { return static_cast<double>(impact.frame) + impact.time; }

/// The pair that meets first in the run; nothing without --impacts.
std::optional<Object_pair> first_pair_to_meet(const Run_summary& summary) {
  std::optional<Object_pair> first;
  double earliest = std::numeric_limits<double>::infinity();
  for (const auto& [pair, results] : summary.pairs) {
    if (!results.first_impact || in_frames(*results.first_impact) >= earliest) continue;
    earliest = in_frames(*results.first_impact);
    first = pair;
  }
  return first;
}

/// In how many frames pairs truly collide, and in how many of these that was found. Each pair counts its own.
std::string truth_text(const Run_subject& subject, const Run_summary& summary) {
  Score all;
  for (const auto& [pair, results] : summary.pairs)
    if (subject.has_truth(pair)) all.add(results.score);
  return fmt::format("; truth: {}, summed over the pairs, {} found", counted(all.positives(), "colliding frame"),
                     all.positives() - all.false_negatives());
}

std::size_t count_passings(const Run_summary& summary) {
  std::size_t count = 0;
  for (const auto& [pair, results] : summary.pairs) count += results.passings;
  return count;
}

std::vector<std::string> table_header(const Detect_command& command) {
  std::vector<std::string> header{"object a", "object b", "frames", "colliding", "first", "last"};
  if (command.options.contacts == Contact_query::all) header.emplace_back("face pairs");
  if (has_tolerance(command.options.exact)) header.emplace_back("near");
  if (command.options.exact.containment) header.emplace_back("one inside");
  if (command.options.exact.parting) header.emplace_back("parting");
  if (command.closest) header.insert(header.end(), {"least distance", "in frame"});
  if (command.impacts) header.insert(header.end(), {"first impact", "passings"});
  if (command.truth) header.insert(header.end(), {"truly", "recall", "precision", "accuracy"});
  return header;
}

std::vector<std::string> table_row(const Run_subject& subject, Object_pair pair, const Pair_summary& summary) {
  const auto& scene = subject.scene;
  const auto text = [](std::optional<std::size_t> frame) { return frame ? std::to_string(*frame) : "-"; };
  std::vector<std::string> row{scene.objects[pair.a].name,    scene.objects[pair.b].name,
                               std::to_string(scene.frames),  std::to_string(summary.colliding_frames),
                               text(summary.first_colliding), text(summary.last_colliding)};
  if (subject.command.options.contacts == Contact_query::all) row.push_back(std::to_string(summary.face_pairs));
  if (has_tolerance(subject.command.options.exact))
    row.push_back(tolerance_of(subject.command.options.exact, pair) > 0 ? std::to_string(summary.near_frames) : "-");
  if (subject.command.options.exact.containment) row.push_back(std::to_string(summary.contained_frames));
  if (subject.command.options.exact.parting)
    row.push_back(summary.longest_parting ? fmt::format("{:.3g}", *summary.longest_parting) : "-");
  if (const auto& least = summary.least_distance)
    row.insert(row.end(), {fmt::format("{:.6g}", least->distance), std::to_string(least->frame)});
  else if (subject.command.closest)
    row.insert(row.end(), {"-", "-"});
  if (const auto& impact = summary.first_impact)
    row.insert(row.end(), {fmt::format("{:.9g}", in_frames(*impact)), std::to_string(summary.passings)});
  else if (subject.command.impacts)
    row.insert(row.end(), {"-", "-"});
  if (subject.has_truth(pair))
    row.insert(row.end(),
               {std::to_string(summary.score.positives()), fmt::format("{:.3f}", summary.score.recall()),
                fmt::format("{:.3f}", summary.score.precision()), fmt::format("{:.3f}", summary.score.accuracy())});
  else if (subject.command.truth)
    row.insert(row.end(), {"-", "-", "-", "-"});
  return row;
}

/// How many pairs the run looks at; with --self also objects with themselves.
std::size_t count_pairs(const Run_subject& subject) {
  const Scene& scene = subject.scene;
  const std::size_t first = subject.command.options.exact.self_collision ? 0 : 1;
  std::size_t count = 0;
  for (Object_id a = 0; a < scene.objects.size(); ++a)
    for (auto b = static_cast<Object_id>(a + first); b < scene.objects.size(); ++b)
      count += scene.ignores({a, b}) ? 0 : 1;
  return count;
}

void print_pairs(const Run_subject& subject, const Run_summary& summary) {
  const bool many = subject.scene.objects.size() > 4;
  Text_table table(table_header(subject.command));
  std::size_t capped = 0, unfinished = 0, rows = 0;
  const std::size_t row_limit = subject.command.all_rows ? summary.pairs.size() : most_rows;
  for (const auto& [pair, results] : summary.pairs) {
    capped += results.capped_frames;
    unfinished += results.unfinished_frames;
    if (many && is_empty(results)) continue;
    if (++rows <= row_limit) table.add(table_row(subject, pair, results));
  }
  // Pairs that never came near each other are in no list.
  const bool omits = rows < summary.pairs.size() || summary.pairs.size() < count_pairs(subject);
  if (rows > 0) fmt::print("{}", table.text());
  if (rows > row_limit) fmt::print("{} more pairs are omitted: --all-rows prints them.\n", rows - row_limit);
  if (rows > 0 && omits)
    fmt::print("Pairs {} are omitted.\n", many ? "of which nothing was found" : "that never came near each other");
  if (rows == 0 && omits)
    fmt::print("{}\n", many ? "No collision was found." : "No collision: no two objects came near each other.");
  if (rows == 0 && !omits) fmt::print("There is no pair of objects.\n");
  if (capped > 0) fmt::print("--most-contacts cut off face pairs {}.\n", counted(capped, "time"));
  if (unfinished > 0)
    fmt::print("The budget of openings was used up {}, and contacts can be missing: --opening-budget raises it.\n",
               counted(unfinished, "time"));
}

const char* building_of(const Run_subject& subject) {
  const Detector_options& options = subject.command.options;
  if (finds_all(options.mode))
    return makes_regions(options, subject.scene) ? "numbering, partition, tree" : "numbering, tree";
  if (options.mode == Mode::senin) return "numbering, particles";
  return options.meetings > 0 ? "numbering, partition, tree" : "numbering, partition";
}

/// What a frame has done on average, beside exact tests.
std::string work_of(const Detector_options& options, const Measurement& measurement) {
  const auto mean = [&](std::size_t Frame_statistics::*count) { return mean_count(measurement, count); };
  if (options.mode == Mode::certified)
    return fmt::format("{:.0f} vertices read, {:.1f} nodes bounded, {:.1f} pairs of leaves",
                       mean(&Frame_statistics::vertices_read), mean(&Frame_statistics::nodes_bounded),
                       mean(&Frame_statistics::leaf_tests));
  if (finds_all(options.mode)) return fmt::format("{:.1f} pairs of leaves", mean(&Frame_statistics::leaf_tests));
  if (options.mode == Mode::senin || options.meetings == 0)
    return fmt::format("{:.1f} iterations", mean(&Frame_statistics::iterations));
  return fmt::format("{:.0f} vertices read, {:.1f} meetings, {:.1f} pairs of leaves",
                     mean(&Frame_statistics::vertices_read), mean(&Frame_statistics::meetings),
                     mean(&Frame_statistics::leaf_tests));
}

void print_times(const Run_subject& subject, const Run_summary& summary) {
  const Detector_options& options = subject.command.options;
  const Measurement& measurement = summary.measurement;
  fmt::print("{:.1f} microseconds per frame (median, all stages but build), {}, {:.1f} exact tests (mean)\n",
             median_microseconds_without_build(measurement), work_of(options, measurement),
             mean_count(measurement, &Frame_statistics::exact_tests));
  if (summary.builds == 0) return;
  fmt::print("{:.1f} milliseconds to build {} object{}: {}\n", 1e3 * measurement.build_seconds, summary.builds,
             summary.builds == 1 ? "" : "s", building_of(subject));
}

}  // namespace

void Pair_summary::add(std::size_t frame, const Pair_result& pair) {
  near_frames += pair.near ? 1 : 0;
  face_pairs += pair.contacts;
  capped_frames += pair.capped ? 1 : 0;
  unfinished_frames += pair.unfinished ? 1 : 0;
  contained_frames += pair.containment != Containment::none ? 1 : 0;
  if (pair.parting) longest_parting = std::max(longest_parting.value_or(0), pair.parting->length);
  if (!pair.collides) return;
  ++colliding_frames;
  if (!first_colliding) first_colliding = frame;
  last_colliding = frame;
  met_on_the_way = false;
}

void Pair_summary::end_way() {
  passings += met_on_the_way ? 1 : 0;
  met_on_the_way = false;
}

void Pair_summary::add_impact(std::size_t frame, double time) {
  if (!first_impact) first_impact = {.frame = frame, .time = time};
  met_on_the_way = last_colliding != frame;
}

void Run_summary::add(const Frame_tally& tally, bool timed) {
  for (const auto& pair : tally.pairs) pairs[{pair.a, pair.b}].add(tally.frame, pair);
  for (auto& [pair, results] : pairs) results.end_way();
  for (const auto& [pair, time] : tally.impacts) pairs[pair].add_impact(tally.frame, time);
  for (const auto& [pair, truth, seen] : tally.scores) pairs[pair].score.add(pair, truth, seen);
  for (const auto& [pair, distance] : tally.distances) {
    auto& least = pairs[pair].least_distance;
    if (!least || distance < least->distance) least = {.distance = distance, .frame = tally.frame};
  }
  if (timed) measurement.frames.push_back(tally.statistics);
  builds += tally.statistics.builds;
  measurement.build_seconds += tally.statistics.seconds.build;
}

bool Run_summary::finds_any() const {
  return std::ranges::any_of(pairs, [](const auto& pair) {
    return pair.second.colliding_frames > 0 || pair.second.near_frames > 0 || pair.second.first_impact;
  });
}

Json objects_json(const Run_subject& subject) {
  if (!subject.objects.is_null()) return subject.objects;
  Json objects = Json::array();
  for (Object_id o = 0; o < subject.scene.objects.size(); ++o) objects.push_back(object_summary_json(subject, o));
  return objects;
}

Json summary_json(const Run_subject& subject, const Run_summary& summary) {
  const Mode mode = subject.command.options.mode;
  const bool divides = makes_regions(subject.command.options, subject.scene);
  Json json{{"version", version()},
            {"revision", subject.revision},
            {"command", subject.command.words},
            {"scene", subject.scene.name},
            {"frames", subject.scene.frames},
            {"mode", name_of(mode)},
            {"may_miss", misses_json(subject)},
            {"strategy", divides ? Json(subject.command.partition.name) : Json()},
            {"objects", objects_json(subject)},
            {"pairs", Json::array()}};
  for (const auto& [pair, results] : summary.pairs) json["pairs"].push_back(pair_summary_json(subject, pair, results));
  const Json measured = to_json(summary.measurement);
  for (const char* key : {"mean_iterations", "mean_moves", "mean_candidates", "mean_leaf_tests", "mean_exact_tests",
                          "mean_repartitions", "median_microseconds"})
    json[key] = measured[key];
  if (mode == Mode::certified)
    for (const char* key : {"mean_vertices_read", "mean_nodes_bounded", "mean_leaves_posed", "mean_violations"})
      json[key] = measured[key];
  json["build_microseconds"] = 1e6 * summary.measurement.build_seconds;
  return json;
}

std::string one_line_answer(const Run_subject& subject, const Run_summary& summary) {
  std::size_t colliding = 0, near = 0, first = subject.scene.frames, last = 0;
  for (const auto& [pair, results] : summary.pairs) {
    near += results.near_frames > 0 ? 1 : 0;
    if (results.colliding_frames == 0) continue;
    ++colliding;
    first = std::min(first, *results.first_colliding);
    last = std::max(last, *results.last_colliding);
  }
  auto text = fmt::format("{}: {}", subject.scene.name, counted(colliding, "colliding pair"));
  if (colliding > 0) text += fmt::format(", first in frame {}, last in frame {}", first, last);
  text += (colliding > 0 ? " of " : " in ") + counted(subject.scene.frames, "frame");
  if (has_tolerance(subject.command.options.exact)) text += fmt::format("; {} near", near);
  if (const auto pair = closest_pair(summary)) {
    const auto& least = *summary.pairs.at(*pair).least_distance;
    text += fmt::format("; least distance {} in frame {}, of {} and {}", least.distance, least.frame,
                        subject.scene.objects[pair->a].name, subject.scene.objects[pair->b].name);
  }
  if (const auto pair = first_pair_to_meet(summary))
    text += fmt::format("; first impact at {:.9g}, of {} and {}; {}", in_frames(*summary.pairs.at(*pair).first_impact),
                        subject.scene.objects[pair->a].name, subject.scene.objects[pair->b].name,
                        counted(count_passings(summary), "passing"));
  if (subject.command.truth) text += truth_text(subject, summary);
  return text + "\n";
}

void print_summary(const Run_subject& subject, const Run_summary& summary) {
  fmt::print("{}: {}, {}\n\n", subject.scene.name, counted(subject.scene.objects.size(), "object"),
             counted(subject.scene.frames, "frame"));
  print_pairs(subject, summary);
  fmt::print("\n");
  print_times(subject, summary);
  const auto setting = particle_setting(subject.command, subject.scene);
  if (const auto note = missing_note(subject.command.options, setting)) fmt::print("{}\n", *note);
}

}  // namespace lodestone
