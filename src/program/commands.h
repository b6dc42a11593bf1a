// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program, independent of the syntax of their options.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/detector.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/partition/strategies.h"
#include "program/shards.h"

namespace lodestone {

/// How surfaces are divided.
struct Strategy_choice {
  std::string name = "lbg";
  Strategy_settings settings = {};
};

struct Detect_command {
  /// One scene (.json), or meshes, animations, `SCENE.json#OBJECT` and `shape:SHAPE`.
  std::vector<std::filesystem::path> inputs;
  bool parts = false;       ///< the parts that a file names are objects of their own
  bool components = false;  ///< so are connected components
  Detector_options options = {.contacts = Contact_query::first};
  Strategy_choice partition = {};
  bool chooses_strategy = false;   ///< the user chose the partition, or a setting of it
  bool chooses_particles = false;  ///< the user gave a number of particles, which counts for every object
  bool truth = false;
  bool closest = false;                       ///< also find the closest faces of each object pair
  bool impacts = false;                       ///< also find when object pairs meet first between two frames
  std::filesystem::path out, html, paraview;  ///< empty: not written
  std::size_t html_frames = 0;                ///< maximum number of frames on the page; 0: see page_frame_step
  bool quiet = false;                         ///< print one line in place of the table
  bool json = false;                          ///< print the summary in place of the table
  bool all_rows = false;                      ///< print a row for each pair, however many
  bool exit_code = false;                     ///< the exit code tells whether anything collides
  Scene_options reading = {};                 ///< limits of the inputs; where a scene may name files

  /// Frames do not depend on earlier ones: loose trees are kept, and statistics that depend are not written.
  bool independent_frames = false;
  std::optional<Shard> shard;           ///< play only the frames of this shard
  std::optional<std::size_t> warm_up;   ///< modes with particles: frames that a shard plays before its own
  bool merge_shards = false;            ///< take the frames from the shards in `out` in place of playing them
  std::vector<std::string> words = {};  ///< of the command line, see words_of_work
};

struct Partition_command {
  std::filesystem::path mesh;  ///< or `SCENE.json#OBJECT`, or `shape:SHAPE`
  Scene_options reading = {};  ///< limits of the input; where a scene may name files
  Strategy_choice strategy = {};
  std::size_t regions = 12;
  Partition_options options = {};
  std::filesystem::path out, json, html;  ///< empty: not written
  bool quiet = false;
};

struct Info_command {
  std::filesystem::path file;  ///< or `SCENE.json#OBJECT`, or `shape:SHAPE`
  std::filesystem::path mesh;  ///< of a point cache; may be empty
  bool json = false;
  Scene_options reading = {};  ///< limits of the input; where a scene may name files
};

struct Convert_command {
  std::filesystem::path input;  ///< a file, `SCENE.json#OBJECT` or `shape:SHAPE`
  std::filesystem::path output;
  std::filesystem::path mesh;  ///< of a point cache; may be empty
  std::string frames;          ///< first:last:step; empty: all
  double rate = 0;             ///< frames per second; 0: what the input says, else 30
  std::size_t regions = 0;     ///< 0: no colours
  std::optional<double> weld;  ///< distance below which vertices are merged
  std::size_t subdivisions = 0;
  double scale = 1;
  Scene_options reading = {};  ///< limits of the input; where a scene may name files
  bool quiet = false;
};

struct Status_command {
  std::filesystem::path folder;
  bool json = false;
  bool quick = false;  ///< do not read all of each shard
};

struct Submit_command {
  std::filesystem::path out;
  std::vector<std::string> words;  ///< the command to shard: `detect ...` or `experiment ...`
  std::size_t shards = 16;
  std::size_t tasks = 1000;        ///< at most, in one array; each makes several shards if there are more
  std::string partition, account;  ///< of the cluster; empty: its default
  double time_factor = 3, memory_factor = 2;
  std::size_t minutes = 0, megabytes = 0;  ///< of a shard; 0: measured by a pilot
  bool slurm = false;                      ///< the only kind of cluster so far
  bool dry_run = false;
};

/// Whether the input is a scene file.
inline bool is_scene_file(const std::vector<std::filesystem::path>& inputs) {
  return inputs.size() == 1 && lower_case(inputs.front().extension().string()) == ".json";
}
/// What a message about one object alone adds: options that would divide it, unless it has been divided.
inline const char* hint_at_components(const Detect_command& command) {
  if (command.components) return "";
  return command.parts ? ", or --components for those between its connected components"
                       : ", or --components or --parts for those between parts of it";
}

/// Runs a command: prints its table to the standard output and returns the program's exit code.
int run(const Detect_command& command);
int run(const Partition_command& command);
int run(const Info_command& command);
int run(const Convert_command& command);
int run(const Status_command& command);
int run(const Submit_command& command);

/// Replaces this process by the program of the experiments, see experiments_program. Returns only by an exception.
/// @throws Bad_argument  that program has not been built
[[noreturn]] void run_experiments(std::vector<char*> arguments);

}  // namespace lodestone
