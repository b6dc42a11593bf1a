// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>

#include "lodestone/mesh/workers.h"

namespace lodestone {

/// Works on several items, such as objects to build, where the work on a single one can be shared too. Items of like
/// sizes are done side by side, each by one worker; where one of them outweighs the others, and for those that are left
/// over at the end, one after the other by all workers. Items of at least `shared_from` come first, one
/// after the other by all workers, so that they do not take the caches from each other.
/// @param sizes        of the items, such as numbers of faces
/// @param work         called with the index of an item and the workers that may share it; its result must not depend
///                     on how many these are. Several threads call it at once
/// @param shared_from  a size from which on the work on one item is shared well
/// @throws what the work on the first item that fails throws, in the order in which they are done; items after it may
///         be left out
void side_by_side(std::span<const std::size_t> sizes, Workers& workers,
                  const std::function<void(std::size_t, Workers&)>& work,
                  std::size_t shared_from = std::numeric_limits<std::size_t>::max());

}  // namespace lodestone
