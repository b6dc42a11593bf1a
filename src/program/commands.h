// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program, apart from how their options are written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/partition/lbg.h"

namespace lodestone {

struct Detect_command {
  std::vector<std::filesystem::path> inputs;  ///< one scene (.json), or two or more meshes that stand still
  Detector_options options = {.contacts = Contact_query::first};
  Lbg_options partition = {};
  bool truth = false;
  std::filesystem::path out;  ///< empty: nothing is written
  bool quiet = false;
};

struct Partition_command {
  std::filesystem::path mesh;
  std::string strategy = "lbg";
  std::size_t regions = 12;
  Lbg_options lbg = {};
  Partition_options options = {};
  std::filesystem::path out, json;  ///< empty: not written
  bool quiet = false;
};

struct Experiment_command {
  std::string name;
  std::filesystem::path scenes, out;
  std::vector<std::string> only;  ///< names of scenes; empty: all of the experiment
  bool quiet = false;
};

/// Each prints its table to the standard output and returns the program's exit code.
int run(const Detect_command& command);
int run(const Partition_command& command);
int run(const Experiment_command& command);

}  // namespace lodestone
