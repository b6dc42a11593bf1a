// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace lodestone {

/// Held while results that belong together take their names: another run that writes into the same folder waits
/// meanwhile, so that it does not have files of both. Ends with the process that holds it, however that ends.
class Folder_lock {
 public:
  /// Waits until nobody else holds it, for five seconds at most. Then, and where the file system has no locks, nothing
  /// is locked.
  /// @param folder  exists
  /// @throws Interrupted  the user has asked to stop
  explicit Folder_lock(const std::filesystem::path& folder);
  Folder_lock(const Folder_lock&) = delete;
  Folder_lock& operator=(const Folder_lock&) = delete;
  ~Folder_lock();

 private:
  int descriptor_;
};

}  // namespace lodestone
