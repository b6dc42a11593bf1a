// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "commands.h"
#include "exit_codes.h"
#include "experiment.h"
#include "lodestone/io/atomic_file.h"
#include "printable.h"
#include "progress.h"

namespace lodestone {

int run(const Experiment_command& command) {
  const auto experiment = std::ranges::find_if(experiments(), [&](const auto& e) { return e.name == command.name; });
  const std::filesystem::path out = command.out.empty() ? std::filesystem::path("out") / command.name : command.out;
  std::string report;
  {
    Progress_bar bar(command.name, command.quiet);
    report = experiment->run({.scenes = command.scenes, .out = out, .progress = std::ref(bar), .only = command.only});
  }
  Atomic_file file(out / (command.name + ".md"));
  file.write(report);
  file.commit();
  if (!command.quiet)
    fmt::print("{}\n{}\n\n{}", experiment->question, std::string(experiment->question.size(), '='), report);
  if (!command.quiet) fmt::print("\nreport and figures: {}\n", printable(out.string()));
  return exit_code::success;
}

}  // namespace lodestone
