// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/shards.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <fstream>
#include <span>
#include <string>
#include <tuple>

#include "io/files/small_text.h"
#include "lodestone/mesh/saved_state.h"
#include "program/plain_words.h"
#include "program/source_revision.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_shards = 100'000;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

const double program_start = now();

/// Of this program. What `getrusage` tells begins with what the process had before it became this program.
long peak_of_program() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (long kib = 0; word == "VmHWM:" && status >> kib) return kib;
  rusage self{};
  ::getrusage(RUSAGE_SELF, &self);
  return self.ru_maxrss;
}

/// Of this program, and of the largest of its children.
long peak_kib() {
  rusage children{};
  ::getrusage(RUSAGE_CHILDREN, &children);
  return peak_of_program() + children.ru_maxrss;
}

/// Hash of lines, one after the other.
std::uint64_t add_to(std::uint64_t hash, std::string_view line) {
  const std::array<std::uint64_t, 2> both{hash, hash_of(std::as_bytes(std::span(line)))};
  return hash_of(std::as_bytes(std::span(both)));
}

/// A permutation of all numbers, the same everywhere: the end of SplitMix64.
std::uint64_t scrambled(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15;
  number = (number ^ number >> 30) * 0xbf58476d1ce4e5b9;
  number = (number ^ number >> 27) * 0x94d049bb133111eb;
  return number ^ number >> 31;
}

std::string text_of(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string hash_of_record(const Json& record) {
  return text_of(add_to(0, record.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

/// What a manifest says but for where the work was begun.
std::string hash_of_work(Json manifest) {
  manifest.erase("folder");
  return text_of(add_to(0, manifest.dump()));
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& cause) {
  throw Bad_shard(file.string() + ": " + cause);
}

/// Where the last line begins, of a file of so many bytes that ends with a line break.
std::streamoff begin_of_last_line(std::ifstream& in, std::streamoff bytes) {
  std::string block;
  for (std::streamoff end = bytes - 1; end > 0;) {
    const std::streamoff begin = std::max<std::streamoff>(0, end - 4096);
    block.resize(static_cast<std::size_t>(end - begin));
    in.seekg(begin);
    in.read(block.data(), end - begin);
    const auto cut = block.rfind('\n');
    if (cut != std::string::npos) return begin + static_cast<std::streamoff>(cut) + 1;
    end = begin;
  }
  return 0;
}

/// The last line, which must end with a line break; empty if there is none.
std::string last_line(std::ifstream& in) {
  in.seekg(0, std::ios::end);
  const std::streamoff bytes = in.tellg();
  if (bytes == 0) return {};
  in.seekg(bytes - 1);
  if (in.get() != '\n') return {};
  const auto begin = begin_of_last_line(in, bytes);
  std::string line(static_cast<std::size_t>(bytes - begin), '\0');
  in.seekg(begin);
  in.read(line.data(), bytes - begin);
  return line;
}

/// For the parser: what lies deeper is left out.
bool is_shallow(int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
  constexpr int deepest = 64;
  return depth <= deepest;
}

}  // namespace

std::vector<std::size_t> Shard::neighbours(std::size_t pieces) const {
  std::vector<std::size_t> chosen;
  for (std::size_t piece = pieces * (index - 1) / count; piece < pieces * index / count; ++piece)
    chosen.push_back(piece);
  return chosen;
}

std::vector<std::size_t> Shard::scattered(std::size_t pieces) const {
  // Every count-th piece would often be of one kind: pieces are listed by their settings.
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t piece = 0; piece < pieces; ++piece) order.emplace_back(scrambled(piece), piece);
  std::ranges::sort(order);
  std::vector<std::size_t> chosen;
  for (std::size_t i = index - 1; i < pieces; i += count) chosen.push_back(order[i].second);
  std::ranges::sort(chosen);
  return chosen;
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    const bool read = second.ec == std::errc() && second.ptr == end;
    if (read && shard.index >= 1 && shard.index <= shard.count && shard.count <= most_shards) return shard;
  }
  throw Bad_argument(
      fmt::format("--shard: expected I/N with 1 <= I <= N <= {}, found '{}'", most_shards, printable(text)));
}

std::vector<std::string> words_of_work(const std::vector<std::string>& given) {
  const auto words = plain_words(given);
  const auto is_one_of = [](const std::string& word, std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* name) { return word == name; });
  };
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto name = words[i].substr(0, words[i].find('='));
    const bool takes_value = is_one_of(name, {"--out", "--shard", "--jobs", "--threads"});
    if (takes_value && name == words[i]) ++i;
    if (!takes_value && !is_one_of(words[i], {"--quiet", "--merge-shards"})) kept.push_back(words[i]);
  }
  return kept;
}

