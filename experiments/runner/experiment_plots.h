// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "lodestone/io/results/page.h"

namespace lodestone {

/// The plots of an experiment, with its figures inlined: every *.vl.json of `specs`, sorted by name. None if there is
/// no such folder. At any depth a specification names its data by `{"url": FILE}`, or by `{"name": TABLE}` for
/// TABLE.json; `"format": {"property": P}` says that the rows are the value of key P.
/// @param out  folder of the figures
/// @throws Bad_argument  a specification that is not JSON, or whose data do not exist, are not rows, or lie elsewhere
std::vector<Page_plot> experiment_plots(const std::filesystem::path& specs, const std::filesystem::path& out);

}  // namespace lodestone
