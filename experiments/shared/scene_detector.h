// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/detector.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/pairs.h"
#include "program/measurement.h"

/// Detectors for the objects of a scene, with its collision groups and ignored pairs.
namespace lodestone {

/// A detector with all objects of the scene, which must outlive it.
/// @param contacts  replaces that of the setting
Detector<Any_strategy> scene_detector(const Scene& scene, const Setting& setting, Contact_query contacts);

/// The pairs of different objects that the scene does not ignore, sorted. O(objects^2).
std::vector<Object_pair> object_pairs(const Scene& scene);

}  // namespace lodestone
