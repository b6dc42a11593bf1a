// SPDX-License-Identifier: GPL-3.0-or-later
// Encodes numbers as the sections of a page: see docs/page_format.md.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/io/results/page.h"
#include "lodestone/mesh/box.h"

namespace lodestone {

/// A raw deflate stream, with its inflated length.
struct Section {
  std::string bytes;
  std::size_t raw = 0;
};

/// Deflates its input piece by piece.
class Section_writer {
 public:
  Section_writer();
  ~Section_writer();
  Section_writer(const Section_writer&) = delete;
  Section_writer& operator=(const Section_writer&) = delete;

  void add(std::string_view text);
  /// Seven bits per byte, low bits first.
  void add_varint(std::uint64_t number);
  /// Zigzag encoding, which is short for numbers near zero: 0, -1, 1, -2 ... are stored as 0, 1, 2, 3 ...
  void add_signed(std::int64_t number) {
    add_varint(number >= 0 ? 2 * static_cast<std::uint64_t>(number)
                           : 2 * static_cast<std::uint64_t>(-(number + 1)) + 1);
  }
  Section finish();

 private:
  void deflate_pending(int flush);

  z_stream stream_ = {};
  std::string pending_;
  Section section_;
};

Section topology_section(std::span<const Corners> corners);
Section labels_section(std::span<const Region_index> labels);
/// @param box  of the object over all frames
Section positions_section(std::span<const Page_frame> frames, Object_id object, const Box& box);
Section particles_section(std::span<const Page_frame> frames, Object_id object);
Section numbers_section(std::span<const Page_frame> frames);
Section stages_section(std::span<const Page_frame> frames);
Section candidates_section(std::span<const Page_frame> frames);
Section contacts_section(std::span<const Page_frame> frames);

}  // namespace lodestone
