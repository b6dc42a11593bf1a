// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/ray_tree.h"

#include <algorithm>
#include <bit>
#include <boost/container/static_vector.hpp>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/ask_each.h"
#include "queries/ray_hits.h"
#include "queries/ray_start_kernel.h"
#include "queries/ray_tree_builder.h"

namespace lodestone {

namespace {

/// Some tens of microseconds.
constexpr std::size_t rays_per_task = 128;

/// Asks for some rays, which have been checked, and which walk in turns.
template <class Collector, class Answer, std::size_t most_rays>
class Ray_group final {
 public:
  Ray_group(const Ray_tree& tree, std::span<const Ray> rays, std::span<Answer> answers)
      : tree_(tree), rays_(rays), answers_(answers) {}

  void run() {
    for (const Ray& ray : rays_) questions_.emplace_back(ray);
    if (tree_.nodes().empty()) {
      for (std::size_t i = 0; i < rays_.size(); ++i) ask_surface(i);
      return;
    }
    for (std::size_t first = 0; first < rays_.size(); first += ray_tree_width) start(first);
    kernel::Ray_candidate_list candidates;
    const kernel::Ray_nodes nodes{tree_.nodes().data(), tree_.blocks().data(), tree_.surface().coordinates.data(),
                                  tree_.most_waiting()};
    kernel::walk_rays(nodes, walks_, std::span(walking_.data(), walking_.size()), Collector::until, candidates);
    for (const kernel::Ray_candidates& found : candidates.get()) test(found);
    tests_.finish();
    for (const std::uint32_t ray : walking_) answers_[ray] = questions_[ray].collector.result();
  }

 private:
  struct Question {
    explicit Question(const Ray& ray) : frame(ray.origin, ray.direction, ray.length), collector(frame) {}
    Question(const Question&) = delete;

    Ray_frame frame;
    Collector collector;
  };

  void ask_surface(std::size_t ray) { answers_[ray] = Collector::ask(tree_.surface(), rays_[ray]); }

  /// Starts as many rays as a vector holds.
  void start(std::size_t first) {
    const std::size_t count = std::min(ray_tree_width, rays_.size() - first);
    const std::size_t lanes = count == 1 ? 1 : ray_tree_width;
    kernel::Ray_numbers numbers;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Ray_frame& frame = questions_[first + std::min(lane, count - 1)].frame;
      for (int axis = 0; axis < 3; ++axis) {
        numbers.origin[axis][lane] = frame.origin[axis];
        numbers.direction[axis][lane] = frame.direction[axis];
      }
      numbers.limit[lane] = frame.most_limit;
    }
    const auto& middle = tree_.middle();
    const auto starts = kernel::start_rays({{middle[0], middle[1], middle[2]}, tree_.scale()}, numbers, count,
                                           walks_[first / ray_tree_width]);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if ((starts.near >> lane & 1U) == 0)
        ask_surface(first + lane);
      else if ((starts.walks >> lane & 1U) != 0)
        walking_.push_back(static_cast<std::uint32_t>(first + lane));
    }
  }

  void test(const kernel::Ray_candidates& found) {
    Question& question = questions_[found.ray];
    const Ray_block& block = tree_.blocks()[found.block];
    const double* const coordinates = tree_.surface().coordinates.data();
    for (std::uint32_t lanes = found.lanes; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      const auto corner = [&](std::size_t i) { return coordinates + 3 * std::size_t{block.vertices[i][lane]}; };
      tests_.add(question.frame, {corner(0), corner(1), corner(2)}, block.faces[lane], question.collector);
    }
  }

  const Ray_tree& tree_;
  std::span<const Ray> rays_;
  std::span<Answer> answers_;
  boost::container::static_vector<Question, most_rays> questions_;
  boost::container::static_vector<std::uint32_t, most_rays> walking_;
  Face_tests<Collector> tests_;
  kernel::Ray_walks walks_[(most_rays + ray_tree_width - 1) / ray_tree_width];
};

template <class Collector, class Answer>
std::vector<Answer> ask_in_groups(const Ray_tree& tree, std::span<const Ray> rays, Workers& workers) {
  check_each(rays);
  std::vector<Answer> answers(rays.size());
  workers.run((rays.size() + rays_per_task - 1) / rays_per_task, [&](std::size_t task, std::size_t) {
    const std::size_t first = task * rays_per_task, count = std::min(rays_per_task, rays.size() - first);
    Ray_group<Collector, Answer, rays_per_task>(tree, rays.subspan(first, count),
                                                std::span(answers).subspan(first, count))
        .run();
  });
  return answers;
}

template <class Collector, class Answer>
Answer ask_alone(const Ray_tree& tree, const Ray& ray) {
  check(ray);
  Answer answer;
  Ray_group<Collector, Answer, 1>(tree, {&ray, 1}, {&answer, 1}).run();
  return answer;
}

}  // namespace

Ray_tree::Ray_tree(const Layout_view& surface, Workers& workers)
    : surface_(surface), face_count_(surface.layout->face_count()) {
  Ray_tree_builder(*this).build(workers);
}

void Ray_tree::refit(const Layout_view& surface, Workers& workers) {
  if (surface.layout->face_count() != face_count_ || surface.coordinates.size() != surface_.coordinates.size())
    throw Bad_argument("a tree for rays cannot follow a surface with other faces or vertices");
  if (blocks_.empty()) {
    *this = Ray_tree(surface, workers);  // there was no fitting scale so far
    return;
  }
  surface_ = surface;
  Ray_tree_builder(*this).refit(workers);
}

std::optional<Ray_hit> first_hit(const Ray_tree& tree, const Ray& ray) {
  return ask_alone<First_hit, std::optional<Ray_hit>>(tree, ray);
}

std::vector<Ray_hit> all_hits(const Ray_tree& tree, const Ray& ray) {
  return ask_alone<Every_hit, std::vector<Ray_hit>>(tree, ray);
}

std::vector<std::optional<Ray_hit>> first_hits(const Ray_tree& tree, std::span<const Ray> rays, Workers& workers) {
  return ask_in_groups<First_hit, std::optional<Ray_hit>>(tree, rays, workers);
}

std::vector<std::vector<Ray_hit>> all_hits(const Ray_tree& tree, std::span<const Ray> rays, Workers& workers) {
  return ask_in_groups<Every_hit, std::vector<Ray_hit>>(tree, rays, workers);
}

std::vector<std::optional<Ray_hit>> first_hits(const Layout_view& surface, std::span<const Ray> rays,
                                               Workers& workers) {
  if (Ray_tree::pays(rays.size(), surface.layout->face_count()))
    return first_hits(Ray_tree(surface, workers), rays, workers);
  return ask_each(
      surface, rays, [](const Layout_view& view, const Ray& ray) { return first_hit(view, ray); }, workers);
}

std::vector<std::optional<Ray_hit>> first_hits(Bounded_surface& surface, std::span<const Ray> rays, Workers& workers) {
  return ask_each(
      surface, rays, [](auto& asked, const Ray& ray) { return first_hit(asked, ray); }, workers);
}

}  // namespace lodestone
