// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/results/page_sections.h"

#include <fmt/format.h>

#include <cmath>
#include <new>

namespace lodestone {

namespace {

constexpr std::size_t pending_size = std::size_t{1} << 16;
constexpr double largest_step = 65535;

/// The nearest of the 65536 steps from `low` to `high`.
std::int64_t step_of(double coordinate, double low, double high) {
  double extent = high - low, offset = coordinate - low;
  // Halving is exact: a difference overflows only for numbers far from subnormal.
  if (!std::isfinite(extent)) extent = high / 2 - low / 2, offset = coordinate / 2 - low / 2;
  return extent > 0 ? std::llround(largest_step * (offset / extent)) : 0;
}

std::vector<std::int64_t> steps_of(const Positions& positions, const Box& box) {
  std::vector<std::int64_t> steps;
  steps.reserve(static_cast<std::size_t>(positions.size()));
  for (const auto& row : positions.rowwise())
    for (int axis = 0; axis < 3; ++axis) steps.push_back(step_of(row[axis], box.min()[axis], box.max()[axis]));
  return steps;
}

/// One array with an array `[item, item, ...]` per frame.
template <class Item>
Section json_section(std::span<const Page_frame> frames, Item item) {
  Section_writer section;
  section.add("[");
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (f > 0) section.add(",\n");
    item(section, frames[f]);
  }
  section.add("]");
  return section.finish();
}

std::string text_of(const Candidate_regions& c) {
  return fmt::format("[{},{},{},{},{}]", c.a, c.region_a, c.b, c.region_b, c.distance);
}

std::string text_of(const Page_contact& c) {
  if (!c.ends) return fmt::format("[{},{},{},{}]", c.a, c.face_a, c.b, c.face_b);
  return fmt::format("[{},{},{},{},{}{}]", c.a, c.face_a, c.b, c.face_b, fmt::join(*c.ends, ","), c.apart ? ",1" : "");
}

template <class Rows>
void add_rows(Section_writer& section, const Rows& rows) {
  section.add("[");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) section.add(",");
    section.add(text_of(rows[i]));
  }
  section.add("]");
}

}  // namespace

Section_writer::Section_writer() {
  constexpr int raw_stream = -15, memory = 9;
  if (deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, raw_stream, memory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

Section_writer::~Section_writer() { deflateEnd(&stream_); }

void Section_writer::add(std::string_view text) {
  for (; !text.empty(); text.remove_prefix(std::min(text.size(), pending_size))) {
    pending_ += text.substr(0, pending_size);
    if (pending_.size() >= pending_size) deflate_pending(Z_NO_FLUSH);
  }
}

void Section_writer::add_varint(std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) pending_ += static_cast<char>((number & 0x7f) | 0x80);
  pending_ += static_cast<char>(number);
  if (pending_.size() >= pending_size) deflate_pending(Z_NO_FLUSH);
}

void Section_writer::deflate_pending(int flush) {
  section_.raw += pending_.size();
  stream_.next_in = reinterpret_cast<Bytef*>(pending_.data());
  stream_.avail_in = static_cast<uInt>(pending_.size());
  do {
    std::array<char, pending_size> out;
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = out.size();
    ::deflate(&stream_, flush);
    section_.bytes.append(out.data(), out.size() - stream_.avail_out);
  } while (stream_.avail_out == 0);
  pending_.clear();
}

Section Section_writer::finish() {
  deflate_pending(Z_FINISH);
  return std::move(section_);
}

Section topology_section(std::span<const Corners> corners) {
  Section_writer section;
  std::int64_t before = 0;
  for (const auto& face : corners)
    for (const std::int64_t corner : face) section.add_signed(corner - std::exchange(before, corner));
  return section.finish();
}

Section labels_section(std::span<const Region_index> labels) {
  Section_writer section;
  for (const auto label : labels) section.add_varint(label);
  return section.finish();
}

Section positions_section(std::span<const Page_frame> frames, Object_id object, const Box& box) {
  Section_writer section;
  std::vector<std::int64_t> last, before_last;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    auto now = steps_of(frames[f].positions[object], box);
    for (std::size_t i = 0; i < now.size(); ++i) {
      std::int64_t expected = i < 3 ? 0 : now[i - 3];
      if (f == 1) expected = last[i];
      if (f > 1) expected = 2 * last[i] - before_last[i];
      section.add_signed(now[i] - expected);
    }
    before_last = std::exchange(last, std::move(now));
  }
  return section.finish();
}

Section particles_section(std::span<const Page_frame> frames, Object_id object) {
  Section_writer section;
  for (const auto& frame : frames) {
    section.add_varint(frame.particles[object].size());
    for (const auto vertex : frame.particles[object]) section.add_varint(vertex);
  }
  return section.finish();
}

Section numbers_section(std::span<const Page_frame> frames) {
  Section_writer section;
  for (const auto& frame : frames) section.add(frame.numbers);
  return section.finish();
}

Section stages_section(std::span<const Page_frame> frames) {
  return json_section(frames, [](Section_writer& section, const Page_frame& frame) { section.add(frame.stages); });
}

Section candidates_section(std::span<const Page_frame> frames) {
  return json_section(frames,
                      [](Section_writer& section, const Page_frame& frame) { add_rows(section, *frame.candidates); });
}

Section contacts_section(std::span<const Page_frame> frames) {
  return json_section(frames,
                      [](Section_writer& section, const Page_frame& frame) { add_rows(section, *frame.contacts); });
}

}  // namespace lodestone
