// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>

#include "lodestone/detection/detector_options.h"

namespace lodestone {

/// Refuses options that the mode `particles` would ignore: with meetings those of the published method, else those of
/// meetings.
/// @throws Bad_argument  names the option
void refuse_options_beside_meetings(const CLI::App& detect, std::size_t meetings);

/// Refuses options of `detect` that the mode would ignore.
/// @throws Bad_argument  names the option and the modes that take it
void refuse_options_of_other_modes(const CLI::App& detect, Mode mode);

}  // namespace lodestone
