// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/io/files/atomic_file.h"
#include "program/commands.h"
#include "program/detect_run.h"

namespace lodestone {

/// @throws Bad_argument  options that shards cannot have, or that are for shards alone
void check_shard_options(const Detect_command& command);

/// Plays the frames of one shard, and leaves them in the folder of results; nothing if they are there.
/// @return exit code
int run_shard(const Detect_command& command);

/// Takes the frames of a run from the shards in its folder.
/// @throws Bad_shard     a shard is missing or damaged
/// @throws Bad_argument  the shards are of other work
void merge_shards(Detect_run& scene_run, Atomic_file& frames, const Detect_command& command);

}  // namespace lodestone
