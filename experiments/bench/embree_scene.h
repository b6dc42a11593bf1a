// SPDX-License-Identifier: GPL-3.0-or-later
// Embree, asked about the faces of a mesh. Only where the peers are built.
#pragma once

#ifdef LODESTONE_EMBREE

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bench/wavy_sphere.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/queries/ray_search.h"

namespace lodestone {

enum class Embree_kind { triangles, exact_numbers };

/// Of a point from a triangle with the corners a, b and c, by the regions of \cite ericson2005.
inline double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, bc = c - b;
  const double along_ab = ab.dot(p - a), along_ac = ac.dot(p - a), past_ab = ab.dot(p - b), beside_b = ac.dot(p - b),
               beside_c = ab.dot(p - c), past_ac = ac.dot(p - c);
  const auto from = [&](const Eigen::Vector3d& q) { return (p - q).squaredNorm(); };
  if (along_ab <= 0 && along_ac <= 0) return from(a);
  if (past_ab >= 0 && beside_b <= past_ab) return from(b);
  if (past_ac >= 0 && beside_c <= past_ac) return from(c);
  const double of_c = along_ab * beside_b - past_ab * along_ac, of_b = beside_c * along_ac - along_ab * past_ac,
               of_a = past_ab * past_ac - beside_c * beside_b;
  if (of_c <= 0 && along_ab >= 0 && past_ab <= 0) return from(a + along_ab / (along_ab - past_ab) * ab);
  if (of_b <= 0 && along_ac >= 0 && past_ac <= 0) return from(a + along_ac / (along_ac - past_ac) * ac);
  const double along_bc = beside_b - past_ab, back_along_bc = beside_c - past_ac;
  if (of_a <= 0 && along_bc >= 0 && back_along_bc >= 0) return from(b + along_bc / (along_bc + back_along_bc) * bc);
  return from(a + of_b / (of_a + of_b + of_c) * ab + of_c / (of_a + of_b + of_c) * ac);
}

