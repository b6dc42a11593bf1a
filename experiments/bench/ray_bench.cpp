// SPDX-License-Identifier: GPL-3.0-or-later
// Rays and nearest points, on trees that were built for collisions, beside libraries that were made for them.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

#ifdef LODESTONE_EMBREE
#include <embree3/rtcore.h>
#endif

#include "bench/worm.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/queries/point_search.h"
#include "lodestone/queries/ray_tree.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"
#include "shared/random_rays.h"

namespace lodestone {

namespace {

using Cgal_primitive = CGAL::AABB_face_graph_triangle_primitive<Surface_mesh>;
using Cgal_tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Cgal_primitive>>;

constexpr std::uint32_t no_face = ~std::uint32_t{0};

#ifdef LODESTONE_EMBREE
enum class Embree_kind { triangles, exact_numbers };

/// Of a point from a triangle with the corners a, b and c, by the regions of \cite ericson2005.
double squared_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
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
    RTCPointQuery query{static_cast<float>(point.x()),
                        static_cast<float>(point.y()),
                        static_cast<float>(point.z()),
                        0,
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
#endif

/// A sphere with waves on it, which move.
struct Wavy_sphere {
  Surface_mesh mesh;
  std::vector<Corners> corners;
  std::vector<double> coordinates;
  Tree_surface tree;

  explicit Wavy_sphere(std::size_t frequency) : mesh(icosphere(frequency)) {
    corners = Mesh_numbering<Surface_mesh>(mesh).corners();
    rest_.reserve(3 * mesh.number_of_vertices());
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      rest_.insert(rest_.end(), {p.x(), p.y(), p.z()});
    }
    coordinates = rest_;
    tree = Tree_surface(corners, coordinates);
    move(1);
  }

  void move(double time) {
    for (const auto v : mesh.vertices()) {
      const Eigen::Map<const Eigen::Vector3d> p(rest_.data() + 3 * std::size_t{v});
      const Eigen::Vector3d moved = (1 + 0.1 * std::sin(5 * p.x() + time) * std::sin(7 * p.y())) * p;
      mesh.point(v) = Point(moved.x(), moved.y(), moved.z());
      for (int axis = 0; axis < 3; ++axis)
        coordinates[3 * std::size_t{v} + static_cast<std::size_t>(axis)] = moved[axis];
    }
    Tree_surface* const trees[]{&tree};
    const Coordinates now[]{coordinates};
    refit(trees, now, Workers::alone());
  }

 private:
  std::vector<double> rest_;
};

std::size_t differences(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
  return count;
}

/// Nanoseconds per question of one library, pass by pass, and its last answers.
struct Answers {
  std::vector<double> nanoseconds = {};
  std::vector<std::uint32_t> faces = {};

