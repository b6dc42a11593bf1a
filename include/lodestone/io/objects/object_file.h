// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "lodestone/detector.h"

/// Files that keep what a detector has built of an object.
namespace lodestone {

/// Writes the bytes of `Detector::save`. The file appears whole or not at all.
/// @throws Bad_output  the folder or the file cannot be written
void write_object_file(std::span<const std::byte> saved, const std::filesystem::path& file);

/// The bytes of a file, to be shown to a visitor.
/// @throws Bad_saved_object  the file does not exist or cannot be read; what `load` throws, with the file's name before
void read_object_file(const std::filesystem::path& file, const std::function<void(std::span<const std::byte>)>& load);

/// Saves an object to a file: see `Detector::save`.
/// @throws Bad_output  the folder or the file cannot be written
template <class Strategy, Bounding_volume Volume>
void save_object(Detector<Strategy, Volume>& detector, Object_id object, const std::filesystem::path& file) {
  write_object_file(detector.save(object), file);
}

/// Loads an object that was saved to a file: see `Detector::load`.
/// @throws Bad_saved_object  as `load`, or the file does not exist or cannot be read; the message begins with its name
template <class Strategy, Bounding_volume Volume>
void load_object(Detector<Strategy, Volume>& detector, Object_id object, const std::filesystem::path& file) {
  read_object_file(file, [&](std::span<const std::byte> saved) { detector.load(object, saved); });
}

}  // namespace lodestone
