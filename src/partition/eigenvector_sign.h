// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace lodestone {

/// The sign of an eigenvector is arbitrary. The largest component is made positive, so that runs agree.
/// @param eigenvector  a column vector of Eigen
template <class Vector>
void make_largest_component_positive(Vector& eigenvector) {
  Eigen::Index largest = 0;
  eigenvector.cwiseAbs().maxCoeff(&largest);
  if (eigenvector[largest] < 0) eigenvector = -eigenvector;
}

}  // namespace lodestone
