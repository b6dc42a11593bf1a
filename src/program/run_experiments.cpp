// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "lodestone/mesh/errors.h"
#include "program/commands.h"

namespace lodestone {

void run_experiments(std::vector<char*> arguments) {
  // The experiments are a separate program, since they take longer to compile than everything else.
  const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("lodestone-experiments");
  std::string name = program.string();
  arguments.insert(arguments.begin(), name.data());
  arguments.push_back(nullptr);
  execv(name.c_str(), arguments.data());
  if (errno == ENOENT)
    throw Bad_argument(fmt::format(
        "the experiments are not built: {} is missing; 'scripts/build release lodestone_experiments' makes it", name));
  throw Error(fmt::format("{} cannot be started: {}", name, std::generic_category().message(errno)));
}

}  // namespace lodestone
