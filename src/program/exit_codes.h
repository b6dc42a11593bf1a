// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace lodestone::exit_code {

inline constexpr int success = 0;
inline constexpr int collides = 1;
inline constexpr int bad_usage = 2;
inline constexpr int bad_input = 3;
inline constexpr int bad_output = 4;
inline constexpr int contradicts_truth = 5;
inline constexpr int unexpected = 70;
inline constexpr int interrupted = 130;
inline constexpr int reader_left = 141;

inline constexpr const char* help = R"(Exit codes:
  0    done; with detect --exit-code: nothing collides
  1    detect --exit-code: something collides, is near with --within or --self-within, or meets with --impacts
  2    the command line is wrong
  3    a mesh, motion, scene or shard cannot be used
  4    a result cannot be written
  5    --truth: a reported collision is not true, or mode exact or certified missed one
  70   an error that should not happen: please report it
  130  interrupted
  141  the reader of the standard output has closed it)";

}  // namespace lodestone::exit_code
