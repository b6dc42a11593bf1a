// SPDX-License-Identifier: GPL-3.0-or-later
// Embree: one scene of user-defined primitives per object, refitted or rebuilt, and `rtcCollide`.
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "lodestone/triangles/triangle_intersection.h"
#include "peers/peer.h"

namespace lodestone {

namespace {

/// The largest number of threads in the tables.
constexpr std::size_t most_threads = 2;

/// A float that is not above, or not below, a double, so that Embree's boxes enclose the exact ones.
float rounded_down(double x) {
  const auto near = static_cast<float>(x);
  return near - std::abs(near) * std::numeric_limits<float>::epsilon() - std::numeric_limits<float>::min();
}
float rounded_up(double x) { return -rounded_down(-x); }

Triangle triangle(const Moving_mesh& mesh, std::uint32_t face) {
  const auto points = mesh.points();
  const auto& [p, q, r] = mesh.corners[face];
  return {points[p], points[q], points[r]};
}

/// Embree reports pairs of leaves. The exact boxes of half of them are apart.
bool boxes_meet(const Triangle& a, const Triangle& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low_a, high_a] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [low_b, high_b] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    if (high_a < low_b || high_b < low_a) return false;
  }
  return true;
}

/// Bounds of one triangle, for Embree.
void bound(const RTCBoundsFunctionArguments* arguments) {
  const auto& mesh = *static_cast<const Moving_mesh*>(arguments->geometryUserPtr);
  const double* coordinates = mesh.coordinates().data();
  const auto& [p, q, r] = mesh.corners[arguments->primID];
  const double *a = coordinates + 3 * std::size_t{p}, *b = coordinates + 3 * std::size_t{q},
               *c = coordinates + 3 * std::size_t{r};
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = rounded_down(std::min({a[0], b[0], c[0]}));
  bounds.lower_y = rounded_down(std::min({a[1], b[1], c[1]}));
  bounds.lower_z = rounded_down(std::min({a[2], b[2], c[2]}));
  bounds.upper_x = rounded_up(std::max({a[0], b[0], c[0]}));
  bounds.upper_y = rounded_up(std::max({a[1], b[1], c[1]}));
  bounds.upper_z = rounded_up(std::max({a[2], b[2], c[2]}));
}

/// The state of one query. Several threads call its callback at once.
struct Query {
  const Moving_mesh *a, *b;
  bool stop_at_one;
  std::atomic<bool> found_one = false;
  std::array<std::vector<Face_pair>, most_threads> found = {};  ///< per thread
};

/// Decides the pairs of triangles that Embree reports. Embree cannot be stopped, so a yes-or-no query ignores what
/// comes after the first hit.
void decide(void* user, RTCCollision* pairs, unsigned count) {
  auto& query = *static_cast<Query*>(user);
  if (query.stop_at_one && query.found_one.load(std::memory_order_relaxed)) return;
  const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
  for (const RTCCollision* pair = pairs; pair != pairs + count; ++pair) {
    const Triangle a = triangle(*query.a, pair->primID0), b = triangle(*query.b, pair->primID1);
    if (!boxes_meet(a, b) || !triangles_intersect(a, b)) continue;
    if (query.stop_at_one) {
      query.found_one.store(true, std::memory_order_relaxed);
      return;
    }
    query.found.at(thread).push_back({pair->primID0, pair->primID1});
  }
}

/// @tparam quality  of the hierarchy over a geometry, which decides whether it is refitted
/// @tparam built    how well scenes are built
template <RTCBuildQuality quality, std::size_t threads, RTCBuildQuality built = RTC_BUILD_QUALITY_LOW>
class Embree_peer : public Peer {
 public:
  Embree_peer() : device_(rtcNewDevice(fmt::format("threads={}", most_threads).c_str())) {
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
  }
  ~Embree_peer() override {
    for (const auto& object : objects_) {
      rtcReleaseGeometry(object->geometry);
      rtcReleaseScene(object->scene);
    }
    rtcReleaseDevice(device_);
  }

  /// What Embree reports, because it allocates large blocks past the heap.
  std::optional<std::size_t> bytes() const override { return static_cast<std::size_t>(bytes_.load()); }

  void add(const Moving_mesh& mesh) override {
    auto& object = *objects_.emplace_back(std::make_unique<Object>());
    object = {mesh, rtcNewScene(device_), rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER)};
    rtcSetGeometryUserPrimitiveCount(object.geometry, static_cast<unsigned>(mesh.corners.size()));
    rtcSetGeometryUserData(object.geometry, &object.mesh);
    rtcSetGeometryBoundsFunction(object.geometry, bound, nullptr);
    rtcSetGeometryBuildQuality(object.geometry, quality);
    rtcAttachGeometry(object.scene, object.geometry);
    rtcSetSceneFlags(object.scene, built == RTC_BUILD_QUALITY_LOW ? RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(object.scene, built);
    update(objects_.size() - 1);
  }

  void update(std::size_t object) override {
    arena_.execute([&] {
      rtcCommitGeometry(objects_[object]->geometry);
      rtcCommitScene(objects_[object]->scene);
    });
  }

  bool any(std::size_t a, std::size_t b) override {
    Query query{&objects_[a]->mesh, &objects_[b]->mesh, true};
    arena_.execute([&] { rtcCollide(objects_[a]->scene, objects_[b]->scene, decide, &query); });
    return query.found_one;
  }

  void all(std::size_t a, std::size_t b, std::vector<Face_pair>& found) override {
    Query query{&objects_[a]->mesh, &objects_[b]->mesh, false};
    arena_.execute([&] { rtcCollide(objects_[a]->scene, objects_[b]->scene, decide, &query); });
    for (const auto& part : query.found) found.insert(found.end(), part.begin(), part.end());
  }

 private:
  struct Object {
    Moving_mesh mesh;
    RTCScene scene;
    RTCGeometry geometry;
  };

  static bool count_bytes(void* count, ssize_t bytes, bool /*done*/) {
    *static_cast<std::atomic<ssize_t>*>(count) += bytes;
    return true;
  }

  std::atomic<ssize_t> bytes_ = 0;
  RTCDevice device_;
  /// Embree has one number of threads for all devices. A call within an arena uses only the arena's threads.
  tbb::task_arena arena_{static_cast<int>(threads)};
  std::vector<std::unique_ptr<Object>> objects_;
};

template <RTCBuildQuality quality, std::size_t threads, RTCBuildQuality built = RTC_BUILD_QUALITY_LOW>
Peer_kind kind(const char* method) {
  return {.entry = {.library = "Embree",
                    .method = threads == 1 ? method : fmt::format("{}, {} threads", method, threads),
                    .volume = "AABB",
                    .threads = threads},
          .make = []() -> std::unique_ptr<Peer> { return std::make_unique<Embree_peer<quality, threads, built>>(); }};
}

}  // namespace

std::vector<Peer_kind> embree_peers() {
  return {kind<RTC_BUILD_QUALITY_REFIT, 1>("refit"), kind<RTC_BUILD_QUALITY_LOW, 1>("rebuild"),
          kind<RTC_BUILD_QUALITY_REFIT, most_threads>("refit"), kind<RTC_BUILD_QUALITY_LOW, most_threads>("rebuild")};
}

Peer_kind embree_built_well() {
  return kind<RTC_BUILD_QUALITY_HIGH, 1, RTC_BUILD_QUALITY_HIGH>("rebuild, high quality");
}

}  // namespace lodestone