/// Faces as Embree takes them: triangles in float, with the flag `robust`; or primitives of ours, boxed in float and
/// tested in double.
class Embree_scene {
 public:
  /// @param coordinates  read by every `refit`
  Embree_scene(Embree_kind kind, std::span<const Corners> corners, Coordinates coordinates)
      : corners_(corners), coordinates_(coordinates), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    const bool in_float = kind == Embree_kind::triangles;
    geometry_ = rtcNewGeometry(device_, in_float ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_USER);
    if (in_float) {
      auto* const indices = static_cast<std::uint32_t*>(
          rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, corners.size()));
      for (std::size_t i = 0; i < 3 * corners.size(); ++i) indices[i] = corners[i / 3][i % 3];
      vertices_ = static_cast<float*>(
          rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, coordinates.size() / 3));
    } else {
      rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(corners.size()));
      rtcSetGeometryUserData(geometry_, this);
      rtcSetGeometryBoundsFunction(geometry_, bound, nullptr);
      rtcSetGeometryIntersectFunction(geometry_, intersect);
    }
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
    rtcAttachGeometry(scene_, geometry_);
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);  // otherwise the quality of a geometry is ignored
    refit();
  }
  ~Embree_scene() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree_scene(const Embree_scene&) = delete;

  void refit() {
    if (vertices_ != nullptr) {
      std::ranges::transform(coordinates_, vertices_, [](double x) { return static_cast<float>(x); });
      rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    }
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }

  std::uint32_t first_face(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    Query query{};
    query.best = std::numeric_limits<double>::infinity();
    query.ray = &ray;
    query.hit = in_float(ray);
    rtcIntersect1(scene_, &context, &query.hit);
    return face_of(query.hit);
  }

  /// Distances are those of `squared_distance`, in double. Only for triangles.
  std::uint32_t nearest_face(const Point& point) const {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query{static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z()), 0,
                        std::numeric_limits<float>::infinity()};
    Nearest nearest{this, {point.x(), point.y(), point.z()}};
    rtcPointQuery(scene_, &query, &context, measure, &nearest);
    return nearest.face;
  }

  /// All rays in one call. Only for triangles.
  std::vector<std::uint32_t> first_faces(std::span<const Ray> rays) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    std::vector<RTCRayHit> hits(rays.size());
    std::ranges::transform(rays, hits.begin(), in_float);
    rtcIntersect1M(scene_, &context, hits.data(), static_cast<unsigned>(hits.size()), sizeof(RTCRayHit));
    std::vector<std::uint32_t> faces(rays.size());
    std::ranges::transform(hits, faces.begin(), face_of);
    return faces;
  }

 private:
  static RTCRayHit in_float(const Ray& ray) {
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(ray.origin.x());
    hit.ray.org_y = static_cast<float>(ray.origin.y());
    hit.ray.org_z = static_cast<float>(ray.origin.z());
    hit.ray.dir_x = static_cast<float>(ray.direction.x());
    hit.ray.dir_y = static_cast<float>(ray.direction.y());
    hit.ray.dir_z = static_cast<float>(ray.direction.z());
    hit.ray.tnear = 0;
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0U;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return hit;
  }
  static std::uint32_t face_of(const RTCRayHit& hit) {
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? no_face : hit.hit.primID;
  }

  /// A ray, and what Embree does not know about it. Callbacks are given the address of `hit`.
  struct Query {
    RTCRayHit hit;
    double best;
    const Ray* ray;
  };

  const double* corner(std::uint32_t face, int i) const {
    return coordinates_.data() + 3 * std::size_t{corners_[face][static_cast<std::size_t>(i)]};
  }

  static void bound(const RTCBoundsFunctionArguments* arguments) {
    const auto& scene = *static_cast<const Embree_scene*>(arguments->geometryUserPtr);
    float low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double p = scene.corner(arguments->primID, 0)[axis], q = scene.corner(arguments->primID, 1)[axis],
                   r = scene.corner(arguments->primID, 2)[axis];
      const float infinity = std::numeric_limits<float>::infinity();
      low[axis] = std::nextafter(static_cast<float>(std::min({p, q, r})), -infinity);
      high[axis] = std::nextafter(static_cast<float>(std::max({p, q, r})), infinity);
    }
    *arguments->bounds_o = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
  }

  /// The nearest face so far.
  struct Nearest {
    const Embree_scene* scene;
    Eigen::Vector3d point;
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t face = no_face;
  };

  /// @return whether the query is to go on within a smaller radius
  static bool measure(RTCPointQueryFunctionArguments* arguments) {
    auto& nearest = *static_cast<Nearest*>(arguments->userPtr);
    const auto vector = [&](int i) {
      return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(nearest.scene->corner(arguments->primID, i)));
    };
    const double squared = squared_distance(nearest.point, vector(0), vector(1), vector(2));
    if (!(squared < nearest.squared)) return false;
    nearest.squared = squared;
    nearest.face = arguments->primID;
    arguments->query->radius =
        std::nextafter(static_cast<float>(std::sqrt(squared)), std::numeric_limits<float>::infinity());
    return true;
  }

  /// The test of Moeller and Trumbore, in double.
  static void intersect(const RTCIntersectFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const auto& scene = *static_cast<const Embree_scene*>(arguments->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(arguments->rayhit);
    const auto vector = [&](int i) { return Eigen::Map<const Eigen::Vector3d>(scene.corner(arguments->primID, i)); };
    const Eigen::Vector3d p = vector(0), e = vector(1) - p, f = vector(2) - p, &d = query.ray->direction;
    const Eigen::Vector3d h = d.cross(f), s = query.ray->origin - p, g = s.cross(e);
    const double inverse = 1 / e.dot(h), u = s.dot(h) * inverse, v = d.dot(g) * inverse, t = f.dot(g) * inverse;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t < query.best)) return;
    query.best = t;
    query.hit.ray.tfar = std::nextafter(static_cast<float>(t), std::numeric_limits<float>::infinity());
    query.hit.hit.primID = arguments->primID;
    query.hit.hit.geomID = arguments->geomID;
  }

  std::span<const Corners> corners_;
  Coordinates coordinates_;
  float* vertices_ = nullptr;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_;
};

}  // namespace lodestone

#endif
