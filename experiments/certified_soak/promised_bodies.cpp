// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified_soak/promised_bodies.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "certified_soak/rest_shape.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"

namespace lodestone {

namespace {

/// Covers the rounding of what is found out about a motion.
constexpr double a_little_more = 1 + 1e-13;

/// Positions that are written to a list.
class Listed_positions final : public Position_source {
 public:
  explicit Listed_positions(const std::vector<double>& coordinates) : coordinates_(&coordinates) {}

  std::uint32_t vertex_count() const override { return static_cast<std::uint32_t>(coordinates_->size() / 3); }
  std::uint64_t pose_number() const override { return 0; }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override {
    return Eigen::Map<const Eigen::Vector3d>(coordinates_->data() + 3 * std::size_t{vertex});
  }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    for (const auto vertex : vertices)
      Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = (*this)(vertex);
  }
  void pose_all(std::span<double> coordinates) const override { std::ranges::copy(*coordinates_, coordinates.begin()); }
  Coordinates in_memory() const override { return *coordinates_; }

 private:
  const std::vector<double>* coordinates_;
};

/// A mesh whose vertices are moved: by a wave that runs through the body, and by a rigid motion. A detector may place
/// it elsewhere, which no promise says.
class Moved_body : public Random_body {
 public:
  Moved_body(Surface_mesh mesh, const Eigen::Vector3d& centre, Random& random)
      : Random_body(std::move(mesh)),
        centre_(centre),
        rest_(coordinates_of(mesh_)),
        now_(rest_),
        source_(now_),
        wave_(random.vector(3)),
        along_(random.direction()),
        is_placed_(random.one_in(2)) {}

  Object_id add_to(Detector<>& detector) const override { return detector.add(mesh_); }
  const Position_source& positions() const override { return source_; }
  std::unique_ptr<Node_bound> bound(const Bounded_object& /*object*/) const override { return {}; }
  std::optional<Eigen::Isometry3d> placement() const override { return placement_; }

  void move(const Eigen::Vector3d& place, Random& random) override {
    next_motion(place, random);
    const std::vector<double> before = now_;
    for (std::size_t i = 0; i < now_.size(); i += 3) put(i, moved(rest(i)));
    for (const auto v : mesh_.vertices()) {
      const Eigen::Vector3d p = now(3 * std::size_t{v.idx()});
      mesh_.point(v) = Point(p.x(), p.y(), p.z());
    }
    promise(before);
    if (is_placed_) turn_around(place, random);
  }

 protected:
  virtual void next_motion(const Eigen::Vector3d& place, Random& random) {
    phase_ += random.number(0, 0.3);
    amplitude_ = std::clamp(amplitude_ + random.number(-0.02, 0.02), -0.2, 0.2);
    rigid_.linear() = random.turn(0.1) * rigid_.linear();
    rigid_.translation() = place - rigid_.linear() * centre_;
  }
  virtual Eigen::Vector3d moved(const Eigen::Vector3d& rest) const { return rigid_ * waved(rest); }
  /// Says what is true of the motion from an earlier pose, or from rest, to the present one.
  virtual void promise(const std::vector<double>& /*before*/) {}

  Eigen::Vector3d waved(const Eigen::Vector3d& rest) const {
    return rest + amplitude_ * std::sin(wave_.dot(rest - centre_) + phase_) * along_;
  }
  static Eigen::Vector3d at(const std::vector<double>& coordinates, std::size_t i) {
    return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + i);
  }
  Eigen::Vector3d rest(std::size_t i) const { return at(rest_, i); }
  Eigen::Vector3d now(std::size_t i) const { return at(now_, i); }

  Eigen::Vector3d centre_;
  std::vector<double> rest_, now_;  ///< 3 V
  Listed_positions source_;
  Eigen::Vector3d wave_, along_;
  double amplitude_ = 0, phase_ = 0;
  Eigen::Isometry3d rigid_ = Eigen::Isometry3d::Identity();

 private:
  void put(std::size_t i, const Eigen::Vector3d& p) { Eigen::Map<Eigen::Vector3d>(now_.data() + i) = p; }
  void turn_around(const Eigen::Vector3d& place, Random& random) {
    const Eigen::Matrix3d turn = random.turn(0.5);
    placement_ = Eigen::Isometry3d(Eigen::Translation3d(place - turn * place));
    placement_->linear() = turn;
  }

  bool is_placed_;
  std::optional<Eigen::Isometry3d> placement_;
};

/// A body with a promise of its own.
template <class Promise>
class Promised_body : public Moved_body {
 public:
  using Moved_body::Moved_body;

  void promise_to(Detector<>& detector, Object_id id) const override { detector.promise(id, promise_); }
  std::unique_ptr<Node_bound> bound(const Bounded_object& object) const override {
    return std::make_unique<Node_bound_of<decltype(promise_.bound(object))>>(promise_.bound(object));
  }

 protected:
  Promise promise_;
};

class Displaced_body final : public Promised_body<Displacement_promise> {
 public:
  using Promised_body::Promised_body;

