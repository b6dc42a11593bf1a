// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/ray_tree.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <boost/container/static_vector.hpp>

#include "lodestone/queries/ask_each.h"
#include "queries/ray_hits.h"
#include "queries/ray_tree_builder.h"
#include "queries/relative_ray.h"

namespace lodestone {

namespace {

/// Some tens of microseconds.
constexpr std::size_t rays_per_task = 128;

/// Asks for some rays, which walk in turns.
template <class Collector, class Answer>
class Ray_group final : public kernel::Ray_visitor {
 public:
  Ray_group(const Ray_tree& tree, std::span<const Ray> rays, std::span<Answer> answers)
      : tree_(tree), rays_(rays), answers_(answers) {}

  void run() {
    const std::size_t count = std::min(rays_.size(), usual_walkers), room = tree_.most_waiting();
    boost::container::small_vector<std::uint64_t, 64 * usual_walkers> waiting(count * room,
                                                                              boost::container::default_init);
    boost::container::static_vector<Walk, usual_walkers> walks(count);
    boost::container::static_vector<kernel::Ray_walker*, usual_walkers> walkers;
    for (Walk& walk : walks) {
      walk.waiting = waiting.data() + walkers.size() * room;
      if (start_next(walk)) walkers.push_back(&walk);
    }
    kernel::walk_rays({tree_.nodes().data(), tree_.blocks().data()}, std::span(walkers.data(), walkers.size()), *this);
  }

 private:
  static constexpr std::size_t usual_walkers = 8;
  static_assert(usual_walkers <= kernel::most_ray_walkers);

  struct Question {
    Question(const Ray_tree& tree, const Ray& asked, Answer& place)
        : frame(asked.origin, asked.direction, asked.length), ray(tree, frame), collector(frame), answer(place) {}

    Ray_frame frame;
    Relative_ray ray;
    Collector collector;
    Answer& answer;

    float most_depth() const { return ray.walk_depth(collector.most_depth()); }
  };
  struct Walk : kernel::Ray_walker {
    std::optional<Question> question;
  };

  float visit(kernel::Ray_walker& walker, const Ray_block& block, std::size_t lane) override {
    Question& question = *static_cast<Walk&>(walker).question;
    const double* const coordinates = tree_.surface().coordinates.data();
    const auto corner = [&](std::size_t i) { return coordinates + 3 * std::size_t{block.vertices[i][lane]}; };
    test_face(question.frame, {corner(0), corner(1), corner(2)}, block.faces[lane], question.collector);
    return question.most_depth();
  }

  bool end(kernel::Ray_walker& walker) override {
    Walk& walk = static_cast<Walk&>(walker);
    walk.question->answer = walk.question->collector.result();
    return start_next(walk);
  }

  /// Answers the next rays, up to one that has to walk.
  /// @return false if there is none
  bool start_next(Walk& walk) {
    while (next_ < rays_.size()) {
      const Ray& ray = rays_[next_];
      Answer& answer = answers_[next_++];
      check(ray);
      const Question& question = walk.question.emplace(tree_, ray, answer);
      if (tree_.nodes().empty() || !question.ray.is_near()) {
        answer = Collector::ask(tree_.surface(), ray);
      } else if (question.ray.meets_box()) {
        walk.ray = question.ray.walk();
        walk.most = question.most_depth();
        walk.next = 0;
        walk.end_waiting = walk.waiting;
        return true;
      }
    }
    return false;
  }

  const Ray_tree& tree_;
  std::span<const Ray> rays_;
  std::span<Answer> answers_;
  std::size_t next_ = 0;
};

template <class Collector, class Answer>
std::vector<Answer> ask_in_groups(const Ray_tree& tree, std::span<const Ray> rays, Workers& workers) {
  std::vector<Answer> answers(rays.size());
  workers.run((rays.size() + rays_per_task - 1) / rays_per_task, [&](std::size_t task, std::size_t) {
    const std::size_t first = task * rays_per_task, count = std::min(rays_per_task, rays.size() - first);
    Ray_group<Collector, Answer>(tree, rays.subspan(first, count), std::span(answers).subspan(first, count)).run();
  });
  return answers;
}

/// A tree is made for more rays than there are faces, divided by this. It then pays for itself on one thread.
constexpr std::size_t faces_per_ray = 8;

}  // namespace

Ray_tree::Ray_tree(const Layout_view& surface, Workers& workers) : surface_(surface) {
  Ray_tree_builder(*this).build(workers);
}

std::vector<std::optional<Ray_hit>> first_hits(const Ray_tree& tree, std::span<const Ray> rays, Workers& workers) {
  return ask_in_groups<First_hit, std::optional<Ray_hit>>(tree, rays, workers);
}

std::vector<std::vector<Ray_hit>> all_hits(const Ray_tree& tree, std::span<const Ray> rays, Workers& workers) {
  return ask_in_groups<Every_hit, std::vector<Ray_hit>>(tree, rays, workers);
}

std::vector<std::optional<Ray_hit>> first_hits(const Layout_view& surface, std::span<const Ray> rays,
                                               Workers& workers) {
  if (rays.size() > surface.layout->face_count() / faces_per_ray)
    return first_hits(Ray_tree(surface, workers), rays, workers);
  return ask_each(
      surface, rays, [](const Layout_view& view, const Ray& ray) { return first_hit(view, ray); }, workers);
}

std::vector<std::optional<Ray_hit>> first_hits(Bounded_surface& surface, std::span<const Ray> rays, Workers& workers) {
  return ask_each(
      surface, rays, [](Bounded_surface& bounded, const Ray& ray) { return first_hit(bounded, ray); }, workers);
}

}  // namespace lodestone
