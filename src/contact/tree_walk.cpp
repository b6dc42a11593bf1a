// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/tree_walk.h"

#include "contact/near_leaves_kernel.h"

namespace lodestone {

void list_near_leaves(const Region_tree& a, const Region_tree& b, Node_pair pair, double margin, Near_leaves& near) {
  const auto bunch = [](const Region_tree& tree, std::uint32_t n) {
    const auto& node = tree.node(n);
    return kernel::Leaf_bunch{.boxes = tree.volumes().data(),
                              .around = &tree.volume(n),
                              .nodes = tree.leaf_nodes().data() + node.leaf,
                              .count = node.end_leaf - node.leaf};
  };
  near.first_a = a.node(pair.a).leaf;
  near.first_b = b.node(pair.b).leaf;
  kernel::list_near_leaves(bunch(a, pair.a), bunch(b, pair.b), margin, near);
}

}  // namespace lodestone