 protected:
  void promise(const std::vector<double>& before) override {
    double farthest = 0;
    for (std::size_t i = 0; i < now_.size(); i += 3) farthest = std::max(farthest, (now(i) - at(before, i)).norm());
    promise_.move(farthest * a_little_more);
  }
};

/// Only what is left once the rigid motion has been taken away is promised.
class Body_displaced_in_frame final : public Promised_body<Displacement_promise> {
 public:
  Body_displaced_in_frame(Surface_mesh mesh, const Eigen::Vector3d& centre, Random& random)
      : Promised_body(std::move(mesh), centre, random), in_frame_(rest_) {}

 protected:
  void promise(const std::vector<double>& /*before*/) override {
    double farthest = 0;
    for (std::size_t i = 0; i < in_frame_.size(); i += 3) {
      const Eigen::Vector3d q = waved(rest(i));
      farthest = std::max(farthest, (q - at(in_frame_, i)).norm());
      Eigen::Map<Eigen::Vector3d>(in_frame_.data() + i) = q;
    }
    promise_.move(farthest * a_little_more, rigid_);
  }

 private:
  std::vector<double> in_frame_;  ///< 3 V
};

class Stretched_body final : public Promised_body<Stretch_promise> {
 public:
  using Promised_body::Promised_body;

  bool can_be_rebuilt() const override { return false; }

 protected:
  void promise(const std::vector<double>& /*before*/) override {
    double most = 0;
    for (const auto edge : mesh_.edges()) {
      const std::size_t from = 3 * mesh_.vertex(edge, 0).idx(), to = 3 * mesh_.vertex(edge, 1).idx();
      most = std::max(most, (now(from) - now(to)).norm() / (rest(from) - rest(to)).norm());
    }
    promise_.set_stretch(most * a_little_more);
  }
};

/// The derivative of a wave is at most its amplitude times its wave vector.
class Lipschitz_body final : public Promised_body<Lipschitz_promise> {
 public:
  using Promised_body::Promised_body;

  bool can_be_rebuilt() const override { return false; }

 protected:
  void promise(const std::vector<double>& /*before*/) override {
    double largest = 1;
    for (const auto* list : {&rest_, &now_})
      for (const double x : *list) largest = std::max(largest, std::abs(x));
    constexpr double roundings = 1e-13;
    promise_.set_constant(1 + std::abs(amplitude_) * wave_.norm() * a_little_more, roundings * largest);
  }
};

/// Scales along the axes, and tells where a box goes: rounding keeps the order of numbers.
class Boxed_body final : public Moved_body {
 public:
  using Moved_body::Moved_body;

  void promise_to(Detector<>& detector, Object_id id) const override { detector.promise(id, promise_); }
  std::unique_ptr<Node_bound> bound(const Bounded_object& object) const override {
    return std::make_unique<Node_bound_of<Promised_boxes>>(promise_.bound(object));
  }
  bool can_be_rebuilt() const override { return false; }

 protected:
  void next_motion(const Eigen::Vector3d& place, Random& random) override {
    for (double& factor : scale_) {
      const double size = random.number(0.3, 1.5);
      factor = random.one_in(4) ? -size : size;
    }
    shift_ = place - scale_.cwiseProduct(centre_);
  }
  Eigen::Vector3d moved(const Eigen::Vector3d& rest) const override { return scale_.cwiseProduct(rest) + shift_; }

 private:
  Aabb box_now(const Aabb& rest_box) const {
    const Eigen::Vector3d low = moved(Eigen::Map<const Eigen::Vector3d>(rest_box.low)),
                          high = moved(Eigen::Map<const Eigen::Vector3d>(rest_box.high));
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(low[axis], high[axis]);
      box.high[axis] = std::max(low[axis], high[axis]);
    }
    return box;
  }

  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones(), shift_ = Eigen::Vector3d::Zero();
  Box_promise promise_{[this](Region_index, const Aabb& rest_box) { return box_now(rest_box); }};
};

template <class Body>
std::unique_ptr<Random_body> make_moved(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return std::make_unique<Body>(random_ellipsoid(centre, frequency, false, random), centre, random);
}

}  // namespace

std::unique_ptr<Random_body> make_displaced(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return make_moved<Displaced_body>(centre, frequency, random);
}
std::unique_ptr<Random_body> make_displaced_in_frame(const Eigen::Vector3d& centre, std::size_t frequency,
                                                     Random& random) {
  return make_moved<Body_displaced_in_frame>(centre, frequency, random);
}
std::unique_ptr<Random_body> make_stretched(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return make_moved<Stretched_body>(centre, frequency, random);
}
std::unique_ptr<Random_body> make_lipschitz(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return make_moved<Lipschitz_body>(centre, frequency, random);
}
std::unique_ptr<Random_body> make_boxed(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return make_moved<Boxed_body>(centre, frequency, random);
}
std::unique_ptr<Random_body> make_unbounded(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return make_moved<Moved_body>(centre, frequency, random);
}

}  // namespace lodestone