  template <class Questions, class Answer>
  void ask(const Questions& questions, const Answer& answer) {
    faces.resize(questions.size());
    Lap_timer timer;
    for (std::size_t i = 0; i < questions.size(); ++i) faces[i] = answer(questions[i]);
    nanoseconds.push_back(1e9 * timer.lap() / static_cast<double>(questions.size()));
  }
  /// The same for all questions in one call.
  /// @param answer  returns the faces
  template <class Questions, class Answer>
  void ask_at_once(const Questions& questions, const Answer& answer) {
    Lap_timer timer;
    faces = answer(questions);
    nanoseconds.push_back(1e9 * timer.lap() / static_cast<double>(questions.size()));
  }
  double least() const { return *std::ranges::min_element(nanoseconds); }
};

std::vector<std::uint32_t> faces_of(std::span<const std::optional<Ray_hit>> hits) {
  std::vector<std::uint32_t> faces;
  for (const auto& hit : hits) faces.push_back(hit ? hit->face : no_face);
  return faces;
}

/// The first face that each of some random rays meets. The libraries take turns in each pass. All have been refitted to
/// new positions, but for CGAL, which cannot: it has built its tree for them. Lodestone is asked ray by ray, and by a
/// Ray_tree that is made in each pass, about all rays at once and ray by ray; also about all rays at once by one that was
/// made before the sphere moved, and is refitted. Embree is asked both ways, without such a tree.
///
/// Reported time: that of Lodestone, ray by ray. Counters: nanoseconds per ray, the least of all passes, and per face
/// for `make_tree_ns` and `refit_tree_ns`; ratios to Lodestone, asked in the same way; rays for which another library names another face.
void first_hit_of_rays(benchmark::State& state) {
  Wavy_sphere sphere(static_cast<std::size_t>(state.range(0)));
#ifdef LODESTONE_EMBREE
  Embree_scene in_float(Embree_kind::triangles, sphere.corners, sphere.coordinates),
      in_double(Embree_kind::exact_numbers, sphere.corners, sphere.coordinates);
#endif
  Ray_tree kept(sphere.tree.view());
  sphere.move(2);
#ifdef LODESTONE_EMBREE
  in_float.refit();
  in_double.refit();
  Answers of_float, of_floats, of_double;
#endif
  Cgal_tree cgal(faces(sphere.mesh).first, faces(sphere.mesh).second, sphere.mesh);
  cgal.build();
  const auto rays = random_rays(20000);
  const std::span<const Ray> few(rays.data(), 2000);
  const Layout_view view = sphere.tree.view();
  Answers ours, of_tree, of_tree_alone, of_kept, of_cgal;
  std::vector<double> making, refitting;
  for (auto _ : state) {
    ours.ask(rays, [&](const Ray& ray) {
      const auto hit = first_hit(view, ray);
      return hit ? hit->face : no_face;
    });
    Lap_timer timer;
    const Ray_tree tree(view);
    making.push_back(1e9 * timer.lap() / static_cast<double>(sphere.corners.size()));
    kept.refit(view);
    refitting.push_back(1e9 * timer.lap() / static_cast<double>(sphere.corners.size()));
    of_tree.ask_at_once(rays, [&](std::span<const Ray> all) { return faces_of(first_hits(tree, all)); });
    of_kept.ask_at_once(rays, [&](std::span<const Ray> all) { return faces_of(first_hits(kept, all)); });
    of_tree_alone.ask(rays, [&](const Ray& ray) {
      const auto hit = first_hit(tree, ray);
      return hit ? hit->face : no_face;
    });
#ifdef LODESTONE_EMBREE
    of_floats.ask_at_once(rays, [&](std::span<const Ray> all) { return in_float.first_faces(all); });
    of_float.ask(rays, [&](const Ray& ray) { return in_float.first_face(ray); });
    of_double.ask(rays, [&](const Ray& ray) { return in_double.first_face(ray); });
#endif
    of_cgal.ask(few, [&](const Ray& ray) {
      const auto &o = ray.origin, &d = ray.direction;
      const auto hit = cgal.first_intersected_primitive(
          Kernel::Ray_3(Point(o.x(), o.y(), o.z()), Kernel::Vector_3(d.x(), d.y(), d.z())));
      return hit ? static_cast<std::uint32_t>(*hit) : no_face;
    });
    state.SetIterationTime(1e-9 * ours.nanoseconds.back() * static_cast<double>(rays.size()));
  }
  state.counters["faces"] = static_cast<double>(sphere.corners.size());
  state.counters["hits_percent"] =
      100 - 100 * static_cast<double>(std::ranges::count(ours.faces, no_face)) / static_cast<double>(rays.size());
  state.counters["lodestone_ns"] = ours.least();
  state.counters["tree_ns"] = of_tree.least();
  state.counters["tree_other"] = static_cast<double>(differences(of_tree.faces, ours.faces));
  state.counters["tree_alone_ns"] = of_tree_alone.least();
  state.counters["tree_alone_other"] = static_cast<double>(differences(of_tree_alone.faces, ours.faces));
  state.counters["make_tree_ns"] = *std::ranges::min_element(making);
  state.counters["refit_tree_ns"] = *std::ranges::min_element(refitting);
  state.counters["kept_ns"] = of_kept.least();
  state.counters["kept_other"] = static_cast<double>(differences(of_kept.faces, ours.faces));
  state.counters["cgal_ns"] = of_cgal.least();
  state.counters["cgal_ratio"] = of_cgal.least() / ours.least();
  state.counters["cgal_other"] = static_cast<double>(differences(of_cgal.faces, ours.faces));
#ifdef LODESTONE_EMBREE
  state.counters["embree_ns"] = of_float.least();
  state.counters["embree_ratio"] = of_float.least() / ours.least();
  state.counters["embree_tree_ratio"] = std::min(of_float.least(), of_floats.least()) / of_tree.least();
  state.counters["embree_tree_alone_ratio"] = of_float.least() / of_tree_alone.least();
  state.counters["embree_all_ns"] = of_floats.least();
  state.counters["embree_other"] = static_cast<double>(differences(of_float.faces, ours.faces));
  state.counters["double_ns"] = of_double.least();
  state.counters["double_ratio"] = of_double.least() / ours.least();
  state.counters["double_tree_ratio"] = of_double.least() / of_tree.least();
  state.counters["double_tree_alone_ratio"] = of_double.least() / of_tree_alone.least();
  state.counters["double_other"] = static_cast<double>(differences(of_double.faces, ours.faces));
#endif
}

BENCHMARK(first_hit_of_rays)
    ->Name("ray/first_hit")
    ->ArgsProduct({{22, 71, 224}})
    ->ArgNames({"frequency"})
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

/// The points that a ray begins at; or, each on its way to the centre, as far from there as the surface is, give or take
/// a tenth. With coordinates that float represents.
std::vector<Point> query_points(bool near) {
  auto points = random_ray_origins(4000);
  if (!near) return points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d at =
        Eigen::Vector3d(points[i].x(), points[i].y(), points[i].z()).normalized() * (0.9 + 0.002 * (i % 101));
    const Eigen::Vector3d rounded = at.cast<float>().cast<double>();
    points[i] = Point(rounded.x(), rounded.y(), rounded.z());
  }
  return points;
}

/// The face nearest to each of some points, beside CGAL's `closest_point_and_primitive` and Embree's `rtcPointQuery`
/// over a hierarchy in float, with distances in double. Where a vertex or an edge is nearest, all of its faces are, and
/// the others may name another of them. `cgal_farther` and `embree_farther` count the points for which theirs is farther
/// by more than rounding.
void closest_points_of_mesh(benchmark::State& state) {
  Wavy_sphere sphere(static_cast<std::size_t>(state.range(0)));
  sphere.move(2);
  Cgal_tree cgal(faces(sphere.mesh).first, faces(sphere.mesh).second, sphere.mesh);
  cgal.build();
  cgal.accelerate_distance_queries();
  const auto points = query_points(state.range(1) != 0);
  const Layout_view view = sphere.tree.view();
  Answers ours, of_cgal;
#ifdef LODESTONE_EMBREE
  const Embree_scene embree(Embree_kind::triangles, sphere.corners, sphere.coordinates);
  Answers of_embree;
#endif
  for (auto _ : state) {
    ours.ask(points, [&](const Point& p) { return closest_point(view, p).face; });
#ifdef LODESTONE_EMBREE
    of_embree.ask(points, [&](const Point& p) { return embree.nearest_face(p); });
#endif
    of_cgal.ask(points,
                [&](const Point& p) { return static_cast<std::uint32_t>(cgal.closest_point_and_primitive(p).second); });
    state.SetIterationTime(1e-9 * ours.nanoseconds.back() * static_cast<double>(points.size()));
  }
  const auto farther = [&](const Answers& answers) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [a, b, c] = sphere.corners[answers.faces[i]];
      const auto at = [&](std::uint32_t v) { return sphere.mesh.point(CGAL::SM_Vertex_index(v)); };
      const double squared = CGAL::squared_distance(Kernel::Triangle_3(at(a), at(b), at(c)), points[i]);
      count += std::sqrt(squared) > closest_point(view, points[i]).distance + 1e-14 ? 1 : 0;
    }
    return static_cast<double>(count);
  };
  state.counters["faces"] = static_cast<double>(sphere.corners.size());
  state.counters["lodestone_ns"] = ours.least();
  state.counters["cgal_ns"] = of_cgal.least();
  state.counters["cgal_ratio"] = of_cgal.least() / ours.least();
  state.counters["cgal_other"] = static_cast<double>(differences(of_cgal.faces, ours.faces));
  state.counters["cgal_farther"] = farther(of_cgal);
