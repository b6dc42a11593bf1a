// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/fit.h"

#include <Eigen/Dense>

namespace lodestone {

double fitted_exponent(std::span<const double> x, std::span<const double> y) {
  const auto count = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixX2d columns(count, 2);
  columns.col(0) = Eigen::Map<const Eigen::ArrayXd>(x.data(), count).log();
  columns.col(1).setOnes();
  const Eigen::VectorXd logs = Eigen::Map<const Eigen::ArrayXd>(y.data(), count).log();
  return columns.colPivHouseholderQr().solve(logs)[0];
}

}  // namespace lodestone
