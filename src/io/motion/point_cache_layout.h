// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

/// The layout of point caches, in bytes. Numbers are int32 or float32.
namespace lodestone {

/// x, y and z of one vertex, in both formats.
inline constexpr std::size_t point_bytes = 12;

/// PC2, little endian: signature, version, number of points, first frame, frames per sample, number of samples; then,
/// per sample, all points.
namespace pc2 {
inline constexpr std::size_t header_bytes = 32;
inline constexpr std::size_t version_at = 12, points_at = 16, samples_at = 28;
inline constexpr std::string_view signature("POINTCACHE2\0", 12);
}  // namespace pc2

/// MDD, big endian: number of frames, number of points, the time of each frame in seconds; then, per frame, all points.
namespace mdd {
inline constexpr std::size_t frames_at = 0, points_at = 4, times_at = 8;
}  // namespace mdd

}  // namespace lodestone
