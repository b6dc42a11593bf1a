// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/detector_play.h"

#include <algorithm>
#include <limits>

#include "fuzz/detector_truth.h"

namespace lodestone::fuzz {

namespace {

constexpr std::size_t most_objects = 5;
constexpr std::size_t most_acts = 24;

double draw_distance(Byte_source& bytes) {
  constexpr double usual[] = {0, 0.5, 1, 0.1, 1e-300, 1e300};
  const auto choice = bytes.below(8);
  return choice < 6 ? usual[choice] : std::abs(bytes.coordinate());
}

void draw_exact_options(Byte_source& bytes, Detector_options& options) {
  Exact_options& exact = options.exact;
  if (bytes.below(4) == 0) exact.tolerance = draw_distance(bytes);
  const auto asked = bytes.byte();
  exact.self_collision = (asked & 1U) != 0;
  exact.containment = asked % 16 == 2;
  exact.parting = asked % 16 == 4;
  exact.patches = asked % 16 == 6;
  options.tree.leaf_faces = 2 + bytes.below(16);
}

/// Mostly all objects meet.
Collision_groups draw_groups(Byte_source& bytes) {
  const auto choice = bytes.byte();
  if (choice < 224) return {};
  return {.groups = choice & 3U, .meets = (choice >> 2U) & 7U};
}

}  // namespace

Detector_options draw_options(Byte_source& bytes) {
  constexpr Mode modes[] = {Mode::exact,     Mode::exact,     Mode::exact,     Mode::exact,
                            Mode::certified, Mode::certified, Mode::particles, Mode::senin};
  Detector_options options{.mode = modes[bytes.below(8)]};
  options.particles = bytes.below(4);
  const std::size_t least_particles = 1 + bytes.below(4);
  if (!finds_all(options.mode)) options.least_particles = least_particles;
  options.threads = 1 + bytes.below(2);
  if (bytes.below(8) == 0) options.most_contacts = 1 + bytes.below(8);
  const auto contacts = bytes.below(16);
  if (contacts == 0) options.contacts = Contact_query::first;
  if (contacts == 1) options.contacts = Contact_query::yes_no;
  options.contact_points = contacts == 2;
  options.contact_normals = contacts == 3;
  if (options.mode == Mode::particles) options.meetings = bytes.below(3);
  if (finds_all(options.mode)) draw_exact_options(bytes, options);
  if (options.exact.patches && options.contacts == Contact_query::yes_no) options.exact.patches = false;
  return options;
}

void Detector_play::run(Byte_source& bytes) {
  add(bytes);
  for (std::size_t i = 0; i < most_acts && !bytes.empty(); ++i) act(bytes);
  detect();
}

void Detector_play::act(Byte_source& bytes) {
  const auto choice = bytes.byte();
  if (choice >= 248) return place(bytes);
  if (choice >= 240) return give(bytes);
  switch (choice % 12) {
    case 0:
    case 1:
      return add(bytes);
    case 2:
      return remove(bytes);
    case 3:
      return rebuild(bytes);
    case 4:
      return ignore(bytes);
    case 5:
      return save_and_load(bytes);
    case 6:
      return query(bytes);
    case 7:
    case 8:
      return detect();
    case 9:
      return detect_without_a_number(bytes);
    case 10:
      return collapse_face(bytes, objects_[one_of(bytes)]);
    default:
      return move_vertices(bytes, objects_[one_of(bytes)], objects_[one_of(bytes)]);
  }
}

void Detector_play::add(Byte_source& bytes) {
  if (present() == most_objects) return;
  auto& object = objects_.emplace_back();
  draw_object(bytes, object);
  const auto groups = draw_groups(bytes);
  groups_.push_back(groups);
  const Object_id id =
      detector_.add(std::as_const(*object.mesh), Object_options{.groups = groups.groups, .meets = groups.meets});
  object.is_promised = options_.mode == Mode::certified && bytes.flag();
  if (object.is_promised) detector_.promise(id, object.promise);
}

void Detector_play::remove(Byte_source& bytes) {
  if (present() < 2) return;
  const auto object = one_of(bytes);
  detector_.remove(object);
  objects_[object].is_removed = true;
}

void Detector_play::rebuild(Byte_source& bytes) {
  const auto object = one_of(bytes);
  const auto changed = change_faces(bytes, objects_[object]);
  if (bytes.flag())
    detector_.rebuild(object, Changed_faces{changed});
  else
    detector_.rebuild(object);
}

void Detector_play::ignore(Byte_source& bytes) {
  const auto [a, b] = std::minmax({one_of(bytes), one_of(bytes)});
  const bool ignored = bytes.flag();
  detector_.ignore(a, b, ignored);
  if (ignored)
    ignored_.insert({a, b});
  else
    ignored_.erase({a, b});
}

void Detector_play::save_and_load(Byte_source& bytes) {
  const auto object = one_of(bytes);
  std::vector<std::byte> saved;
  if (!accepts([&] { saved = detector_.save(object); })) return;
  require(accepts([&] { detector_.load(object, saved); }), "an object that was saved is refused");
}

/// An object whose motion is promised is not placed: the promise is about where its vertices are.
void Detector_play::place(Byte_source& bytes) {
  const auto id = one_of(bytes);
  auto& object = objects_[id];
  const auto placement = draw_placement(bytes);
  if (object.is_promised || !object.change(object.coordinates, object.given, placement)) return;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (placement) motion.linear() = placement->rotation(), motion.translation() = placement->translation();
  detector_.place(id, motion);
}

/// Gives an object coordinates in place of those of its mesh, or ends that.
void Detector_play::give(Byte_source& bytes) {
  const auto id = one_of(bytes);
  auto& object = objects_[id];
  if (options_.mode != Mode::exact || bytes.flag()) {
    if (accepts([&] { detector_.update(id); })) object.change(object.coordinates, {}, object.placement);
    return;
  }
  auto given = object.coordinates;
  const double step = bytes.coordinate();
  for (std::size_t i = bytes.below(3); i < given.size(); i += 3) given[i] += step;
  if (object.change(object.coordinates, given, object.placement))
    detector_.update(id, Eigen::Map<const Positions>(given.data(), static_cast<Eigen::Index>(object.vertices()), 3));
}

/// A coordinate that is no number must be refused where a face uses it, and harm nothing.
void Detector_play::detect_without_a_number(Byte_source& bytes) {
  auto& object = objects_[one_of(bytes)];
  double& coordinate = object.coordinates[bytes.below(std::min<std::size_t>(object.coordinates.size(), 256))];
  const double kept = coordinate;
  coordinate = bytes.flag() ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  accepts([&] { detector_.detect(); });
  coordinate = kept;
}

void Detector_play::query(Byte_source& bytes) {
  if (!finds_all(options_.mode)) return;
  const auto a = one_of(bytes), b = one_of(bytes);
  if (a != b)
    query_two(bytes, a, b);
  else
    query_one(bytes, a);
}

void Detector_play::query_two(Byte_source& bytes, Object_id a, Object_id b) {
  const auto& object_a = objects_[a];
  const auto& object_b = objects_[b];
  const double distance = draw_distance(bytes);
  require(detector_.within(a, b, distance) == !true_contacts(object_a, object_b, distance).empty(), "within is wrong");
  const bool collide = !true_contacts(object_a, object_b, 0).empty();
  require((detector_.closest(a, b).points.distance == 0) == collide, "closest is wrong");
  std::vector<Face_pair> seen;
  detector_.visit(a, b, [&](Face_pair pair) {
    seen.push_back(pair);
    return Visit::go_on;
  });
  std::ranges::sort(seen);
  require(seen == true_contacts(object_a, object_b, options_.exact.tolerance), "visit is wrong");
  accepts([&] { detector_.contains(a, b); });
  accepts([&] { detector_.parting(a, b); });
}

void Detector_play::query_one(Byte_source& bytes, Object_id object) {
  const auto point = [&] { return Eigen::Vector3d(bytes.coordinate(), bytes.coordinate(), bytes.coordinate()); };
  const Ray ray{.origin = point(), .direction = point()};
  accepts([&] {
    const auto first = detector_.first_hit(object, ray);
    const auto all = detector_.all_hits(object, ray);
    require(first.has_value() == !all.empty(), "first_hit and all_hits differ");
    if (first) require(first->face == all.front().face, "first_hit is not the first of all hits");
    const auto of_tree = first_hit(detector_.ray_tree(object), ray);
    require(of_tree.has_value() == first.has_value(), "a Ray_tree has another answer");
    if (first) require(of_tree->face == first->face && of_tree->t == first->t, "a Ray_tree has another first hit");
    query_all(ray);
  });
  const auto p = point();
  accepts([&] { detector_.closest_point(object, Point(p.x(), p.y(), p.z())); });
  accepts([&] { detector_.point_side(object, Point(p.x(), p.y(), p.z())); });
}

/// The first object that a ray meets: none of the others comes before it, nor one with a lower id with it.
void Detector_play::query_all(const Ray& ray) {
  const auto first = detector_.first_hit(ray);
  for (Object_id object = 0; object < objects_.size(); ++object) {
    const auto hit = detector_.has(object) ? detector_.first_hit(object, ray) : std::nullopt;
    if (!hit) continue;
    require(first.has_value(), "a ray that meets an object meets none");
    const Triangle met = objects_[object].triangle(hit->face);
    const Triangle first_met = objects_[first->object].triangle(first->hit.face);
    if (object == first->object)
      require(hit->face == first->hit.face, "among all objects, another face is first");
    else if (object < first->object)
      require(meets_before(ray, first_met, met), "an object with a lower id is met as soon");
    else
      require(!meets_before(ray, met, first_met), "another object is met before");
  }
}

void Detector_play::detect() {
  const Frame* frame = nullptr;
  // Finite coordinates are refused only by particles, and only if they are huge.
  if (finds_all(options_.mode))
    frame = &detector_.detect();
  else if (!accepts([&] { frame = &detector_.detect(); }))
    return;
  check_lists(*frame, options_);
  for (Object_id a = 0; a < objects_.size(); ++a)
    for (Object_id b = a; b < objects_.size(); ++b)
      check_pair(*frame, options_, {a, b}, objects_[a], objects_[b], may_collide(a, b));
}

Object_id Detector_play::one_of(Byte_source& bytes) const {
  auto left = bytes.below(present());
  Object_id id = 0;
  while (objects_[id].is_removed || left-- > 0) ++id;
  return id;
}

bool Detector_play::may_collide(Object_id a, Object_id b) const {
  if (objects_[a].is_removed || objects_[b].is_removed || ignored_.contains({a, b})) return false;
  return meet(groups_[a], groups_[b]) && (a != b || options_.exact.self_collision);
}

std::size_t Detector_play::present() const {
  return static_cast<std::size_t>(std::ranges::count(objects_, false, &Drawn_object::is_removed));
}

}  // namespace lodestone::fuzz
