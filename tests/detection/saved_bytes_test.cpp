// SPDX-License-Identifier: GPL-3.0-or-later
// What is no saved object, or not one of this mesh, is refused, whoever wrote it.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <string>

#include "lodestone/detection/saved_object.h"
#include "lodestone/detector.h"
#include "lodestone/tree/tree_layout.h"
#include "support/message_of.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Bytes = std::vector<std::byte>;

template <class Call>
std::string refusal_of(const Call& call) {
  return message_of<Bad_saved_object>(call);
}
std::string refusal_of(const Bytes& bytes) {
  return refusal_of([&] { open_saved(bytes); });
}

TEST(Saved_bytes, say_what_is_wrong_with_them) {
  Surface_mesh mesh = sphere(4);
  Detector<> detector;
  detector.add(mesh);
  const Bytes saved = detector.save(0);
  EXPECT_EQ(refusal_of(saved), "no error");
  EXPECT_EQ(refusal_of({}), "this is no saved object");
  EXPECT_EQ(refusal_of(Bytes(100, std::byte{'x'})), "this is no saved object");
  const auto changed = [&](std::size_t at) {
    Bytes bytes = saved;
    bytes[at] ^= std::byte{1};
    return bytes;
  };
  EXPECT_EQ(refusal_of(changed(16)), "the object was saved in format 3, but this version reads format 2");
  EXPECT_EQ(refusal_of(changed(20)), "the object was saved on a machine with another byte order");
  Bytes longer = saved;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refusal_of(longer), "the saved object is broken: there are more bytes than it has");
  for (std::size_t size = 16; size < saved.size(); ++size)
    ASSERT_EQ(refusal_of({saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(size)}),
              "the saved object is broken: it ends too early");
  for (std::size_t at = 0; at < saved.size(); ++at) ASSERT_NE(refusal_of(changed(at)), "no error") << at;
  EXPECT_EQ(refusal_of(changed(100)), "the saved object is broken: its bytes have changed");
}

TEST(Saved_bytes, cannot_put_other_lines_or_a_long_text_into_a_message) {
  Surface_mesh mesh = sphere(4);
  Detector<> detector;
  detector.add(mesh);
  State_writer writer;
  writer.list(std::vector<char>{'a', '\n', '\x1b', 'b'});
  EXPECT_EQ(refusal_of([&] { detector.load(0, seal_saved(writer.take())); }),
            "the object was saved in mode a??b, but object 0 is in mode exact with volumes of kind aabb");
  writer.list(std::vector<char>(100'000, 'x'));
  EXPECT_LT(refusal_of([&] { detector.load(0, seal_saved(writer.take())); }).size(), 200U);
}

/// What a mode has saved, with the name of another mode.
Bytes renamed(const Bytes& saved, const std::string& mode) {
  const auto body = open_saved(saved);
  State_reader reader(body);
  State_writer writer;
  const std::size_t own_length = reader.list<char>().size();
  writer.list(std::vector<char>(mode.begin(), mode.end()));
  Bytes other = writer.take();
  const auto rest = body.subspan(sizeof(std::uint64_t) + own_length);
  other.insert(other.end(), rest.begin(), rest.end());
  return seal_saved(other);
}

TEST(Saved_bytes, of_another_mode_are_refused_also_if_they_bear_the_name_of_this_one) {
  struct Kind {
    std::string name;
    Detector_options options;
  };
  const std::vector<Kind> kinds{{"particles", {.mode = Mode::particles}},
                                {"particles without meetings", {.mode = Mode::particles, .meetings = 0}},
                                {"senin", {.mode = Mode::senin}}};
  for (const Kind& from : kinds)
    for (const Kind& to : kinds) {
      SCOPED_TRACE(from.name + " as " + to.name);
      Surface_mesh a = sphere(6), b = sphere(6, 1, {1.8, 0, 0});
      Detector first(from.options), second(to.options);
      first.add(a), second.add(a), second.add(b);
      const Bytes bytes = renamed(first.save(0), to.name);
      const std::string refusal = refusal_of([&] { second.load(0, bytes); });
      EXPECT_EQ(refusal == "no error", from.name == to.name) << refusal;
      EXPECT_TRUE(second.detect().collides());
      // Where all faces are points, there may be no particle.
      const std::vector<double> numbers{0, 0, 0, 1, 0, 0, 2, 0, 0};
      const std::vector<Corners> faces{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
      const Indexed_mesh points(numbers, faces), others(numbers, faces);
      Detector third(from.options), fourth(to.options);
      third.add(points), fourth.add(points), fourth.add(others);
      const Bytes of_points = renamed(third.save(0), to.name);
      EXPECT_EQ(refusal_of([&] { fourth.load(0, of_points); }) == "no error", from.name == to.name);
      fourth.detect();
    }
}

TEST(Saved_regions, that_do_not_fit_are_refused) {
  const auto refusal = [](const Numbered_partition& regions) {
    State_writer writer;
    save_regions(regions, writer);
    const Bytes bytes = writer.take();
    State_reader reader(bytes);
    return refusal_of([&] { load_regions(reader, 4); });
  };
  const auto partition = [](std::vector<Region_index> labels, std::vector<std::uint32_t> particles) {
    Numbered_partition regions;
    regions.labels = std::move(labels), regions.particles = std::move(particles);
    regions.regions = 2;
    return regions;
  };
  EXPECT_EQ(refusal(partition({0, 1, 1, 0}, {3, 1})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 1, 0, 0}, {3, 1})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 1}, {0, 1})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 2, 0}, {3, 1})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {3, 1, 2})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {3})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {1, 3})), "no error");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {3, 4})), "no error");
}