namespace {

/// JSON, in which shards note what they are of, holds nothing else.
void check_utf8(const std::string& text, const char* what) {
  try {
    std::ignore = Json(text).dump();
  } catch (const Json::exception&) {
    throw Bad_argument(fmt::format("{} is not UTF-8, which shards need: {}", what, printable(text)));
  }
}

void check_utf8(const Work& work, const std::string& folder) {
  for (const auto& word : work.command) check_utf8(word, "a word of the command line");
  for (const auto& [name, input] : work.inputs.items()) check_utf8(name, "the name of an input");
  check_utf8(folder, "the name of the working folder");
}

}  // namespace

Shard_folder::Shard_folder(std::filesystem::path results) : results_(std::move(results)) { read_manifest(); }

Shard_folder::Shard_folder(std::filesystem::path results, const Work& work, Shard_use use)
    : results_(std::move(results)) {
  const std::string begun = std::filesystem::current_path().string();
  check_utf8(work, begun);
  const Json wanted{{"command", work.command}, {"folder", begun},       {"revision", source_revision()},
                    {"shards", work.shards},   {"pieces", work.pieces}, {"inputs", work.inputs}};
  const auto file = folder() / "manifest.json";
  // Shards that start together write the same bytes. Each shard also holds the hash of its own work.
  if (!exists(file)) write_whole(file, wanted.dump(2) + "\n");
  read_manifest();
  for (const char* key : {"command", "revision", "shards", "pieces", "inputs"})
    if (manifest_[key] != wanted[key] && (use == Shard_use::make || std::string_view(key) != "revision"))
      throw Bad_argument(fmt::format("{}: these are shards of other work: {} is {}, not {}", folder().string(), key,
                                     manifest_[key].dump(), wanted[key].dump()));
}

void Shard_folder::read_manifest() {
  const auto file = folder() / "manifest.json";
  std::ifstream in(file, std::ios::binary);
  if (!in && exists(file)) fail(file, "cannot be read");
  if (!in) fail(file, "cannot be read: the folder has no shards");
  manifest_ = Json::parse(in, is_shallow, false);
  const auto is_list = [](const Json& json) {
    return json.is_array() && !json.empty() && std::ranges::all_of(json, [](const Json& j) { return j.is_string(); });
  };
  const bool right = manifest_.is_object() && manifest_.contains("command") && is_list(manifest_["command"]) &&
                     manifest_.value("shards", Json()).is_number_unsigned() && manifest_["shards"] >= 1 &&
                     manifest_["shards"] <= most_shards && manifest_.value("pieces", Json()).is_number_unsigned() &&
                     manifest_.value("folder", Json()).is_string() && manifest_.value("revision", Json()).is_string();
  if (!right) fail(file, "is no manifest of shards");
  work_ = hash_of_work(manifest_);
}

std::filesystem::path Shard_folder::file(std::size_t index) const {
  const auto digits = std::to_string(shards()).size();
  return folder() / fmt::format("{:0{}}-of-{}.jsonl", index, digits, shards());
}

std::filesystem::path Shard_folder::journal(std::size_t index) const {
  return std::filesystem::path(file(index)).replace_extension(".begun.jsonl");
}

/// Checks what the record says of the whole file, but not the hash.
Json Shard_folder::read_record(std::size_t index) const {
  const auto path = file(index);
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, exists(path) ? "cannot be read" : "is missing");
  const auto line = last_line(in);
  Json record = Json::parse(line, is_shallow, false);
  const bool whole = record.is_object() && record.value("bytes", Json()).is_number_unsigned() &&
                     record.value("lines", Json()).is_number_unsigned() && record.value("hash", Json()).is_string() &&
                     record.value("work", Json()).is_string() && record.value("seconds", Json()).is_number() &&
                     record.value("peak_kib", Json()).is_number() && record.value("finished", Json()).is_string() &&
                     record.value("record_hash", Json()).is_string();
  if (!whole) fail(path, "is damaged: it does not end with the record of a shard");
  const std::string written = record["record_hash"];
  record.erase("record_hash");
  if (hash_of_record(record) != written) fail(path, "is damaged: its record is not the one that was written");
  in.clear();
  in.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::size_t>(in.tellg()) - line.size();
  if (record["bytes"] != bytes)
    fail(path, fmt::format("is damaged: it holds {} bytes before its record, expected {}", bytes,
                           record["bytes"].get<std::size_t>()));
  if (record["work"] != work_ || record["shard"] != index || record["of"] != shards())
    fail(path, "is a shard of other work than manifest.json says");
  return record;
}

