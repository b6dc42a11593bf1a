// SPDX-License-Identifier: GPL-3.0-or-later
// Compares mode certified with mode exact, and bounds with positions, on small bodies that move at random.
#include "certified_soak/certified_soak.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "certified_soak/bound_check.h"
#include "certified_soak/promised_bodies.h"
#include "certified_soak/random_body.h"
#include "certified_soak/two_detectors.h"

namespace lodestone {

namespace {

constexpr std::size_t frames_per_round = 24;

/// Of any size up to 1/256: the pairs within a larger one would take most of the time.
double random_tolerance(Random& random) {
  const double mantissa = random.number(0.5, 1);
  return std::ldexp(mantissa, -8 - static_cast<int>(random.below(22)));
}

Detector_options random_options(Random& random) {
  Detector_options options;
  options.contacts = random.one_in(3)   ? Contact_query::yes_no
                     : random.one_in(3) ? Contact_query::first
                                        : Contact_query::all;
  const bool lists = options.contacts != Contact_query::yes_no;
  options.contact_points = lists && random.one_in(5);
  options.exact.patches = lists && random.one_in(8);
  if (random.one_in(8)) options.particles = 1 + random.below(6);
  if (random.one_in(8)) options.most_contacts = 1 + random.below(20);
  options.exact.tolerance = random.one_in(3) ? random_tolerance(random) : 0;
  options.exact.self_collision = random.one_in(8);
  options.exact.self_tolerance = options.exact.self_collision && random.one_in(3) ? random_tolerance(random) : 0;
  options.exact.containment = random.one_in(4);
  options.exact.parting = random.one_in(16);
  options.threads = random.one_in(8) ? 3 : 1;
  options.exact.throw_if_broken = random.one_in(4);
  options.tree.leaf_faces = 2 + random.below(100);
  return options;
}

/// A scene that is played.
class Round {
 public:
  Round(const Body_recipe& recipe, Random& random)
      : random_(random),
        origin_(random.one_in(4) ? Eigen::Vector3d(std::ldexp(1, static_cast<int>(random.below(24))), 0, 0)
                                 : Eigen::Vector3d::Zero()),
        options_(random_options(random)),
        detectors_(options_) {
    add_body(recipe.make(origin_, frequency(), random_));
    for (std::size_t others = random_.one_in(3) ? 2 : 1; others > 0; --others) {
      const auto recipes = body_recipes();
      const std::size_t kind = random_.below(recipes.size() + 1);
      ways_.push_back({random_.direction(), random_.number(1, 3)});
      add_body(
          (kind < recipes.size() ? recipes[kind].make : make_unbounded)(place(ways_.size()), frequency(), random_));
    }
  }

  void play(Certified_soak_kind& kind) {
    ++kind.rounds;
    try {
      play_frames(kind);
    } catch (const Broken_bound&) {  // if the options ask for it
      ++kind.violations;
    }
  }

 private:
  void play_frames(Certified_soak_kind& kind) {
    for (std::size_t frame = 0; frame < frames_per_round; ++frame) {
      if (frame > 0) move();
      const bool gives = random_.one_in(16);
      const Object_id given = gives ? give_positions() : 0;
      const auto check = detectors_.detect();
      ++kind.frames;
      kind.colliding += check.collides ? 1 : 0;
      kind.differences += check.same ? 0 : 1;
      kind.partly_read += is_partly_read() ? 1 : 0;
      const std::size_t of_frame = detectors_.violations();
      ++kind.questions;
      kind.differences += ask() ? 0 : 1;
      kind.violations += std::max(of_frame, detectors_.violations());  // a question may count from 0
      if (gives) detectors_.both([&](Detector<>& detector) { detector.update(given); });
      for (const auto& check_of_bound : checks_) {
        const auto count = check_of_bound->check(random_);
        kind.boxes += count.boxes;
        kind.outside += count.outside;
        kind.refused += count.refused;
      }
      follow(check.meets_first);
      if (random_.one_in(30)) build_anew();
    }
  }

  /// From the first body to another.
  struct Way {
    Eigen::Vector3d direction;
    double distance;
    double step = 0.3;  ///< of the next frame
    bool inwards = true;
  };

