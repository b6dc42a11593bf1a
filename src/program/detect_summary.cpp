// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/detect_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lodestone/io/results/text_table.h"
#include "program/missed_frames.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

Json object_summary_json(const Run_subject& subject, Object_id id) {
  const auto& object = subject.scene.objects[id];
  Json json{
      {"name", object.name}, {"vertices", object.mesh.number_of_vertices()}, {"faces", object.mesh.number_of_faces()}};
  if (subject.command.options.mode == Mode::exact)
    json["leaves"] = subject.detector.tree(id).leaf_count();
  else
    json["particles"] = subject.detector.object(id).particles().at.size();
  return json;
}

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
            {"face_pairs", summary.face_pairs}};
  if (subject.command.options.exact.tolerance > 0 && pair.a != pair.b) json["near_frames"] = summary.near_frames;
  if (summary.capped_frames > 0) json["capped_frames"] = summary.capped_frames;
  if (subject.command.options.exact.containment) json["contained_frames"] = summary.contained_frames;
  if (subject.has_truth(pair)) json["truth"] = truth_json(summary.score);
  return json;
}

/// Null for a mode that misses nothing.
Json misses_json(Mode mode) {
  const auto missed = expected_misses(mode);
  if (!missed) return nullptr;
  return {{"least_share", missed->least}, {"most_share", missed->most}, {"experiment", missed->experiment}};
}

bool is_empty(const Pair_summary& summary) {
  return summary.colliding_frames == 0 && summary.near_frames == 0 && summary.contained_frames == 0 &&
         summary.score.positives() == 0;
}

std::vector<std::string> table_header(const Detect_command& command) {
  std::vector<std::string> header{"object a", "object b", "frames", "colliding"};
  if (command.options.exact.tolerance > 0) header.emplace_back("near");
  if (command.options.exact.containment) header.emplace_back("one inside");
  if (command.truth) header.insert(header.end(), {"truly", "recall", "precision", "accuracy"});
  return header;
}

std::vector<std::string> table_row(const Run_subject& subject, Object_pair pair, const Pair_summary& summary) {
  const auto& scene = subject.scene;
  std::vector<std::string> row{scene.objects[pair.a].name, scene.objects[pair.b].name, std::to_string(scene.frames),
                               std::to_string(summary.colliding_frames)};
  if (subject.command.options.exact.tolerance > 0)
    row.push_back(pair.a == pair.b ? "-" : std::to_string(summary.near_frames));
  if (subject.command.options.exact.containment) row.push_back(std::to_string(summary.contained_frames));
  if (subject.has_truth(pair))
    row.insert(row.end(),
               {std::to_string(summary.score.positives()), fmt::format("{:.3f}", summary.score.recall()),
                fmt::format("{:.3f}", summary.score.precision()), fmt::format("{:.3f}", summary.score.accuracy())});
  else if (subject.command.truth)
    row.insert(row.end(), {"-", "-", "-", "-"});
  return row;
}

void print_pairs(const Run_subject& subject, const Run_summary& summary) {
  const bool many = subject.scene.objects.size() > 4;
  Text_table table(table_header(subject.command));
  std::size_t capped = 0;
  for (const auto& [pair, results] : summary.pairs) {
    capped += results.capped_frames;
    if (!many || !is_empty(results)) table.add(table_row(subject, pair, results));
  }
  fmt::print("{}", table.text());
  if (many) fmt::print("Pairs of which nothing was found are omitted.\n");
  if (capped > 0) fmt::print("Face pairs were cut off by --most-contacts {} times.\n", capped);
}

const char* building_of(Mode mode) {
  if (mode == Mode::exact) return "numbering, partition, tree";
  return mode == Mode::senin ? "numbering, particles" : "numbering, partition";
}

void print_times(const Run_subject& subject, const Run_summary& summary) {
  const bool exact = subject.command.options.mode == Mode::exact;
  const Measurement& measurement = summary.measurement;
  fmt::print("{:.1f} microseconds per frame (median, all stages but build), {:.1f} {}, {:.1f} exact tests (mean)\n",
             median_microseconds_without_build(measurement),
             mean_count(measurement, exact ? &Frame_statistics::candidates : &Frame_statistics::iterations),
             exact ? "pairs of leaves" : "iterations", mean_count(measurement, &Frame_statistics::exact_tests));
  fmt::print("{:.1f} milliseconds to build {} objects: {}\n", 1e3 * measurement.build_seconds, summary.builds,
             building_of(subject.command.options.mode));
}

}  // namespace

void Pair_summary::add(const Pair_result& pair) {
  colliding_frames += pair.collides ? 1 : 0;
  near_frames += pair.near ? 1 : 0;
  face_pairs += pair.contacts;
  capped_frames += pair.capped ? 1 : 0;
  contained_frames += pair.containment != Containment::none ? 1 : 0;
}

void Run_summary::add(const Frame& frame, bool timed) {
  for (const auto& pair : frame.pairs) pairs[{pair.a, pair.b}].add(pair);
  if (timed) measurement.frames.push_back(frame.statistics);
  builds += frame.statistics.builds;
  measurement.build_seconds += frame.statistics.seconds.build;
}

Json summary_json(const Run_subject& subject, const Run_summary& summary) {
  const Mode mode = subject.command.options.mode;
  Json json{{"scene", subject.scene.name},
            {"frames", subject.scene.frames},
            {"mode", name_of(mode)},
            {"may_miss", misses_json(mode)},
            {"strategy", subject.command.partition.name},
            {"objects", Json::array()},
            {"pairs", Json::array()}};
  for (Object_id o = 0; o < subject.scene.objects.size(); ++o)
    json["objects"].push_back(object_summary_json(subject, o));
  for (const auto& [pair, results] : summary.pairs) json["pairs"].push_back(pair_summary_json(subject, pair, results));
  const Json measured = to_json(summary.measurement);
  for (const char* key : {"mean_iterations", "mean_moves", "mean_candidates", "mean_exact_tests", "mean_repartitions",
                          "median_microseconds"})
    json[key] = measured[key];
  json["build_microseconds"] = 1e6 * summary.measurement.build_seconds;
  return json;
}

void print_summary(const Run_subject& subject, const Run_summary& summary) {
  fmt::print("{}: {} objects, {} frames\n\n", subject.scene.name, subject.scene.objects.size(), subject.scene.frames);
  print_pairs(subject, summary);
  fmt::print("\n");
  print_times(subject, summary);
  if (const auto note = missing_note(subject.command.options.mode)) fmt::print("{}\n", *note);
}

}  // namespace lodestone
