// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/is_closed.h"
#include "lodestone/mesh/joined_vertices.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "program/commands.h"
#include "program/detect_run.h"
#include "program/detect_shards.h"
#include "program/exit_codes.h"
#include "program/folder_lock.h"
#include "program/frame_log.h"
#include "program/notes.h"
#include "program/progress.h"
#include "program/slurm_scripts.h"
#include "program/unquoted_pattern.h"

namespace lodestone {

namespace {

/// A scene may have the name that a result has, alone or before the name of one of its objects.
void check_inputs_are_kept(const Detect_command& command) {
  if (command.out.empty()) return;
  std::error_code unknown;
  const auto summary = weakly_canonical(command.out / "summary.json", unknown);
  for (const auto& input : command.inputs) {
    const std::string text = input.string();
    const auto mark = lower_case(text).find(".json#");
    const auto file = mark == text.npos ? text : text.substr(0, text.find('#', mark));
    if (std::filesystem::weakly_canonical(file, unknown) == summary)
      throw Bad_argument(file + ": --out would replace this input, which is never overwritten");
  }
}

/// Writes all files to disk before the first appears.
void write_results(Detect_run& scene_run, std::optional<Atomic_file>& frames, const Detect_command& command) {
  std::optional<Atomic_file> summary;
  if (frames) {
    summary.emplace(command.out / "summary.json");
    summary->write(json_text(scene_run.summary(), 2));
    frames->finish();
    summary->finish();
  }
  check_interrupt();
  if (scene_run.page() != nullptr) scene_run.page()->finish();
  if (scene_run.paraview() != nullptr) scene_run.paraview()->finish();
  check_interrupt();  // a large page takes a while
  std::optional<Folder_lock> lock;
  if (frames) lock.emplace(command.out);
  if (frames) Shard_folder::note_replaced(command.out);
  if (frames) frames->commit();
  if (summary) summary->commit();
  if (command.merge_shards) Shard_folder(command.out).note_merged({"frames.jsonl", "summary.json"});
  if (scene_run.page() != nullptr) scene_run.page()->commit();
  if (scene_run.paraview() != nullptr) scene_run.paraview()->commit();
}

void note_single_object(const Scene& scene, const Detect_command& command) {
  if (scene.objects.size() == 1 && !command.options.exact.self_collision)
    note(
        fmt::format("{}: one object alone has nothing to collide with; add another to the scene, or --self for "
                    "collisions with itself{}",
                    command.inputs.front().string(), hint_at_components(command)));
}

void note_unquoted_pattern(const Detect_command& command) {
  if (const auto found = find_unquoted_pattern(command.inputs))
    note(fmt::format(
        "{} inputs differ only in a number; if they are frames of one object, put the pattern in quotes: {}",
        found->inputs, shell_word(found->pattern.string())));
}

/// Motions of different lengths: a scene ends with the shortest, unless it says to end earlier; files that are given
/// without a scene are played to the end of the longest.
void note_lengths(const Scene& scene, bool is_from_file) {
  const std::size_t least = is_from_file ? 1 : 2;  // a motion that does not end has none, a mesh that stands still one
  const Scene_object *shortest = nullptr, *longest = nullptr;
  for (const auto& object : scene.objects) {
    if (object.motion.frames < least) continue;
    if (shortest == nullptr || object.motion.frames < shortest->motion.frames) shortest = &object;
    if (longest == nullptr || object.motion.frames > longest->motion.frames) longest = &object;
  }
  if (shortest == nullptr || shortest->motion.frames == longest->motion.frames) return;
  if (is_from_file && scene.frames < shortest->motion.frames) return;
  note(fmt::format(
      "the shortest motion, of {}, has {}, the longest, of {}, has {}: {}", shortest->name,
      counted(shortest->motion.frames, "frame"), longest->name, counted(longest->motion.frames, "frame"),
      is_from_file ? "the scene ends with the shortest" : "an object whose motion has ended keeps its last pose"));
}

/// Notes of one kind: those of the first objects, and how many objects there are more.
/// @param text_of  empty: nothing is to be noted of that object
void note_each(const Scene& scene, const std::function<std::string(Object_id)>& text_of) {
  constexpr std::size_t most = 3;
  std::size_t noted = 0;
  for (Object_id id = 0; id < scene.objects.size(); ++id) {
    const auto text = text_of(id);
    noted += text.empty() ? 0 : 1;
    if (noted <= most) note(text);
  }
  if (noted > most) note(fmt::format("the same holds for {}", counted(noted - most, "more object")));
}

void note_objects(const Detect_run& scene_run) {
  const Scene& scene = scene_run.scene();
  const auto& objects = scene.objects;
  note_each(scene,
            [&](Object_id id) { return other_animations_note(objects[id].name, objects[id].motion.animations); });
  note_each(scene,
            [&](Object_id id) { return ignored_extensions_note(objects[id].name, objects[id].ignored_extensions); });
  note_each(scene, [&](Object_id id) { return cut_faces_note(objects[id].name, objects[id].file_face); });
  note_each(scene, [&](Object_id id) {
    return joined_vertices_note(objects[id].name, scene_run.joined_vertices(id), objects[id].file_vertex);
  });
}

/// Where it is asked what lies inside what.
void note_open_surfaces(const Scene& scene) {
  note_each(scene, [&](Object_id id) {
    const Scene_object& object = scene.objects[id];
    const Mesh_numbering<Surface_mesh> numbering(object.mesh);
    const auto joined = join_vertices(numbering.corners(), numbering.vertex_count(), object.file_vertex);
    const bool closed = is_closed(numbering.vertex_count(), joined.empty() ? numbering.corners() : std::span(joined));
    return closed ? std::string() : open_surface_note(object.name);
  });
}

/// Mode `certified` computes only positions that may be near others; these options need all.
void print_computed_positions(const Detect_run& scene_run, const Detect_command& command) {
  std::vector<std::string_view> options;
  if (!command.html.empty()) options.emplace_back("--html");
  if (!command.paraview.empty()) options.emplace_back("--paraview");
  if (command.truth) options.emplace_back("--truth");
  if (scene_run.computes_positions() && !options.empty())
    fmt::print("all objects were also posed as a whole, outside the times, for {}\n", fmt::join(options, ", "));
}

/// What is found of contacts is too long for a terminal.
void note_unwritten(const Detect_command& command) {
  if (!command.out.empty() || !command.html.empty()) return;
  std::vector<std::string_view> options;
  if (command.options.contact_points) options.emplace_back("--points");
  if (command.options.contact_normals) options.emplace_back("--normals");
  if (command.options.exact.patches) options.emplace_back("--patches");
  if (!options.empty()) note(fmt::format("only --out and --html tell what was found for {}", fmt::join(options, ", ")));
}

/// What the user reads on the terminal.
void print_results(Detect_run& scene_run, const Detect_command& command) {
  if (command.json) return fmt::print("{}", json_text(scene_run.summary(), 2));
  if (command.quiet) return fmt::print("{}", scene_run.answer());
  note_lengths(scene_run.scene(), is_scene_file(command.inputs));
  note_single_object(scene_run.scene(), command);
  note_unquoted_pattern(command);
  note_objects(scene_run);
  note_unwritten(command);
  if (command.options.exact.containment || command.options.exact.parting) note_open_surfaces(scene_run.scene());
  scene_run.print();
  print_computed_positions(scene_run, command);
  if (!command.out.empty()) fmt::print("results: {}\n", printable(command.out.string()));
  if (scene_run.page() != nullptr) fmt::print("{}", scene_run.page()->summary());
  if (scene_run.paraview() != nullptr) fmt::print("ParaView: {}\n", printable(command.paraview.string()));
}

int exit_code_of(const Detect_run& scene_run, const Detect_command& command) {
  if (scene_run.contradicts_truth()) return exit_code::contradicts_truth;
  return command.exit_code && scene_run.finds_any() ? exit_code::collides : exit_code::success;
}

}  // namespace

int run(const Detect_command& command) {
  check_shard_options(command);
  check_inputs_are_kept(command);
  if (command.shard) return run_shard(command);
  Detect_run scene_run(command);
  std::optional<Atomic_file> frames;
  if (!command.out.empty()) frames.emplace(command.out / "frames.jsonl");
  if (command.merge_shards) {
    merge_shards(scene_run, *frames, command);
  } else {
    Progress_bar progress("detect", command.quiet || command.json);
    for (std::size_t frame = 0; frame < scene_run.frames(); ++frame) {
      const auto line = scene_run.play(frame);
      if (frames) frames->write(line);
      progress(frame + 1, scene_run.frames());
    }
  }
  write_results(scene_run, frames, command);
  print_results(scene_run, command);
  return exit_code_of(scene_run, command);
}

}  // namespace lodestone