  /// Bounds of small bodies are soon given up, those of large ones mostly last.
  std::size_t frequency() {
    return random_.one_in(2)   ? 1 + random_.below(4)
           : random_.one_in(3) ? 17 + random_.below(16)
                               : 5 + random_.below(12);
  }
  Eigen::Vector3d place(std::size_t body) const {
    if (body == 0) return origin_;
    const Way& way = ways_[body - 1];
    return origin_ + way.distance * way.direction;
  }
  void add_body(std::unique_ptr<Random_body> body) {
    detectors_.add(*body);
    checks_.push_back(std::make_unique<Bound_check>(*body, options_.tree.leaf_faces));
    bodies_.push_back(std::move(body));
  }
  void move() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (random_.one_in(8)) continue;
      bodies_[i]->move(place(i), random_);
      if (const auto placement = bodies_[i]->placement())
        detectors_.both([&](Detector<>& detector) { detector.place(static_cast<Object_id>(i), *placement); });
    }
  }
  /// Keeps the bodies where they just touch, or just do not: steps become shorter where they overshoot.
  /// @param meets_first  per body
  void follow(const std::vector<bool>& meets_first) {
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      Way& way = ways_[i];
      const bool collide = meets_first[i + 1];
      way.step = std::clamp(way.step * (way.inwards == collide ? 0.5 : 1.5), 0.01, 0.3);
      way.inwards = !collide;
      way.distance = std::max(0.0, way.distance + (collide ? 1 : -1) * way.step * random_.number(0, 1));
    }
  }
  /// Gives a body the positions that it has, for one frame.
  Object_id give_positions() {
    const auto id = static_cast<Object_id>(random_.below(bodies_.size()));
    const Position_source& source = bodies_[id]->positions();
    Positions positions(source.vertex_count(), 3);
    source.pose_all({positions.data(), static_cast<std::size_t>(positions.size())});
    detectors_.both([&](Detector<>& detector) { detector.update(id, positions); });
    return id;
  }
  void build_anew() {
    const auto id = static_cast<Object_id>(random_.below(bodies_.size()));
    if (!bodies_[id]->can_be_rebuilt()) return;
    const bool load = random_.one_in(2);
    detectors_.both([&](Detector<>& detector) {
      if (load)
        detector.load(id, detector.save(id));
      else
        detector.rebuild(id);
    });
  }
  bool is_partly_read() {
    const Bounded_surface* surface = detectors_.certified().bounded(0);
    return surface != nullptr && surface->leaves_posed() < surface->layout().leaf_count();
  }

  /// Asks both detectors a random question about the first two bodies.
  /// @return whether they agree
  bool ask() {
    const Eigen::Vector3d from = origin_ + random_.vector(3), to = random_.direction();
    const double distance = random_.number(0, 1);
    const Ray ray{.origin = from, .direction = to};
    const Point point(from.x(), from.y(), from.z());
    switch (random_.below(10)) {
      case 0:
        return closest_agree();
      case 1:
        return detectors_.agree([&](Detector<>& d) { return d.within(0, 1, distance); });
      case 2:
        return detectors_.agree([&](Detector<>& d) { return std::pair(d.contains(0, 1), d.contains(1, 0)); });
      case 3:
        return detectors_.agree([&](Detector<>& d) { return faces_of(d.first_hit(0, ray)); });
      case 4:
        return detectors_.agree([&](Detector<>& d) { return faces_of(d.all_hits(0, ray)); });
      case 5:
        return detectors_.agree([&](Detector<>& d) { return d.closest_point(0, point).face; });
      case 6:
        return detectors_.agree([&](Detector<>& d) { return d.point_side(0, point); });
      case 7:
        return detectors_.agree([&](Detector<>& d) { return faces_of(d.first_hits(0, rays_through(from))); });
      case 8:
        return detectors_.agree([&](Detector<>& d) { return faces_of(d.first_hits(rays_through(from))); });
      default:
        return detectors_.agree([&](Detector<>& d) { return visited(d); });
    }
  }

  /// Both may choose among faces at nearly the same distance.
  bool closest_agree() {
    std::array<double, 2> distances{};
    std::size_t i = 0;
    detectors_.both([&](Detector<>& d) { distances[i++] = d.closest(0, 1).points.distance; });
    return std::abs(distances[0] - distances[1]) <= 0x1p-29 * distances[0];
  }
  static std::vector<std::uint32_t> faces_of(const std::optional<Ray_hit>& hit) {
    return hit ? std::vector{hit->face} : std::vector<std::uint32_t>();
  }
  static std::vector<std::uint32_t> faces_of(const std::vector<Ray_hit>& hits) {
    std::vector<std::uint32_t> faces;
    for (const auto& hit : hits) faces.push_back(hit.face);
    return faces;
  }
  static std::vector<std::vector<std::uint32_t>> faces_of(const std::vector<std::optional<Ray_hit>>& hits) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (const auto& hit : hits) faces.push_back(faces_of(hit));
    return faces;
  }
  static std::vector<Face_pair> faces_of(const std::vector<std::optional<Object_hit>>& hits) {
    std::vector<Face_pair> objects_and_faces;
    for (const auto& hit : hits)
      if (hit) objects_and_faces.push_back({hit->object, hit->hit.face});
    return objects_and_faces;
  }
  /// The same for both detectors, in all directions.
  static std::vector<Ray> rays_through(const Eigen::Vector3d& point) {
    std::vector<Ray> rays;
    for (const double x : {-1.0, 0.3, 1.0})
      for (const double y : {-0.7, 0.1, 1.0})
        for (const double z : {-1.0, 0.2, 0.6})
          rays.push_back({.origin = point - 5 * Eigen::Vector3d(x, y, z), .direction = {x, y, z}});
    return rays;
  }
  static std::vector<Face_pair> visited(Detector<>& detector) {
    std::vector<Face_pair> faces;
    detector.visit(0, 1, [&](const Face_pair& contact) {
      faces.push_back(contact);
      return Visit::go_on;
    });
    std::ranges::sort(faces);
    return faces;
  }

  Random& random_;
  Eigen::Vector3d origin_;
  Detector_options options_;
  std::vector<Way> ways_;
  std::vector<std::unique_ptr<Random_body>> bodies_;
  std::vector<std::unique_ptr<Bound_check>> checks_;
  Two_detectors detectors_;
};

}  // namespace

std::size_t certified_soak_kinds() { return body_recipes().size(); }
std::string_view certified_soak_name(std::size_t kind) { return body_recipes()[kind].name; }

Certified_soak_kind certified_soak(std::uint64_t seed, std::size_t kind, std::size_t frames,
                                   const std::function<void(std::size_t)>& progress) {
  return certified_soak(seed * certified_soak_kinds() + kind, body_recipes()[kind], frames, progress);
}

Certified_soak_kind certified_soak(std::uint64_t seed, const Body_recipe& recipe, std::size_t frames,
                                   const std::function<void(std::size_t)>& progress) {
  Certified_soak_kind kind{.name = recipe.name};
  Random random(seed);
  while (kind.frames < frames) {
    Round(recipe, random).play(kind);
    if (progress) progress(std::min(kind.frames, frames));
  }
  return kind;
}

}  // namespace lodestone
