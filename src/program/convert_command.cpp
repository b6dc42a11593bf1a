// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/results/animation_output.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/printable.h"
#include "program/progress.h"

namespace lodestone {

namespace {

constexpr double usual_rate = 30;

/// The frames of `first:last:step`, including the last; each part may be omitted.
struct Frame_choice {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t step = 1;
};

std::size_t number(std::string_view text, std::size_t otherwise, const std::string& choice) {
  if (text.empty()) return otherwise;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw Bad_argument(fmt::format("--frames {}: expected FIRST:LAST:STEP", choice));
  return value;
}

std::vector<std::string> split(const std::string& choice) {
  std::vector<std::string> parts(1);
  for (const char c : choice) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

Frame_choice parse_frames(const std::string& choice, std::size_t frames) {
  const auto parts = split(choice);
  if (parts.size() > 3) throw Bad_argument(fmt::format("--frames {}: expected FIRST:LAST:STEP", choice));
  const auto last = frames - 1;
  Frame_choice result{.first = number(parts[0], 0, choice)};
  result.last = parts.size() > 1 ? number(parts[1], last, choice) : choice.empty() ? last : result.first;
  if (parts.size() > 2) result.step = number(parts[2], 1, choice);
  if (result.step == 0 || result.first > result.last || result.last > last)
    throw Bad_argument(fmt::format("--frames {}: the frames are 0 to {}", choice, last));
  return result;
}

std::vector<std::size_t> list_of(const Frame_choice& choice) {
  std::vector<std::size_t> frames;
  for (auto frame = choice.first; frame <= choice.last; frame += choice.step) {
    frames.push_back(frame);
    if (choice.last - frame < choice.step) break;  // the sum might overflow
  }
  return frames;
}

/// The region of each file vertex, for the positions of one frame; region 0 for vertices that no face uses.
std::vector<Region_index> regions_of(const Animation& animation, std::size_t frame, std::size_t count) {
  std::vector<Point> points(animation.vertices);
  animation.motion.pose(frame, points);
  auto file = mesh_of(points, animation.faces, animation.kind);
  const auto map = file.mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
  partition(file.mesh, count, map, make_strategy("lbg", {}), {});
  std::vector<Region_index> regions(animation.vertices);
  for (const auto v : file.mesh.vertices()) regions[file.file_vertex[v]] = map[v];
  return regions;
}

}  // namespace

int run(const Convert_command& command) {
  const auto animation = read_animation(
      command.input, {.mesh = command.mesh, .frames_per_second = command.rate > 0 ? command.rate : usual_rate});
  const auto choice = parse_frames(command.frames, animation.motion.frames);
  Animation_output_options options{.frames = list_of(choice)};
  const double own_rate = animation.frames_per_second > 0 ? animation.frames_per_second : usual_rate;
  options.frames_per_second = (command.rate > 0 ? command.rate : own_rate) / static_cast<double>(choice.step);
  if (command.regions > 0) {
    if (animation.faces.empty()) throw Bad_argument("--regions needs faces: give the mesh of the point cache");
    options.regions = regions_of(animation, choice.first, command.regions);
  }
  {
    Progress_bar progress("convert", command.quiet);
    options.progress = [&](std::size_t done, std::size_t of) { progress(done, of); };
    write_animation(command.output, animation, options);
  }
  if (!command.quiet)
    fmt::print("{}: {} frames of {} vertices\n", printable(command.output.string()), options.frames.size(),
               animation.vertices);
  return exit_code::success;
}

}  // namespace lodestone
