// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes pages from docs/page_format.md alone, without the code that makes them.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lodestone::test {

/// Reads the integers of a section in order.
class Varints {
 public:
  explicit Varints(std::string bytes) : bytes_(std::move(bytes)) {}

  bool done() const { return at_ == bytes_.size(); }
  std::uint64_t next() {
    std::uint64_t number = 0;
    for (int shift = 0;; shift += 7) {
      if (done()) throw std::runtime_error("a varint without an end");
      const auto byte = static_cast<unsigned char>(bytes_[at_++]);
      number += std::uint64_t{byte & 0x7fU} << shift;
      if (byte < 0x80) return number;
    }
  }
  std::int64_t next_signed() {
    const std::uint64_t n = next();
    return n % 2 == 0 ? static_cast<std::int64_t>(n / 2) : -static_cast<std::int64_t>(n / 2) - 1;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// Inflates a raw deflate stream; all of `bytes` must belong to it.
std::string inflated(std::string_view bytes);

/// Positions of an object in one frame: x y z of each vertex.
using Decoded_positions = std::vector<double>;

class Decoded_page {
 public:
  explicit Decoded_page(const std::string& container) {
    const auto number = [&](std::size_t at) {
      std::size_t value = 0;
      for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(container.at(at + i));
      return value;
    };
    if (container.substr(0, 8) != "LDSTPAGE" || number(8) != 1) throw std::runtime_error("not a page of version 1");
    const std::size_t length = number(12);
    header = nlohmann::json::parse(container.substr(16, length));
    rest_ = container.substr(16 + length);
  }

  nlohmann::json header;

  std::string section(const nlohmann::json& name) const {
    const auto& place = header.at("sections").at(name.get<std::string>());
    std::string text = inflated(std::string_view(rest_).substr(place.at("offset"), place.at("bytes")));
    EXPECT_EQ(text.size(), place.at("raw"));
    return text;
  }
  nlohmann::json json_section(const char* key) const { return nlohmann::json::parse(section(header.at(key))); }
  const nlohmann::json& object(std::size_t o) const { return header.at("objects").at(o); }

  std::vector<std::uint32_t> topology(std::size_t o) const {
    Varints numbers(section(object(o).at("topology")));
    std::vector<std::uint32_t> corners;
    for (std::int64_t last = 0; !numbers.done();) {
      last += numbers.next_signed();
      corners.push_back(static_cast<std::uint32_t>(last));
    }
    EXPECT_EQ(corners.size(), 3 * object(o).at("triangles").get<std::size_t>());
    return corners;
  }

  std::vector<Decoded_positions> positions(std::size_t o) const {
    Varints numbers(section(object(o).at("positions")));
    const auto box = object(o).at("box").get<std::array<double, 6>>();
    const std::size_t values = 3 * object(o).at("vertices").get<std::size_t>();
    std::vector<std::vector<std::int64_t>> q(header.at("frames").get<std::size_t>());
    std::vector<Decoded_positions> frames(q.size());
    for (std::size_t f = 0; f < q.size(); ++f)
      for (std::size_t i = 0; i < values; ++i) {
        std::int64_t expected = 0;
        if (f == 0 && i >= 3) expected = q[0][i - 3];
        if (f == 1) expected = q[0][i];
        if (f >= 2) expected = 2 * q[f - 1][i] - q[f - 2][i];
        q[f].push_back(expected + numbers.next_signed());
        EXPECT_GE(q[f].back(), 0);
        EXPECT_LE(q[f].back(), 65535);
        // The extent itself may exceed the largest double.
        const double part = static_cast<double>(q[f].back()) / 65535;
        frames[f].push_back(box[i % 3] * (1 - part) + box[3 + i % 3] * part);
      }
    EXPECT_TRUE(numbers.done());
    return frames;
  }

  std::vector<std::uint32_t> labels(std::size_t o, std::size_t partition) const {
    Varints numbers(section(object(o).at("partitions").at(partition).at("labels")));
    std::vector<std::uint32_t> labels;
    while (!numbers.done()) labels.push_back(static_cast<std::uint32_t>(numbers.next()));
    EXPECT_EQ(labels.size(), object(o).at("vertices"));
    return labels;
  }

  std::vector<std::vector<std::uint32_t>> particles(std::size_t o) const {
    Varints numbers(section(object(o).at("particles")));
    std::vector<std::vector<std::uint32_t>> frames(header.at("frames").get<std::size_t>());
    for (auto& frame : frames)
      for (std::uint64_t left = numbers.next(); left > 0; --left)
        frame.push_back(static_cast<std::uint32_t>(numbers.next()));
    EXPECT_TRUE(numbers.done());
    return frames;
  }

  /// Every section by name, except for the times.
  std::map<std::string, std::string> timeless() const {
    std::map<std::string, std::string> sections;
    for (const auto& [name, place] : header.at("sections").items())
      if (name != header.at("stages")) sections[name] = section(name);
    return sections;
  }

  /// The sections must fill the bytes after the header without gaps or overlaps.
  void expect_packed() const {
    std::set<std::pair<std::size_t, std::size_t>> places;
    for (const auto& place : header.at("sections")) places.emplace(place.at("offset"), place.at("bytes"));
    EXPECT_EQ(places.size(), header.at("sections").size());
    std::size_t end = 0;
    for (const auto& [offset, bytes] : places) {
      EXPECT_EQ(offset, end);
      end += bytes;
    }
    EXPECT_EQ(end, rest_.size());
  }

 private:
  std::string rest_;
};

std::string from_base64(std::string_view text);

/// The data of a page as a browser would find them.
std::string data_of(std::string_view html);

}  // namespace lodestone::test