/// The lists of a tree, as they are saved.
struct Lists {
  std::vector<Tree_layout::Node> nodes;
  std::vector<std::uint32_t> face_begin{0}, vertex_begin{0}, faces, vertices;
  std::vector<Leaf_corners> corners;
};

/// Faces that share no vertices, in leaves of equal size, each of which hangs on the branch of the one before.
Lists chain(std::uint32_t leaves, std::uint32_t leaf_faces) {
  Lists lists;
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    const auto node = static_cast<std::uint32_t>(lists.nodes.size());
    if (leaf + 1 < leaves) lists.nodes.push_back({.second_child = node + 2, .leaf = leaf, .end_leaf = leaves});
    lists.nodes.push_back({.leaf = leaf, .end_leaf = leaf + 1});
    for (std::uint16_t i = 0; i < leaf_faces; ++i) {
      const auto place = static_cast<std::uint16_t>(3 * i);
      lists.faces.push_back(static_cast<std::uint32_t>(lists.faces.size()));
      lists.corners.push_back({place, static_cast<std::uint16_t>(place + 1), static_cast<std::uint16_t>(place + 2)});
    }
    lists.face_begin.push_back(static_cast<std::uint32_t>(lists.faces.size()));
    lists.vertex_begin.push_back(3 * lists.face_begin.back());
  }
  for (std::uint32_t v = 0; v < 3 * lists.faces.size(); ++v) lists.vertices.push_back(v);
  return lists;
}

std::string refusal_of(const Lists& lists) {
  std::vector<Corners> faces;
  for (const auto face : lists.faces) faces.push_back({3 * face, 3 * face + 1, 3 * face + 2});
  State_writer writer;
  writer.list(lists.nodes);
  for (const auto* list : {&lists.face_begin, &lists.vertex_begin, &lists.faces, &lists.vertices}) writer.list(*list);
  writer.list(lists.corners);
  const Bytes bytes = writer.take();
  State_reader reader(bytes);
  return refusal_of([&] { Tree_layout::load(reader, faces, 3 * faces.size()); });
}

TEST(Saved_tree, that_is_too_deep_or_has_too_large_leaves_or_short_lists_is_refused) {
  EXPECT_EQ(refusal_of(chain(3, 128)), "no error");
  EXPECT_NE(refusal_of(chain(3, 129)), "no error");
  EXPECT_EQ(refusal_of(chain(4000, 1)), "no error");
  EXPECT_NE(refusal_of(chain(5000, 1)), "no error");
  Lists lists = chain(3, 4);
  lists.corners.pop_back();
  EXPECT_EQ(refusal_of(lists), "the saved object is broken: its tree has lists of other lengths than it needs");
}

TEST(Saved_tree, with_a_vertex_in_a_leaf_that_no_face_of_it_has_is_refused) {
  Lists lists = chain(3, 4);
  lists.vertices.insert(lists.vertices.begin() + 12, 12);  // of the next leaf
  for (std::size_t leaf = 1; leaf < lists.vertex_begin.size(); ++leaf) ++lists.vertex_begin[leaf];
  EXPECT_EQ(refusal_of(lists), "the saved object is broken: leaf 0: none of its faces has vertex 12");
}

