// SPDX-License-Identifier: GPL-3.0-or-later
// The slow headers, compiled once.
#pragma once

#include "precompiled.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
