// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/detect_shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/files/small_text.h"
#include "program/exit_codes.h"
#include "program/progress.h"
#include "program/shards.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

Work work_of(std::vector<std::string> words, std::size_t shards, Detect_run& scene_run) {
  return {.command = std::move(words),
          .shards = shards,
          .pieces = scene_run.frames(),
          .inputs = {{"scene", scene_run.hash_of_inputs()}}};
}

/// Objects are built in frame 0, as in an unsharded run; then particles walk for a while.
void warm_up(Detect_run& scene_run, const Detect_command& command, std::size_t first) {
  if (first == 0) return;
  scene_run.warm_up(0);
  const std::size_t frames = std::min(command.warm_up.value_or(0), first - 1);
  for (std::size_t frame = first - frames; frame < first; ++frame) {
    check_interrupt();
    scene_run.warm_up(frame);
  }
}

/// Each frame as its line of frames.jsonl, and a line of what the summary needs to know of it.
void play(Detect_run& scene_run, const Detect_command& command, const std::vector<std::size_t>& frames,
          Shard_writer& shard) {
  warm_up(scene_run, command, frames.front());
  Progress_bar progress(fmt::format("shard {}", command.shard->index), command.quiet || command.json);
  for (const auto frame : frames) {
    std::string line = scene_run.play(frame);
    line.pop_back();  // the line break
    shard.add(line);
    shard.add(to_json(scene_run.last_tally()).dump());
    progress(frame - frames.front() + 1, frames.size());
  }
}

/// A tally that is of this scene.
/// @throws Json::exception  it is not
Frame_tally checked(Frame_tally tally, const Scene& scene) {
  const auto is_known = [&](Object_pair pair) { return std::max(pair.a, pair.b) < scene.objects.size(); };
  const auto are_known = [&](const auto& list) {
    return std::ranges::all_of(list, [&](const auto& entry) { return is_known(entry.pair); });
  };
  const bool pairs_are_known = std::ranges::all_of(tally.pairs, [&](const Pair_result& pair) {
    return is_known({pair.a, pair.b});
  });
  if (tally.frame >= scene.frames || !pairs_are_known || !are_known(tally.scores) || !are_known(tally.distances) ||
      !are_known(tally.impacts))
    throw Json::out_of_range::create(401, "a frame or an object that the scene does not have", nullptr);
  return tally;
}

}  // namespace

void check_shard_options(const Detect_command& command) {
  const bool sharded = command.shard || command.merge_shards;
  if (command.warm_up && !sharded) throw Bad_argument("--warm-up is for --shard");
  if (!sharded) return;
  if (command.out.empty()) throw Bad_argument("--shard needs --out, the folder of all shards");
  if (!command.html.empty()) throw Bad_argument("--shard writes no page: --html needs all frames in one run");
  if (!command.paraview.empty()) throw Bad_argument("--shard writes no files for ParaView");
  if (std::ranges::find(command.words, "-") != command.words.end())
    throw Bad_argument("--shard cannot read the standard input: other shards need the same mesh");
  if (!finds_all(command.options.mode) && !command.warm_up)
    throw Bad_argument(
        fmt::format("mode {}: an answer depends on all frames before it, so shards can answer otherwise than one run; "
                    "--warm-up W accepts that, and plays W frames before each shard",
                    name_of(command.options.mode)));
}

int run_shard(const Detect_command& command) {
  const Shard& shard = *command.shard;
  const bool tells = !command.quiet && !command.json;
  Detect_run scene_run(command);
  const Shard_folder folder(command.out, work_of(command.words, shard.count, scene_run), Shard_use::make);
  const auto frames = shard.neighbours(scene_run.frames());
  if (folder.is_done(shard.index)) {
    if (tells) fmt::print("shard {} of {} is done already\n", shard.index, shard.count);
    return exit_code::success;
  }
  Shard_writer writer(folder, shard.index);
  Json more = Json::object();
  if (!frames.empty()) {
    play(scene_run, command, frames, writer);
    more["objects"] = scene_run.objects();
  }
  writer.commit(more);
  if (tells)
    fmt::print("shard {} of {}: {} of {}, in {}\n", shard.index, shard.count, frames.size(),
               counted(scene_run.frames(), "frame"), printable(folder.file(shard.index).string()));
  return exit_code::success;
}

void merge_shards(Detect_run& scene_run, Atomic_file& frames, const Detect_command& command) {
  const Shard_folder made(command.out);
  const Shard_folder folder(command.out, work_of(made.command(), made.shards(), scene_run), Shard_use::merge);
  scene_run.set_revision(folder.manifest()["revision"]);
  bool is_tally = false;
  const auto records = folder.read_all([&](std::string_view line) {
    check_interrupt();
    if (is_tally) {
      scene_run.add(checked(frame_tally_of(parse_shard_line(line)), scene_run.scene()));
    } else {
      frames.write(line);
      frames.write("\n");
    }
    is_tally = !is_tally;
  });
  for (const auto& record : records)
    if (record.contains("objects")) scene_run.set_objects(record["objects"]);
}

}  // namespace lodestone