/// What an object with particles has saved, up to its homes.
struct Saved_particles {
  struct Home {
    std::uint32_t vertex, compass;
    double angle;
  };

  std::vector<char> mode;
  std::array<std::uint64_t, 3> mesh;
  double radius;
  std::vector<std::uint32_t> joined, at;
  std::vector<Region_index> labels;
  double effective_radius, collision_distance;
  std::uint64_t hop_limit, rings;
  std::vector<Home> homes;
  std::span<const std::byte> rest;

  explicit Saved_particles(std::span<const std::byte> bytes) {
    State_reader state(bytes);
    mode = state.list<char>();
    for (auto& number : mesh) number = state.value<std::uint64_t>();
    radius = state.value<double>();
    joined = state.list<std::uint32_t>();
    labels = state.list<Region_index>();
    at = state.list<std::uint32_t>();
    effective_radius = state.value<double>();
    collision_distance = state.value<double>();
    hop_limit = state.value<std::uint64_t>();
    rings = state.value<std::uint64_t>();
    homes.resize(state.value<std::uint64_t>());
    for (auto& [vertex, compass, angle] : homes) {
      vertex = state.value<std::uint32_t>();
      compass = state.value<std::uint32_t>();
      angle = state.value<double>();
    }
    rest = bytes.subspan(written().size());
  }

  Bytes written() const {
    State_writer state;
    state.list(mode);
    for (const auto& number : mesh) state.value(number);
    state.value(radius);
    state.list(joined);
    state.list(labels);
    state.list(at);
    state.value(effective_radius);
    state.value(collision_distance);
    state.value(hop_limit);
    state.value(rings);
    state.value(std::uint64_t{homes.size()});
    for (const auto& [vertex, compass, angle] : homes) state.value(vertex), state.value(compass), state.value(angle);
    Bytes bytes = state.take();
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
  }
};

TEST(Saved_particles, that_do_not_fit_are_refused) {
  Surface_mesh mesh = sphere(6);
  const Detector_options options{.mode = Mode::particles, .particles = 8};
  Detector<> detector(options), victim(options);
  detector.add(mesh), victim.add(mesh);
  const Bytes saved = detector.save(0);
  const auto vertices = static_cast<std::uint32_t>(mesh.number_of_vertices());
  const auto refusal = [&](const std::function<void(Saved_particles&)>& change) {
    Saved_particles particles(open_saved(saved));
    change(particles);
    return refusal_of([&] { victim.load(0, seal_saved(particles.written())); });
  };
  const auto join = [&](Saved_particles& p, std::uint32_t count) {
    for (std::uint32_t v = 0; v < count; ++v) p.joined.push_back(v);
  };
  const std::string start = "the saved object is broken: ";
  EXPECT_EQ(refusal([](auto&) {}), "no error");
  EXPECT_EQ(refusal([&](auto& p) { join(p, vertices - 1); }),
            start + "its seams do not have one entry for each vertex");
  EXPECT_EQ(refusal([&](auto& p) { join(p, vertices), p.joined[3] = vertices; }),
            start + "a vertex is joined to one that does not exist");
  EXPECT_EQ(refusal([&](auto& p) { p.labels.push_back(0); }), start + "it does not have one region for each vertex");
  EXPECT_EQ(refusal([&](auto& p) { p.at.clear(), p.homes.clear(); }), start + "it has no particle");
  EXPECT_EQ(refusal([&](auto& p) { p.rings = vertices + 1; }), start + "it reaches too many hops");
  EXPECT_EQ(refusal([&](auto& p) { p.hop_limit = vertices + 1; }), start + "it reaches too many hops");
  EXPECT_EQ(refusal([&](auto& p) { p.homes[3].vertex = vertices; }),
            start + "a particle has not started on the surface");
  EXPECT_EQ(refusal([&](auto& p) { p.homes[3].compass = vertices; }),
            start + "a particle has not started on the surface");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal([&](auto& p) { p.radius = infinity; }), start + "a number is not finite");
  EXPECT_EQ(refusal([&](auto& p) { p.collision_distance = infinity; }), start + "a number is not finite");
  EXPECT_EQ(refusal([&](auto& p) { p.homes[3].angle = infinity; }), start + "a number is not finite");
  EXPECT_EQ(refusal([&](auto& p) { std::swap(p.at[0], p.at[1]); }), start + "a particle is not in its region");
}

}  // namespace
}  // namespace lodestone
