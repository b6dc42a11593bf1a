// SPDX-License-Identifier: GPL-3.0-or-later
#include "pickled.h"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/saved_state.h"

namespace lodestone::python {

namespace {

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Writes what it is called with.
class Pickler {
 public:
  template <Number N>
  void operator()(const N& number) {
    if constexpr (std::same_as<N, bool>)
      writer_.value(std::uint8_t{number});
    else if constexpr (std::is_enum_v<N>)
      writer_.value(static_cast<std::uint32_t>(number));
    else
      writer_.value(number);
  }
  /// How many, then what `visit` does with each.
  template <class List, class Visit>
  void list(const List& list, const Visit& visit) {
    writer_.value(std::uint64_t{list.size()});
    for (const auto& item : list) visit(item);
  }
  template <class T, class Visit>
  void optional(const std::optional<T>& value, const Visit& visit) {
    (*this)(value.has_value());
    if (value) visit(*value);
  }
  void text(const std::string& text) { writer_.list(std::span(text.data(), text.size())); }
  void point(const Point& p) {
    for (int axis = 0; axis < 3; ++axis) (*this)(p[axis]);
  }

  py::bytes take() {
    const auto bytes = writer_.take();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  State_writer writer_;
};

/// Reads in the same order what a Pickler has written, and sets what it is called with.
class Unpickler {
 public:
  explicit Unpickler(std::string_view bytes) : reader_(std::as_bytes(std::span(bytes))) {}

  template <Number N>
  void operator()(N& number) {
    if constexpr (std::same_as<N, bool>)
      number = reader_.value<std::uint8_t>() != 0;
    else if constexpr (std::is_enum_v<N>)
      number = static_cast<N>(reader_.value<std::uint32_t>());
    else
      number = reader_.value<N>();
  }
  template <class List, class Visit>
  void list(List& list, const Visit& visit) {
    // One by one: bytes that end too early must not ask for memory.
    for (auto left = reader_.value<std::uint64_t>(); left > 0; --left) {
      State_reader::require(list.size() < list.max_size(), "a list is too long");
      visit(list.emplace_back());
    }
  }
  template <class T, class Visit>
  void optional(std::optional<T>& value, const Visit& visit) {
    bool has_value = false;
    (*this)(has_value);
    if (has_value) visit(value.emplace());
  }
  void text(std::string& text) {
    const auto letters = reader_.list<char>();
    text.assign(letters.begin(), letters.end());
  }
  void point(Point& p) {
    double coordinates[3];
    for (double& coordinate : coordinates) (*this)(coordinate);
    p = Point(coordinates[0], coordinates[1], coordinates[2]);
  }
  void end() const { reader_.end(); }

