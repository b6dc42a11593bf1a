// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/tree_walk.h"

#include "tree/leaf_candidates_kernel.h"

namespace lodestone {

void list_leaf_candidates(const Region_tree& a, const Region_tree& b, Node_pair pair, double margin,
                          Leaf_candidates& candidates) {
  const auto bunch = [](const Region_tree& tree, std::uint32_t n) {
    const auto& node = tree.node(n);
    return kernel::Leaf_bunch{.boxes = tree.volumes().data(),
                              .around = &tree.volume(n),
                              .nodes = tree.leaf_nodes().data() + node.leaf,
                              .count = node.end_leaf - node.leaf};
  };
  candidates.first_a = a.node(pair.a).leaf;
  candidates.first_b = b.node(pair.b).leaf;
  kernel::list_leaf_candidates(bunch(a, pair.a), bunch(b, pair.b), margin, candidates);
}

}  // namespace lodestone
