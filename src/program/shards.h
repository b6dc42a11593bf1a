// SPDX-License-Identifier: GPL-3.0-or-later
// Long work in parts that know nothing of each other: see docs/decisions/0034-shards.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

/// A shard that cannot be merged: missing, cut off, changed, or of other work.
class Bad_shard : public Error {
 public:
  using Error::Error;
};

/// A part of long work, whose pieces (frames, runs) are counted from 0.
struct Shard {
  std::size_t index = 1;  ///< 1 to `count`
  std::size_t count = 1;

  /// Pieces that follow each other. All shards together have each piece once, in order.
  std::vector<std::size_t> neighbours(std::size_t pieces) const;
  /// Pieces from everywhere, in order: shards then take about the same time, and one is a sample of all.
  std::vector<std::size_t> scattered(std::size_t pieces) const;
};

/// Reads `I/N`.
/// @throws Bad_argument  not so, or not 1 <= I <= N <= 100 000
Shard parse_shard(const std::string& text);

/// The words of a command line, without the name of the program and without those options that change no result:
/// --out, --shard, --quiet, --jobs, --threads.
std::vector<std::string> words_of_work(const std::vector<std::string>& words);

/// What shards of the same work have in common.
struct Work {
  std::vector<std::string> command;  ///< as words_of_work
  std::size_t shards = 1, pieces = 0;
  nlohmann::ordered_json inputs;  ///< what tells other inputs apart, such as hashes
};

enum class Shard_state { done, missing, broken };

struct Shard_status {
  Shard_state state = Shard_state::missing;
  std::string cause;              ///< why it is broken
  nlohmann::ordered_json record;  ///< of a done shard: see Shard_writer
};

/// How much of a finished shard is looked at.
enum class Shard_check { record, all };

/// Shards are merged by any revision, but made by one.
enum class Shard_use { make, merge };

/// The shards of a folder of results: `FOLDER/shards/manifest.json`, and one file per finished shard.
class Shard_folder {
 public:
  /// Opens a folder that has shards.
  /// @throws Bad_shard     it has none, or something else in their place
  explicit Shard_folder(std::filesystem::path results);
  /// Opens a folder for this work, and writes its manifest if it has none.
  /// @throws Bad_argument  the folder has shards of another command, revision, number of shards or input
  /// @throws Bad_output    the manifest cannot be written
  Shard_folder(std::filesystem::path results, const Work& work, Shard_use use);

  const std::filesystem::path& results() const { return results_; }
  const nlohmann::ordered_json& manifest() const { return manifest_; }
  std::size_t shards() const { return manifest_["shards"]; }
  /// Hash of what the shards have in common: of the manifest but for the folder.
  const std::string& work() const { return work_; }
  std::vector<std::string> command() const { return manifest_["command"]; }
  Shard shard(std::size_t index) const { return {.index = index, .count = shards()}; }
  /// The file of a finished shard, counted from 1.
  std::filesystem::path file(std::size_t index) const;
  /// The file in which a shard may keep finished pieces until it is done.
  std::filesystem::path journal(std::size_t index) const;

  Shard_status status(std::size_t index, Shard_check check) const;
  /// Whether the shard is done, all of it looked at: it need not be made again.
  bool is_done(std::size_t index) const { return status(index, Shard_check::all).state == Shard_state::done; }
  /// Visits the lines of a finished shard, without line breaks, and checks them.
  /// @return its record
  /// @throws Bad_shard  what is wrong; perhaps after the last line has been visited
  nlohmann::ordered_json read(std::size_t index, const std::function<void(std::string_view line)>& visit) const;
  /// Visits the lines of all shards in order.
  /// @return their records
  /// @throws Bad_shard  names all shards that are missing, before the first visit; else as `read`
  std::vector<nlohmann::ordered_json> read_all(const std::function<void(std::string_view line)>& visit) const;
  /// Notes that these files of the folder are the results of all its shards, and removes what killed processes left
  /// behind.
  void note_merged(const std::vector<std::string>& files) const;
  /// Notes that results which are not those of shards are about to be written to a folder, whether it has shards or
  /// not.
  static void note_replaced(const std::filesystem::path& results);
  /// Whether the results are those of the shards, and all there.
  bool is_merged() const;

 private:
  friend class Shard_writer;
  std::filesystem::path folder() const { return results_ / "shards"; }
  void read_manifest();
  nlohmann::ordered_json read_record(std::size_t index) const;

  std::filesystem::path results_;
  nlohmann::ordered_json manifest_;
  std::string work_;  ///< see `work`
};

/// A shard that is being written. It appears whole with `commit`, or not at all.
class Shard_writer {
 public:
  /// @param folder  must outlive this
  /// @throws Bad_output
  Shard_writer(const Shard_folder& folder, std::size_t index);
  /// @param line  without a line break
  void add(std::string_view line);
  /// Ends the file with a record of the shard: its number, lines, bytes and hash, the seconds since the program
  /// started, its greatest memory in KiB, when it was finished, `more`, and a hash of all this.
  /// @throws Bad_output
  /// @throws Bad_shard  the folder has become one of other work
  void commit(const nlohmann::ordered_json& more = nlohmann::ordered_json::object());

 private:
  const Shard_folder& folder_;
  std::size_t index_, count_, lines_ = 0, bytes_ = 0;
  std::string work_;
  std::uint64_t hash_ = 0;
  Atomic_file file_;
};

/// A line that was added to a shard. What is nested deeper than 64 levels is left out: to copy it would exhaust the
/// stack.
/// @throws nlohmann::json::exception  it is no JSON
nlohmann::ordered_json parse_shard_line(std::string_view line);

/// `1-4, 9`: numbers in ascending order.
std::string ranges_of(const std::vector<std::size_t>& numbers, std::string_view separator = ", ");

}  // namespace lodestone
