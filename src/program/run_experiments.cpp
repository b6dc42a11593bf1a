// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "lodestone/mesh/errors.h"
#include "program/commands.h"
#include "program/installed_files.h"

namespace lodestone {

void run_experiments(std::vector<char*> arguments) {
  // The experiments are a separate program, since they take longer to compile than everything else.
  std::string name = experiments_program().string();
  arguments.insert(arguments.begin(), name.data());
  arguments.push_back(nullptr);
  execv(name.c_str(), arguments.data());
  if (errno == ENOENT)
    throw Bad_argument(fmt::format(
        "the experiments are missing: there is no {}; 'scripts/build release lodestone_experiments' builds them in the "
        "source, and the package lodestone-experiments contains them",
        name));
  throw Error(fmt::format("{} cannot be started: {}", name, std::generic_category().message(errno)));
}

}  // namespace lodestone