 private:
  State_reader reader_;
};

// Each function below lists the fields of a type once: a Pickler writes them, an Unpickler sets them.

void visit_numbers(auto& archive, auto&... numbers) { (archive(numbers), ...); }

void visit_vector(auto& archive, auto& vector) { visit_numbers(archive, vector[0], vector[1], vector[2]); }

void visit_list(auto& archive, auto& list) {
  archive.list(list, [&](auto& number) { archive(number); });
}

void visit_statistics(auto& archive, auto& s) {
  visit_numbers(archive, s.seconds.build, s.seconds.repartition, s.seconds.refit, s.seconds.broad_phase,
                s.seconds.relaxation, s.seconds.candidates, s.seconds.confirmation, s.object_candidates, s.iterations,
                s.moves, s.relaxed, s.meetings, s.vertices_read, s.nodes_bounded, s.leaves_posed, s.violations,
                s.candidates, s.leaf_tests, s.exact_tests, s.contacts, s.builds, s.repartitions);
}

void visit_pair(auto& archive, auto& pair) {
  visit_numbers(archive, pair.a, pair.b, pair.collides, pair.near, pair.candidates, pair.leaf_tests,
                pair.first_contact, pair.contacts, pair.capped, pair.unfinished, pair.containment, pair.first_patch, pair.patches);
  archive.optional(pair.parting, [&](auto& parting) {
    visit_vector(archive, parting.translation);
    archive(parting.length);
  });
}

void visit_frame(auto& archive, auto& frame) {
  archive(frame.number);
  archive.list(frame.pairs, [&](auto& pair) { visit_pair(archive, pair); });
  archive.list(frame.face_pairs, [&](auto& faces) { visit_numbers(archive, faces.a, faces.b); });
  visit_list(archive, frame.contact_intersects);
  archive.list(frame.contact_points, [&](auto& corners) {
    archive.list(corners, [&](auto& point) { archive.point(point); });
  });
  archive.list(frame.contact_normals, [&](auto& contact) {
    visit_vector(archive, contact.normal);
    archive(contact.depth);
  });
  archive.list(frame.patches, [&](auto& patch) {
    visit_list(archive, patch.contacts);
    visit_vector(archive, patch.point);
    visit_vector(archive, patch.normal);
    visit_numbers(archive, patch.depth, patch.length);
  });
  archive.list(frame.candidates, [&](auto& c) {
    visit_numbers(archive, c.a, c.region_a, c.b, c.region_b, c.distance);
  });
  visit_list(archive, frame.object_iterations);
  visit_statistics(archive, frame.statistics);
}

void visit_partition(auto& archive, auto& made) {
  archive.text(made.strategy);
  visit_list(archive, made.partition.labels);
  visit_list(archive, made.partition.particles);
  auto& m = made.measures;
  visit_numbers(archive, made.partition.regions, m.regions, m.distortion, m.size_balance, m.parts_per_region,
                m.border_length, m.normal_deviation, m.geodesic_radius, m.box_volume, m.ball_volume);
}

/// Attributes are made of slices and of parallel lists.
void check(const Python_frame& made) {
  const Frame& frame = *made.frame;
  const std::size_t contacts = frame.face_pairs.size(), patches = frame.patches.size();
  const auto is_parallel = [&](std::size_t count, bool has_to_be) {
    return count == contacts || (!has_to_be && count == 0);
  };
  bool right = is_parallel(frame.contact_intersects.size(), false) &&
               is_parallel(frame.contact_points.size(), made.with_points) &&
               is_parallel(frame.contact_normals.size(), made.with_normals);
  for (const auto& corners : frame.contact_points) right &= !corners.empty();
  for (const auto& pair : frame.pairs)
    right &= pair.first_contact <= contacts && pair.contacts <= contacts - pair.first_contact &&
             pair.first_patch <= patches && pair.patches <= patches - pair.first_patch;
  State_reader::require(right, "its parts do not fit");
}

/// The first number of all bytes tells what they are of, and the format. Whoever changes the fields changes the number.
constexpr std::uint64_t frame_mark = 0x4c4f4445'46520002, partition_mark = 0x4c4f4445'50410001;

template <class Visit>
void read(const py::bytes& bytes, const char* what, std::uint64_t expected, const Visit& visit) {
  try {
    Unpickler archive{std::string_view(bytes)};
    std::uint64_t mark = 0;
    archive(mark);
    State_reader::require(mark == expected, "it has another mark");
    visit(archive);
    archive.end();
  } catch (const Bad_saved_object&) {
    throw Bad_saved_object(std::string("these bytes are no pickled ") + what + ", or of another format");
  }
}

}  // namespace

py::bytes pickled(const Python_frame& frame) {
  Pickler archive;
  visit_numbers(archive, frame_mark, frame.with_points, frame.with_normals);
  visit_frame(archive, *frame.frame);
  return archive.take();
}

py::bytes pickled(const Python_partition& partition) {
  Pickler archive;
  archive(partition_mark);
  visit_partition(archive, partition);
  return archive.take();
}

Python_frame unpickled_frame(const py::bytes& bytes) {
  Python_frame made;
  read(bytes, "frame", frame_mark, [&](Unpickler& archive) {
    visit_numbers(archive, made.with_points, made.with_normals);
    Frame frame;
    visit_frame(archive, frame);
    made.frame = std::make_shared<const Frame>(std::move(frame));
    check(made);
  });
  return made;
}

Python_partition unpickled_partition(const py::bytes& bytes) {
  Python_partition made;
  read(bytes, "partition", partition_mark, [&](Unpickler& archive) { visit_partition(archive, made); });
  return made;
}

}  // namespace lodestone::python
