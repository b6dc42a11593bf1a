// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers/peer.h"

#include <iterator>

namespace lodestone {

std::vector<Peer_kind> all_peers() {
  std::vector<Peer_kind> all;
  for (auto* library : {cgal_peers, fcl_peers, embree_peers, bullet_peers, ode_peers}) {
    auto kinds = library();
    all.insert(all.end(), std::make_move_iterator(kinds.begin()), std::make_move_iterator(kinds.end()));
  }
  return all;
}

}  // namespace lodestone