Json Shard_folder::read(std::size_t index, const std::function<void(std::string_view)>& visit) const {
  Json record = read_record(index);
  std::ifstream in(file(index), std::ios::binary);
  const std::size_t lines = record["lines"];
  std::uint64_t hash = 0;
  std::string line;
  for (std::size_t number = 0; number < lines; ++number) {
    if (!std::getline(in, line)) fail(file(index), "is damaged: it has fewer lines than its record says");
    hash = add_to(hash, line);
    try {
      visit(line);
    } catch (const Json::exception&) {
      fail(file(index), fmt::format("is damaged: line {} is not what was written", number + 1));
    }
  }
  if (record["hash"] != text_of(hash)) fail(file(index), "is damaged: its lines are not those that were written");
  return record;
}

Shard_status Shard_folder::status(std::size_t index, Shard_check check) const {
  if (!exists(file(index))) return {};
  try {
    return {.state = Shard_state::done,
            .cause = {},
            .record = check == Shard_check::all ? read(index, [](std::string_view) {}) : read_record(index)};
  } catch (const Bad_shard& error) {
    return {.state = Shard_state::broken, .cause = error.what(), .record = {}};
  }
}

std::vector<Json> Shard_folder::read_all(const std::function<void(std::string_view)>& visit) const {
  std::vector<std::size_t> missing;
  for (std::size_t index = 1; index <= shards(); ++index)
    if (!exists(file(index))) missing.push_back(index);
  if (!missing.empty())
    fail(folder(), fmt::format("{} of {} missing: {}", missing.size(), counted(shards(), "shard"), ranges_of(missing)));
  std::vector<Json> records;
  for (std::size_t index = 1; index <= shards(); ++index) records.push_back(read(index, visit));
  return records;
}

void Shard_folder::note_merged(const std::vector<std::string>& files) const {
  write_whole(folder() / "merged", fmt::format("{}\n{}\n", work_, fmt::join(files, "\n")));
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    if (entry.path().filename().string().starts_with('.')) {
      std::error_code ignored;
      std::filesystem::remove(entry.path(), ignored);
    }
}

void Shard_folder::note_replaced(const std::filesystem::path& results) {
  std::error_code ignored;
  std::filesystem::remove(results / "shards" / "merged", ignored);
}

bool Shard_folder::is_merged() const {
  std::ifstream noted(folder() / "merged");
  std::string line;
  if (!std::getline(noted, line) || line != work_) return false;
  while (std::getline(noted, line))
    if (!exists(results_ / line)) return false;
  return true;
}

Shard_writer::Shard_writer(const Shard_folder& folder, std::size_t index)
    : folder_(folder), index_(index), count_(folder.shards()), work_(folder.work_), file_(folder.file(index)) {}

void Shard_writer::add(std::string_view line) {
  file_.write(line);
  file_.write("\n");
  hash_ = add_to(hash_, line);
  ++lines_;
  bytes_ += line.size() + 1;
}

void Shard_writer::commit(const Json& more) {
  Json record{
      {"shard", index_},
      {"of", count_},
      {"work", work_},
      {"lines", lines_},
      {"bytes", bytes_},
      {"hash", text_of(hash_)},
      {"seconds", now() - program_start},
      {"peak_kib", peak_kib()},
      {"finished",
       fmt::format("{:%FT%TZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())))}};
  record.update(more);
  record["record_hash"] = hash_of_record(record);
  file_.write(record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  // Two works that were begun in one folder at the same moment have both found it empty.
  if (Shard_folder(folder_.results()).work() != work_)
    throw Bad_shard(folder_.results().string() + ": shards of other work were begun here at the same time");
  try {
    file_.commit();
  } catch (const Bad_output&) {
    if (!folder_.is_done(index_)) throw;  // another process has made the shard, and a merge has cleared up
  }
}

Json parse_shard_line(std::string_view line) { return Json::parse(line, is_shallow); }

std::string ranges_of(const std::vector<std::size_t>& numbers, std::string_view separator) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    parts.push_back(last == i ? std::to_string(numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]));
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(parts, separator));
}

}  // namespace lodestone
