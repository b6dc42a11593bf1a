// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/io/files/atomic_files.h"
#include "lodestone/io/results/vtp.h"
#include "lodestone/io/scenes/scene_file.h"
#include "program/scene_detector.h"

namespace lodestone {

/// Writes a run as files for ParaView: meshes, particles and contacts of each frame in `frames/*.vtp`, and their
/// sequences in `meshes.pvd`, `particles.pvd` and `contacts.pvd`. No file appears before `commit`.
class Paraview_log {
 public:
  /// @param frames  number of frames that will be added
  /// @param mode    of the detector
  Paraview_log(const std::filesystem::path& folder, std::size_t frames, Mode mode);

  /// @param scene     posed at `frame`
  /// @param detector  that has found `result` in that frame
  void add(std::size_t frame, const Scene& scene, const Scene_detector& detector, const Frame& result);
  /// Writes the lists of frames. After this only a rename can fail.
  void finish();
  void commit() { files_.commit(); }

 private:
  struct Series {
    const char* name;
    std::vector<Pvd_step> steps = {};
  };
  void write(Series& series, std::size_t frame, const Vtp_data& data);

  Atomic_files files_;
  std::size_t digits_;
  Mode mode_;
  Series meshes_{"meshes"}, particles_{"particles"}, contacts_{"contacts"};
};

}  // namespace lodestone
