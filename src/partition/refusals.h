// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/exceptions.h>

#include <string>
#include <string_view>

#include "lodestone/mesh/errors.h"

namespace lodestone {

/// Returns what `work` returns. Throws Bad_mesh in the name of a strategy if CGAL refuses the surface.
template <class Work>
auto with_refusals_as_bad_mesh(std::string_view strategy, const Work& work) {
  try {
    return work();
  } catch (const CGAL::Failure_exception& refusal) {
    throw Bad_mesh(std::string(strategy) + ": CGAL cannot handle this surface: " + refusal.expression());
  }
}

}  // namespace lodestone
