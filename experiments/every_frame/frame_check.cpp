// SPDX-License-Identifier: GPL-3.0-or-later
#include "every_frame/frame_check.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace lodestone {

void compare_with_truth(const Frame& answer, Object_pair pair, std::span<const Face_pair> truth,
                        const Detector_options& options, Frame_checks& checked) {
  const Pair_result* const listed = answer.find(pair.a, pair.b);
  const bool collides = listed != nullptr && listed->collides;
  const auto found = listed != nullptr ? answer.contacts(*listed) : std::span<const Face_pair>();
  if (!finds_all(options.mode)) {
    std::vector<Face_pair> false_pairs;
    std::ranges::set_difference(found, truth, std::back_inserter(false_pairs));
    checked.invented += false_pairs.size() + (collides && truth.empty() ? 1 : 0);
    return;
  }
  checked.wrong_answers += collides == truth.empty() ? 1 : 0;
  if (options.contacts == Contact_query::all) checked.wrong_sets += std::ranges::equal(found, truth) ? 0 : 1;
}

}  // namespace lodestone
