// SPDX-License-Identifier: GPL-3.0-or-later
// The slow headers, compiled once.
#pragma once

#include "../src/precompiled.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
