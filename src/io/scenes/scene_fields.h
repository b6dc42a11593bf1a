// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "io/files/json_reader.h"
#include "lodestone/io/motion/deformation.h"

/// The parts of a scene that do not refer to files, as docs/scene.schema.json describes them.
namespace lodestone::detail {

/// {"icosphere": {"frequency": 8}} and so on.
Surface_mesh read_shape(const Json_value& value);

/// [{"wobble": {...}}, {"travel": {...}}].
std::vector<Deformation> read_deformations(const Json_value& value);

/// {"scale": 2, "rotate": {"axis": [0, 0, 1], "degrees": 90}, "translate": [1, 0, 0]}: scale first, then rotate, then
/// translate.
Kernel::Aff_transformation_3 read_placement(const Json_value& value);

/// Three numbers that are not all zero.
Kernel::Vector_3 read_direction(const Json_value& value);

}  // namespace lodestone::detail
