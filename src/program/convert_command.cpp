// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/files/small_text.h"
#include "io/gltf/gltf_scene.h"
#include "io/motion/gltf_motion.h"
#include "lodestone/io/files/numbered_files.h"
#include "lodestone/io/motion/animation_edits.h"
#include "lodestone/io/results/animation_output.h"
#include "lodestone/io/scenes/given_objects.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/file_partition.h"
#include "program/float_rounding.h"
#include "program/frame_choice.h"
#include "program/mesh_beside.h"
#include "program/notes.h"
#include "program/progress.h"
#include "program/standard_input.h"

namespace lodestone {

namespace {

namespace fs = std::filesystem;

Animation read_input(const Convert_command& command) {
  const auto the_only_object = [&](const Scene_object& object) {
    refuse_mesh_beside(command.input, command.mesh);
    return animation_of(object, 1);
  };
  if (const auto object = named_object(command.input, command.reading)) return the_only_object(*object);
  if (lower_case(command.input.extension().string()) == ".json")
    return the_only_object(object_of_scene(command.input, "", command.reading));
  const auto rate = command.rate > 0 ? std::optional(command.rate) : std::nullopt;
  return read_animation(command.input,
                        {.mesh = command.mesh, .frames_per_second = rate, .limits = command.reading.limits});
}

/// Of all frames that were written, the two vertices made one that were farthest apart.
using Farthest_parted = std::optional<Parted_vertices>;

Animation edited(Animation animation, const Convert_command& command, Farthest_parted& farthest) try {
  if (command.weld)
    animation = welded(std::move(animation), *command.weld, [&farthest](const Parted_vertices& parted) {
      if (!farthest || parted.distance > farthest->distance) farthest = parted;
    });
  animation = subdivided(std::move(animation), command.subdivisions);
  return command.scale == 1 ? animation : scaled(std::move(animation), command.scale);
} catch (const Bad_argument& error) {
  throw Bad_argument(fmt::format("{}: {}", command.input.string(), error.what()));
}

/// Frames are read while others are written, so the output must not replace a file of the input.
void check_input_is_kept(const Convert_command& command, const Animation& animation, std::size_t frames) {
  std::error_code unknown;
  std::set<fs::path> inputs;
  for (const auto& file : animation.files) inputs.insert(fs::weakly_canonical(file, unknown));
  const auto folder = fs::weakly_canonical(fs::absolute(command.output).parent_path(), unknown);
  const auto place_of = [&](const fs::path& file) {
    // There can be a million. Only a link lies elsewhere than its name says.
    return fs::is_symlink(fs::symlink_status(file, unknown)) ? fs::weakly_canonical(file, unknown)
                                                             : folder / file.filename();
  };
  for (const auto& file : files_of(command.output, frames))
    if (inputs.contains(place_of(file)))
      throw Bad_argument(fmt::format(
          "{}: is a file of the input, which is never overwritten: give another name for OUT", file.string()));
}

bool is_point_cache(const fs::path& file) {
  const auto extension = lower_case(file.extension().string());
  return extension == ".pc2" || extension == ".mdd";
}

/// What needs faces: an option, or the format of the output; empty if nothing does.
std::string use_of_faces(const Convert_command& command) {
  if (command.regions > 0) return "--regions";
  if (command.weld) return "--weld";
  if (command.subdivisions > 0) return "--subdivide";
  return is_point_cache(command.output) ? "" : lower_case(command.output.extension().string());
}

void check_colours(const Convert_command& command) {
  if (command.regions > 0 && !is_gltf(command.output))
    throw Bad_argument(fmt::format("{}: --regions needs .gltf or .glb, the formats that are written with colours",
                                   command.output.string()));
}

/// @throws Bad_argument  there is no time that a rate could change
void check_rate(const Animation& animation, const Convert_command& command) {
  const bool is_written = is_gltf(command.output) || lower_case(command.output.extension().string()) == ".mdd";
  if (command.rate > 0 && animation.kind != "gltf" && !is_written)
    throw Bad_argument(
        fmt::format("{}: --fps needs a glTF file to read, or .gltf, .glb or .mdd, the formats that are written with "
                    "times; the frames of a scene's object are those that the scene chooses",
                    command.output.string()));
}

void check_faces(const Animation& animation, const Convert_command& command) {
  const auto use = use_of_faces(command);
  if (animation.faces.empty() && !use.empty())
    throw Bad_argument(
        fmt::format("{}: {} needs faces, which a point cache does not have: name its mesh with --mesh FILE",
                    command.input.string(), use));
}

Animation_output_options output_options(const Animation& animation, const Convert_command& command) {
  const auto choice = parse_frames(command.frames, animation.motion.frames);
  Animation_output_options options{.frames = list_of(choice)};
  const double own_rate = animation.frames_per_second > 0 ? animation.frames_per_second : usual_rate;
  const double rate = command.rate > 0 ? command.rate : own_rate;
  options.frames_per_second = rate / static_cast<double>(choice.step);
  options.start = choice.first == 0 ? start_at(animation.motion, rate) : 0;
  if (command.regions > 0) {
    auto surface = file_surface(animation, choice.first);
    orient(surface);
    options.regions = divide(surface, command.regions, make_strategy("lbg")).labels;
  }
  return options;
}

/// Looks at the first frame that is written. The others mostly are as far from the origin, and reading each of them
/// again could take long. In glTF, where they are differences to the first, at some of them.
Float_rounding rounding_of(const Convert_command& command, const Animation& animation,
                           std::span<const std::size_t> frames) {
  if (command.quiet || !stores_floats(command.output)) return {};
  std::vector<Point> first(animation.vertices), points(animation.vertices);
  animation.motion.pose(frames.front(), first);
  Float_rounding coarsest = float_rounding(first, animation.faces);
  if (!is_gltf(command.output)) return coarsest;
  constexpr std::size_t most = 8;
  const std::size_t others = frames.size() - 1, looks = std::min(most, others);
  for (std::size_t look = 1; look <= looks; ++look) {
    animation.motion.pose(frames[others * look / looks], points);
    const auto found = float_rounding(points, first, animation.faces);
    if (found.share() > coarsest.share()) coarsest = found;
  }
  return coarsest;
}

void note_rounding(const Convert_command& command, const Float_rounding& rounding) {
  if (rounding.is_coarse())
    note(fmt::format("{}: coordinates are rounded to floats: by up to {:.2g}, which is {:.2g} % of the mesh's size; {}",
                     command.output.string(), rounding.largest, 100 * rounding.share(),
                     rounding.of_difference
                         ? "a frame lies far from the first one, and glTF holds the difference; .pc2 holds each frame "
                           "by itself"
                         : "move it to the origin first"));
}

/// Frames that are so far apart are read as keys between which there is motion.
void note_slow_rate(const Convert_command& command, const Animation_output_options& options) {
  if (is_gltf(command.output) && options.frames.size() > 1 && options.frames_per_second < fewest_keys_per_second)
    note(fmt::format("{}: Lodestone reads glTF with fewer than {} frames per second at {} per second",
                     command.output.string(), fewest_keys_per_second, usual_rate));
}

/// The user of a mesh, a sequence of meshes or a point cache has a mesh file with the faces, unless they were edited.
void note_faces_not_kept(const Convert_command& command, const Animation& animation) {
  const bool are_edited = command.weld || command.subdivisions > 0;
  constexpr std::array<std::string_view, 4> beside_a_mesh{"mesh", "sequence", "pc2", "mdd"};
  const bool are_elsewhere = !are_edited && std::ranges::find(beside_a_mesh, animation.kind) != beside_a_mesh.end();
  if (!is_point_cache(command.output) || animation.faces.empty() || are_elsewhere) return;
  note(fmt::format(
      "{}: faces are not kept: a point cache has none; convert to a mesh file, such as .obj, too, with --frames 0",
      command.output.string()));
}

void note_joined(const Convert_command& command, const Animation& animation, const std::string& name) {
  const auto& joined = animation.motion.joined;
  std::size_t count = 0;
  for (std::size_t vertex = 0; vertex < joined.size(); ++vertex) count += joined[vertex] != vertex ? 1 : 0;
  if (count > 0 && !is_point_cache(command.output))
    note(fmt::format("{}: {} of {} vertices double others along seams; the faces that are written name the others",
                     name, count, joined.size()));
}

/// The faces of both follow one of them, so that the surface is not that of IN.
void note_parted(const std::string& name, const Farthest_parted& farthest) {
  if (!farthest) return;
  note(fmt::format(
      "{}: --weld makes vertices {} and {} (counted from 0) one, but frame {} moves them apart by {:.3g}. The faces of "
      "both follow vertex {}",
      name, farthest->kept, farthest->merged, farthest->frame, farthest->distance, farthest->kept));
}

/// Files of an earlier, longer run would be read with those of this one.
void note_other_files(const Convert_command& command, std::size_t frames) {
  if (is_point_cache(command.output) || is_gltf(command.output) || !is_pattern(command.output)) return;
  std::set<std::string> written;
  for (const auto& file : files_of(command.output, frames)) written.insert(file.filename().string());
  const auto found = names_that_match(command.output);
  const auto others = std::ranges::count_if(found, [&](const auto& name) { return !written.contains(name); });
  if (others > 0)
    note(fmt::format("{}: {}", command.output.string(),
                     others == 1 ? "1 other file matches; it was there before"
                                 : fmt::format("{} other files match; they were there before", others)));
}

/// The file that was written, or the pattern of several. With a .gltf, the file of its numbers too.
std::string shown_files(const std::filesystem::path& output, std::size_t frames) {
  const auto written = files_of(output, frames);
  if (written.size() == 1) return written.front().string();
  const bool has_buffer = written.back().extension() == ".bin";
  return output.string() + (has_buffer ? " and " + written.back().string() : "");
}

void report(const Convert_command& command, const Animation& original, const Animation& animation, std::size_t frames,
            const Float_rounding& rounding, const Farthest_parted& farthest) {
  const auto name = shown_name(command.input);
  note(other_animations_note(name, original.motion.animations));
  note(ignored_extensions_note(name, original.ignored_extensions));
  note(cut_faces_note(name, original.file_face));
  note(not_kept_note(name, original.not_read));
  note_joined(command, original, name);
  note_parted(name, farthest);
  note_faces_not_kept(command, animation);
  note_rounding(command, rounding);
  note_other_files(command, frames);
  fmt::print("{}: {} of {} vertices\n", printable(shown_files(command.output, frames)), counted(frames, "frame"),
             animation.vertices);
}

}  // namespace

int run(const Convert_command& command) {
  check_colours(command);
  const auto original = read_input(command);
  check_rate(original, command);
  check_faces(original, command);
  Farthest_parted farthest;
  const auto animation = edited(original, command, farthest);
  auto options = output_options(animation, command);
  check_input_is_kept(command, animation, options.frames.size());
  const auto rounding = rounding_of(command, animation, options.frames);
  {
    Progress_bar progress("convert", command.quiet);
    options.progress = [&](std::size_t done, std::size_t of) { progress(done, of); };
    write_animation(command.output, animation, options);
  }
  if (command.quiet) return exit_code::success;
  note_slow_rate(command, options);
  report(command, original, animation, options.frames.size(), rounding, farthest);
  return exit_code::success;
}

}  // namespace lodestone
