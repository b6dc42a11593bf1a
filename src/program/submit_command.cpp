// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/io/files/atomic_file.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/plain_words.h"
#include "program/progress.h"
#include "program/shards.h"
#include "program/slurm_scripts.h"
#include "program/source_revision.h"

namespace lodestone {

namespace {

bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

/// How a program that was run has ended.
struct Ended_program {
  std::string output;  ///< what it wrote to its standard output
  int status = 0;      ///< as of `waitpid`
};

/// One end of a pipe, closed at the end of its life at the latest.
class Pipe_end {
 public:
  explicit Pipe_end(int descriptor) : descriptor_(descriptor) {}
  ~Pipe_end() { close(); }
  Pipe_end(const Pipe_end&) = delete;
  Pipe_end& operator=(const Pipe_end&) = delete;

  int descriptor() const { return descriptor_; }
  void close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  }

 private:
  int descriptor_;
};

/// All that comes out of a pipe.
/// @throws Interrupted  the user has asked to stop
std::string read_to_end(int pipe) {
  constexpr int milliseconds = 100;  // the system starts `read` again after a signal, so an interrupt would not end it
  std::string text;
  std::array<char, 4096> bytes{};
  for (;;) {
    check_interrupt();
    pollfd output{.fd = pipe, .events = POLLIN, .revents = 0};
    if (::poll(&output, 1, milliseconds) <= 0) continue;
    const auto count = ::read(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

int status_at_end_of(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Starts a program whose output goes into a pipe.
/// @param output  where the pipe is written
pid_t start(std::vector<std::string> words, int output, bool handles_signals) {
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  // Who is not in the terminal's foreground group is stopped where it reads from it.
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  if (handles_signals) ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = 0;
  const int cause = ::posix_spawnp(&process, pointers[0], &actions, &attributes, pointers.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (cause != 0) throw Error(words[0] + " cannot be started: " + std::generic_category().message(cause));
  return process;
}

/// Runs a program, found on the PATH, and waits for it. It finds its standard input empty.
/// @param handles_signals  it ends in order when it gets one, and at once when it gets two. So it is kept from those of
///                         the terminal and gets the one that is passed on. If this program is killed, it runs on
/// @throws Error        it cannot be started
/// @throws Interrupted  the user has asked to stop; it has then ended, too
Ended_program run_to_end(const std::vector<std::string>& words, bool handles_signals = false) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe can be made");
  Pipe_end reading(ends[0]), writing(ends[1]);
  const pid_t process = start(words, writing.descriptor(), handles_signals);
  writing.close();
  try {
    auto output = read_to_end(reading.descriptor());
    reading.close();
    return {.output = std::move(output), .status = status_at_end_of(process)};
  } catch (const Interrupted&) {
    ::kill(process, SIGTERM);
    reading.close();  // it must not wait for someone to read
    status_at_end_of(process);
    throw;
  }
}

/// @throws Error  always: it has said why it failed
[[noreturn]] void throw_failure(const std::string& program, int status) {
  throw Error(fmt::format("{} failed, with {} {}", program, WIFEXITED(status) ? "exit code" : "signal",
                          WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)));
}

/// The number that an option of the command has, such as --threads; 1 if it is not there.
/// @throws Bad_argument  it is 0
std::size_t number_of(const std::vector<std::string>& words, const std::string& option) {
  std::size_t number = 1;
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string text;
    if (words[i].starts_with(option + "=")) text = words[i].substr(option.size() + 1);
    if (words[i] == option && i + 1 < words.size()) text = words[i + 1];
    if (!text.empty()) std::from_chars(text.data(), text.data() + text.size(), number);
  }
  if (number == 0) throw Bad_argument(option + " 0 takes a whole node: give the number of cores");
  return number;
}

void check(const Submit_command& command) {
  if (command.words.front() != "detect" && command.words.front() != "experiment")
    throw Bad_argument("only detect and experiment can run in shards, found '" + command.words.front() + "'");
  for (const auto& word : command.words)
    for (const std::string option : {"--out", "--shard"})
      if (word == option || word.starts_with(option + "="))
        throw Bad_argument(fmt::format("{} belongs to submit: give it before --", option));
  for (const char* option : {"--threads", "--jobs"}) number_of(command.words, option);  // before the pilot
  if (!command.dry_run && !is_on_path("sbatch"))
    throw Bad_argument(
        "sbatch is not on the PATH: submit on a node of a Slurm cluster, or write the scripts with "
        "--dry-run");
}

/// What the shards that are done have needed at most.
struct Needs {
  double seconds = 0, kib = 0, bytes = 0;
};

struct Shards_to_do {
  std::size_t of = 0;  ///< so many shards in all
  std::vector<std::size_t> shards;
  Needs needs;

  bool are_all() const { return shards.size() == of; }
};

Shards_to_do look_at(const Shard_folder& folder) {
  Shards_to_do result{.of = folder.shards(), .shards = {}, .needs = {}};
  for (std::size_t index = 1; index <= result.of; ++index) {
    const auto status = folder.status(index, Shard_check::all);
    if (status.state != Shard_state::done) {
      result.shards.push_back(index);
      continue;
    }
    auto& needs = result.needs;
    needs.seconds = std::max(needs.seconds, status.record["seconds"].get<double>());
    needs.kib = std::max(needs.kib, status.record["peak_kib"].get<double>());
    needs.bytes = std::max(needs.bytes, status.record["bytes"].get<double>());
  }
  return result;
}

/// @throws Bad_argument  the shards of the folder are of other work, or were made by another revision
void check_same_work(const Shard_folder& folder, const Submit_command& command) {
  const auto shards = command.out / "shards";
  if (folder.command() != words_of_work(command.words))
    throw Bad_argument(fmt::format("{}: these are shards of other work: lodestone {}", shards.string(),
                                   shell_words(folder.command())));
  if (folder.manifest()["revision"] != source_revision())
    throw Bad_argument(fmt::format("{}: these shards were made by revision {}, which must make the others too",
                                   shards.string(), folder.manifest()["revision"].dump()));
}

/// Those that the folder lacks; if it has no shards so far, as many as the command says.
Shards_to_do shards_to_make(const Submit_command& command) {
  if (exists(command.out / "shards" / "manifest.json")) {
    const Shard_folder folder(command.out);
    check_same_work(folder, command);
    return look_at(folder);
  }
  Shards_to_do result{.of = command.shards, .shards = std::vector<std::size_t>(command.shards), .needs = {}};
  std::iota(result.shards.begin(), result.shards.end(), 1);
  return result;
}

/// Where the tasks run: in the folder in which the shards of a folder were begun, since inputs may be relative to it.
std::filesystem::path folder_of(const Submit_command& command) {
  if (!exists(command.out / "shards" / "manifest.json")) return std::filesystem::current_path();
  const std::filesystem::path begun = Shard_folder(command.out).manifest()["folder"].get<std::string>();
  return is_directory(begun) ? begun : std::filesystem::current_path();
}

/// Makes one shard, which counts.
/// @return its exit code; if it is not success, it has been said why
int make_pilot(const Submit_command& command, std::size_t index, std::size_t shards) {
  std::vector<std::string> words{this_program()};
  words.insert(words.end(), command.words.begin(), command.words.end());
  const auto shard = fmt::format("{}/{}", index, shards);
  words.insert(words.end(), {"--out", absolute(command.out).string(), "--shard", shard});
  if (!quietly(command.words).empty()) words.emplace_back("--quiet");
  fmt::print("pilot: shard {}\n", shard);
  std::fflush(stdout);
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder_of(command));
  const int status = run_to_end(words, true).status;
  std::filesystem::current_path(here);
  constexpr std::array told{exit_code::success,    exit_code::bad_usage,         exit_code::bad_input,
                            exit_code::bad_output, exit_code::contradicts_truth, exit_code::interrupted};
  if (!WIFEXITED(status) || std::ranges::find(told, WEXITSTATUS(status)) == told.end()) throw_failure(words[0], status);
  const int code = WEXITSTATUS(status);
  if (code != exit_code::success)
    std::fputs(fmt::format("lodestone: the pilot failed, with exit code {}: nothing was submitted\n", code).c_str(),
               stderr);
  return code;
}

/// Makes a shard from the middle. With more shards than pieces it may be empty, and tell nothing: then the first and
/// the last, one of which is not.
/// @return as `make_pilot`
int run_pilot(const Submit_command& command, std::size_t shards) {
  std::set<std::size_t> made;
  for (const std::size_t index : {(shards + 1) / 2, std::size_t{1}, shards}) {
    if (!made.insert(index).second) continue;
    if (const int code = make_pilot(command, index, shards); code != exit_code::success) return code;
    const auto pilot = Shard_folder(command.out).status(index, Shard_check::record);
    if (pilot.state == Shard_state::done && pilot.record["lines"] > 0) break;
  }
  return exit_code::success;
}

std::size_t rounded_up(double value, std::size_t least) {
  return std::max(least, static_cast<std::size_t>(std::ceil(value)));
}

Slurm_job job_of(const Submit_command& command, const Shards_to_do& to_do) {
  Slurm_job job{.program = this_program(),
                .folder = folder_of(command),
                .out = absolute(command.out),
                .words = command.words,
                .shards = to_do.of,
                .tasks = std::min(command.tasks, to_do.of),
                .to_do = {},
                .cores = std::max(number_of(command.words, "--threads"), number_of(command.words, "--jobs")),
                .partition = command.partition,
                .account = command.account};
  for (const auto shard : to_do.shards) job.to_do.push_back((shard - 1) % job.tasks + 1);
  std::ranges::sort(job.to_do);
  job.to_do.erase(std::unique(job.to_do.begin(), job.to_do.end()), job.to_do.end());

  const auto& needs = to_do.needs;
  const auto jobs = static_cast<double>(number_of(command.words, "--jobs"));
  const auto shards_per_task = static_cast<double>((job.shards + job.tasks - 1) / job.tasks);
  job.minutes = command.minutes > 0 ? command.minutes : rounded_up(command.time_factor * needs.seconds / 60, 1);
  job.minutes = rounded_up(static_cast<double>(job.minutes) * shards_per_task, 1);
  job.megabytes =
      command.megabytes > 0 ? command.megabytes : rounded_up(command.memory_factor * jobs * needs.kib / 1024, 100);
  // A merge of an experiment holds all rows and reports about them; that of detect copies frames: see docs/scale.md.
  const bool keeps_rows = command.words.front() == "experiment";
  const double least_bytes_per_second = keeps_rows ? 1e6 : 1e7, memory_per_byte = keeps_rows ? 12 : 0;
  const double bytes = needs.bytes * static_cast<double>(job.shards);
  job.merge_minutes = rounded_up(command.time_factor * bytes / least_bytes_per_second / 60, 10);
  job.merge_megabytes = job.megabytes + rounded_up(memory_per_byte * bytes / 1e6, 100);
  return job;
}

struct Scripts {
  std::filesystem::path array, merge;
};

Scripts write_scripts(const Slurm_job& job) {
  const auto folder = job.out / "slurm";
  Scripts scripts{.array = folder / "array.sh", .merge = folder / "merge.sh"};
  write_whole(scripts.array, array_script(job));
  write_whole(scripts.merge, merge_script(job));
  return scripts;
}

/// @return the number of the job
std::string submitted(const std::vector<std::string>& words) {
  auto [answer, status] = run_to_end(words);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw_failure(words[0], status);
  answer = answer.substr(0, answer.find_first_of(";\n"));  // --parsable: JOB[;CLUSTER]
  if (answer.empty()) throw Error("sbatch has not said which job it has made");
  return answer;
}

void submit(const Scripts& scripts, const Submit_command& command, std::size_t shards) {
  check_interrupt();
  const auto job = submitted({"sbatch", "--parsable", scripts.array.string()});
  std::string merging;
  try {
    merging = submitted({"sbatch", "--parsable", "--dependency=afterany:" + job, scripts.merge.string()});
  } catch (...) {
    // The shards run all the same, and what has failed is perhaps only the answer.
    fmt::print("job {}: {}, perhaps without its merge; then: sbatch --dependency=afterany:{} {}\n", job,
               counted(shards, "shard"), job, printable(shell_word(scripts.merge.string())));
    throw;
  }
  fmt::print("job {}: {}; job {}: merge\nwatch: squeue --jobs {},{}; lodestone status {}\n", job,
             counted(shards, "shard"), merging, job, merging, printable(shell_word(command.out.string())));
}

}  // namespace

int run(const Submit_command& given) {
  Submit_command command = given;
  command.words = plain_words(given.words);  // options will be appended
  check(command);
  Shards_to_do to_do = shards_to_make(command);
  const bool measured = command.minutes > 0 && command.megabytes > 0;
  if (to_do.are_all() && !measured) {
    if (const int code = run_pilot(command, to_do.of); code != exit_code::success) return code;
    to_do = look_at(Shard_folder(command.out));
  }
  if (to_do.shards.empty()) {
    fmt::print("all shards are done; next: lodestone merge {}\n", printable(shell_word(command.out.string())));
    return exit_code::success;
  }
  check_interrupt();
  const auto job = job_of(command, to_do);
  const auto scripts = write_scripts(job);
  fmt::print("{}: {} and {} MB per task; scripts: {} and {}\n", counted(to_do.shards.size(), "shard"),
             counted(job.minutes, "minute"), job.megabytes, printable(scripts.array.string()),
             printable(scripts.merge.string()));
  if (command.dry_run)
    fmt::print("nothing was submitted: sbatch array.sh, then sbatch --dependency=afterany:JOB merge.sh\n");
  else
    submit(scripts, command, to_do.shards.size());
  return exit_code::success;
}

}  // namespace lodestone
