// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/ray_search.h"

namespace lodestone {

/// @throws Bad_argument  a ray or a point is not as it must be; if there are several, it is named
void check_each(std::span<const Ray> rays);
/// The same of points, whose coordinates must be finite.
void check_each(std::span<const Point> points);

/// Asks a surface that is only read about many rays or points. The workers share them.
/// @param question  called with the surface and one of `asked`; its answers can be default-constructed
/// @return one answer per question, in their order
/// @throws what the first question that fails throws
template <class Surface, class Asked, class Question>
auto ask_each(Surface& surface, std::span<const Asked> asked, const Question& question, Workers& workers) {
  check_each(asked);
  std::vector<decltype(question(surface, asked.front()))> answers(asked.size());
  const auto answer = [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) answers[i] = question(surface, asked[i]);
  };
  // A question takes some microseconds, like waking a thread. Neighbours in the list are often neighbours in space.
  constexpr std::size_t least_shared = 32, most_per_task = 256;
  const std::size_t per_task = std::clamp<std::size_t>(asked.size() / (8 * workers.count()), 1, most_per_task);
  if (asked.size() < least_shared || workers.count() == 1)
    answer(0, asked.size());
  else
    workers.run((asked.size() + per_task - 1) / per_task, [&](std::size_t task, std::size_t) {
      answer(task * per_task, std::min((task + 1) * per_task, asked.size()));
    });
  return answers;
}

/// The same of a Bounded_surface. It poses leaves as it is asked, so one thread asks it. If a bound turns out to be
/// broken, earlier answers may rest on it: then all is posed by now, and all are asked anew.
/// @param question  called also with a Layout_view
template <class Asked, class Question>
auto ask_each(Bounded_surface& surface, std::span<const Asked> asked, const Question& question, Workers& workers) {
  check_each(asked);
  std::vector<decltype(question(surface, asked.front()))> answers;
  answers.reserve(asked.size());
  for (const Asked& one : asked) {
    answers.push_back(question(surface, one));
    if (surface.violations() == 0) continue;
    const Layout_view settled = surface.view();
    return ask_each(settled, asked, question, workers);
  }
  return answers;
}

}  // namespace lodestone
