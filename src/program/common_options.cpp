// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/common_options.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "program/command_line.h"

namespace lodestone {

namespace {

/// Limits the weight so that squared weighted vectors cannot overflow.
constexpr double largest_normal_weight = 1e6;

/// A number of bytes, also with a unit: 200MB are 200 * 2^20.
CLI::Validator size_in_bytes() {
  return {[](std::string& text) -> std::string {
            const std::string fault = fmt::format("expected a size of 1 byte or more, such as 200MB, found '{}'", text);
            const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
            const std::string unit = lower_case(text.substr(digits));
            const std::vector<std::string> units{"b", "kb", "mb", "gb", "tb"};
            const auto found = std::ranges::find(units, unit.empty() ? "b" : unit);
            constexpr std::size_t most_digits = 15;
            if (digits == 0 || digits > most_digits || found == units.end()) return fault;
            const std::uintmax_t number = std::stoull(text.substr(0, digits));
            const auto shift = 10 * (found - units.begin());
            constexpr auto largest = std::numeric_limits<std::uintmax_t>::max();
            if (number == 0 || number > largest >> shift) return fault;
            text = std::to_string(number << shift);
            return {};
          },
          ""};
}

void add_limit(CLI::App& app, const char* name, std::size_t& limit, const char* what) {
  app.add_option(name, limit, what)
      ->check(CLI::Range(std::size_t{1}, limit))
      ->type_name("N")
      ->capture_default_str()
      ->group("Limits of the input");
}

void add_limits(CLI::App& app, Scene_options& reading) {
  add_limit(app, "--max-faces", reading.limits.max_faces,
            "Refuse files with more faces, before memory is taken for them");
  add_limit(app, "--max-scene-faces", reading.max_scene_faces, "Refuse scenes with more faces together");
  add_limit(app, "--max-objects", reading.max_objects, "Refuse scenes of more objects");
  add_limit(app, "--max-frames", reading.limits.max_frames, "Refuse scenes and animations of more frames");
  app.add_option("--max-bytes", reading.limits.max_bytes,
                 "Refuse longer mesh files, and buffers of a glTF file that are longer together; units such as 200MB")
      ->transform(size_in_bytes())
      ->type_name("SIZE")
      ->default_str("16GB")
      ->group("Limits of the input");
}

}  // namespace

std::string strategy_list() {
  std::string list = "Strategies:";
  for (const auto& strategy : strategies()) list += fmt::format("\n  {:<16} {}", strategy.name, strategy.summary);
  return list;
}

void add_strategy_options(CLI::App& app, Strategy_choice& choice, const char* seed_of) {
  std::vector<std::string> names;
  for (const auto& strategy : strategies()) names.emplace_back(strategy.name);
  app.add_option("--strategy", choice.name, "Partition strategy, see below")
      ->type_name("NAME")
      ->check(one_word_of(names))
      ->capture_default_str();
  app.add_option("--seed", choice.settings.seed, seed_of)
      ->check(CLI::Range(std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max()).description("0 or more"))
      ->capture_default_str();
  auto& options = choice.settings.lbg;
  app.add_option("--normal-weight", options.features.normal_weight,
                 "Weight of normals relative to positions; 0: positions only")
      ->check(finite_number(0, largest_normal_weight, "0 to 1e6"))
      ->capture_default_str();
  app.add_option("--split", options.split_rule, "How a code vector is split: principal_axis, multiplicative")
      ->transform(one_of<Split>({{"principal_axis", Split::principal_axis}, {"multiplicative", Split::multiplicative}}))
      ->type_name("RULE")
      ->default_str("principal_axis");
  app.add_option("--epsilon", options.split, "e of the split (1 + e)C, (1 - e)C")
      ->check(number_above_0(false))
      ->capture_default_str();
  app.add_option("--lbg-tolerance", options.tolerance, "LBG: relative drop of the distortion at which iterations stop")
      ->check(number_above_0(true))
      ->capture_default_str();
  app.add_option("--lbg-sample", options.sample,
                 "LBG: maximum number of vertices to train on, but at least 128 per region; 0: all")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000'000}))
      ->capture_default_str();
}

void add_keep_islands(CLI::App& app, Partition_options& options) {
  app.add_flag("--keep-islands", options.keep_islands, "Do not repair regions that consist of several islands");
}

void add_format(CLI::App& app, std::string& format) {
  app.add_option("--format", format, "Format of the mesh on the standard input (-): off, obj, ply, stl, glb, md2, md3")
      ->check(one_word_of({"off", "obj", "ply", "stl", "glb", "md2", "md3"}))
      ->type_name("NAME");
}

void add_reading(CLI::App& app, Scene_options& reading) {
  app.add_flag("--allow-outside", reading.allow_outside, "A scene may name files outside its folder");
  add_limits(app, reading);
}

void add_threads(CLI::App& app, std::size_t& threads, const char* of) {
  app.add_option("--threads", threads, of)->check(CLI::Range(std::size_t{0}, std::size_t{1024}))->capture_default_str();
}

void refuse_allow_outside(const CLI::App& app, const std::vector<std::filesystem::path>& inputs) {
  const auto is_of_a_scene = [](const std::filesystem::path& input) {
    const auto name = lower_case(input.string());
    return name.ends_with(".json") || name.find(".json#") != std::string::npos;
  };
  if (app.count("--allow-outside") > 0 && std::ranges::none_of(inputs, is_of_a_scene))
    throw Bad_argument("--allow-outside is for scenes: no input is one");
}

}  // namespace lodestone
