// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame must say: the result of checking every face against every other.
#pragma once

#include <vector>

#include "fuzz/drawn_objects.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"

namespace lodestone::fuzz {

/// All face pairs of two objects that intersect, or are nearer than the distance, sorted; of an object and itself those
/// that intersect.
std::vector<Face_pair> true_contacts(const Drawn_object& a, const Drawn_object& b, double distance);

/// Compares what a frame says of one pair with the truth.
/// @param a, b        objects of these ids; the same for an object and itself
/// @param is_allowed  false: the pair must not be listed
void check_pair(const Frame& frame, const Detector_options& options, Object_pair ids, const Drawn_object& a,
                const Drawn_object& b, bool is_allowed);

/// Checks what does not depend on the objects: lists are as long as each other, and in order.
void check_lists(const Frame& frame, const Detector_options& options);

}  // namespace lodestone::fuzz
