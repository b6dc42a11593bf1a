// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/slurm_scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "program/shards.h"

namespace lodestone {

namespace {

/// The name of a log as sbatch reads it: within quotes, where % begins a pattern.
/// @param log  may be a pattern
std::string sbatch_log(const std::filesystem::path& out, const std::string& log) {
  const auto path = out / "slurm";
  std::string name;
  for (const char c : path.string()) {
    if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20)
      throw Bad_argument("--out " + printable(out.string()) + ": sbatch cannot write into a folder of such a name");
    name += c == '%' ? "%%" : std::string(1, c);
  }
  return fmt::format("\"{}/{}\"", name, log);
}

struct Limits {
  std::size_t minutes, megabytes, cores;
};

std::string head(const Slurm_job& job, const std::string& name, const Limits& limits) {
  std::string text = fmt::format("#SBATCH --job-name={}\n", name);
  if (!job.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", job.partition);
  if (!job.account.empty()) text += fmt::format("#SBATCH --account={}\n", job.account);
  return text + fmt::format(
                    "#SBATCH --nodes=1 --ntasks=1 --cpus-per-task={}\n# Minutes:\n#SBATCH --time={}\n"
                    "#SBATCH --mem={}M\n#SBATCH --requeue\n#SBATCH --open-mode=append\n",
                    limits.cores, limits.minutes, limits.megabytes);
}

}  // namespace

std::string shell_word(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_-./,:=+@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) {
    if (!text.empty()) text += ' ';
    text += shell_word(word);
  }
  return text;
}

std::string_view quietly(const std::vector<std::string>& words) {
  const auto excludes = [](const std::string& word) { return word == "--json" || word == "--all-rows"; };
  return std::ranges::none_of(words, excludes) ? " --quiet" : "";
}

std::string array_script(const Slurm_job& job) {
  const std::string command = fmt::format("{} {} --out {}{} --shard", shell_word(job.program), shell_words(job.words),
                                          shell_word(job.out.string()), quietly(job.words));
  std::string text =
      "#!/bin/bash\n"
      "# Written by lodestone submit: makes the shards that were missing. A shard appears whole or not at all, and "
      "one\n"
      "# that is done is skipped, so this may be submitted, cancelled and requeued at any time.\n";
  text += head(job, "lodestone", {job.minutes, job.megabytes, job.cores});
  text += fmt::format("#SBATCH --array={}\n", ranges_of(job.to_do, ","));
  text += fmt::format("#SBATCH --output={}\n", sbatch_log(job.out, "task-%a.log"));
  text += fmt::format("set -euo pipefail\ncd {}\n", shell_word(job.folder.string()));
  if (job.tasks >= job.shards)
    return text + fmt::format("exec {} \"${{SLURM_ARRAY_TASK_ID}}/{}\"\n", command, job.shards);
  return text + fmt::format(
                    "# A shard that fails does not keep the others from being made; a signal ends them all.\n"
                    "failed=0\n"
                    "for ((shard = SLURM_ARRAY_TASK_ID; shard <= {}; shard += {})); do\n"
                    "  {} \"$shard/{}\" || {{ failed=$?; ((failed < 128)) || exit \"$failed\"; }}\ndone\n"
                    "exit \"$failed\"\n",
                    job.shards, job.tasks, command, job.shards);
}

std::string merge_script(const Slurm_job& job) {
  std::string text =
      "#!/bin/bash\n"
      "# Written by lodestone submit: joins the shards once the array has ended, however it ended. If shards are\n"
      "# missing, it says which, changes nothing and fails.\n";
  text += head(job, "lodestone-merge", {job.merge_minutes, job.merge_megabytes, 1});
  text += fmt::format("#SBATCH --output={}\n", sbatch_log(job.out, "merge.log"));
  const auto program = shell_word(job.program), out = shell_word(job.out.string());
  return text + fmt::format("set -euo pipefail\ncd {}\n{} status --quick {}\nexec {} merge --quiet {}\n",
                            shell_word(job.folder.string()), program, out, program, out);
}

}  // namespace lodestone