#ifdef LODESTONE_EMBREE
  state.counters["embree_ns"] = of_embree.least();
  state.counters["embree_ratio"] = of_embree.least() / ours.least();
  state.counters["embree_other"] = static_cast<double>(differences(of_embree.faces, ours.faces));
  state.counters["embree_farther"] = farther(of_embree);
#endif
}

BENCHMARK(closest_points_of_mesh)
    ->Name("ray/closest_point")
    ->ArgsProduct({{22, 71, 224}, {0, 1}})
    ->ArgNames({"frequency", "near"})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

/// One ray per frame at a skinned worm, which takes a new pose in each: `first_hit` of its Bounded_surface, beside
/// posing all vertices, refitting the tree and then `first_hit`. Some of the time is that of `set_joints`, in neither.
///
/// Reported time: that of the bounded surface. The counters are medians over the frames; `ray_us` is the part of the
/// ray in the time of posing all.
void ray_at_character(benchmark::State& state) {
  Worm worm(static_cast<std::size_t>(state.range(0)));
  std::vector<double> coordinates(3 * std::size_t{worm.points.vertex_count()});
  Tree_surface whole(worm.corners, worm.points.shape().rest());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> bounded, posed, ray_alone, percent;
  std::size_t others = 0, hits = 0;
  int frame = 0;
  for (auto _ : state) {
    ++frame;
    worm.pose(0.1 * frame, {0, 0, 0});
    const Eigen::Vector3d origin(8 * unit(random), 5 * unit(random), 8), at(8 * unit(random), unit(random), 0);
    const Ray ray{origin, at - origin};
    Lap_timer timer;
    const auto found = first_hit(worm.surface, ray);
    bounded.push_back(timer.lap());
    worm.points.pose_all(coordinates);
    Tree_surface* const trees[]{&whole};
    const Coordinates now[]{coordinates};
    refit(trees, now, Workers::alone());
    const double before = timer.lap();
    const auto truth = first_hit(whole.view(), ray);
    ray_alone.push_back(timer.lap());
    posed.push_back(before + ray_alone.back());
    others += found.has_value() != truth.has_value() || (found && found->face != truth->face) ? 1 : 0;
    hits += truth ? 1 : 0;
    percent.push_back(100.0 * static_cast<double>(worm.surface.vertices_posed()) / worm.points.vertex_count());
    state.SetIterationTime(bounded.back());
  }
  state.counters["faces"] = static_cast<double>(worm.corners.size());
  state.counters["bounded_us"] = 1e6 * median(bounded);
  state.counters["posed_us"] = 1e6 * median(posed);
  state.counters["ray_us"] = 1e6 * median(ray_alone);
  state.counters["ratio"] = median(posed) / median(bounded);
  state.counters["posed_percent"] = median(percent);
  state.counters["hits"] = static_cast<double>(hits);
  state.counters["other"] = static_cast<double>(others);
}

BENCHMARK(ray_at_character)
    ->Name("ray/character")
    ->ArgsProduct({{32, 71, 224}})
    ->ArgNames({"frequency"})
    ->UseManualTime()
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
