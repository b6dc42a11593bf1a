// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "program/progress.h"

namespace lodestone {

namespace {

/// @throws Interrupted
void wait_for_lock(int descriptor) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds pause(10);
  constexpr std::chrono::seconds longest(5);  // another run only renames files
  const auto start = Clock::now();
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || errno == EINTR)) {
    check_interrupt();
    if (Clock::now() - start > longest) return;  // somebody else holds it, such as the caller of the program
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

Folder_lock::Folder_lock(const std::filesystem::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  try {
    wait_for_lock(descriptor_);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Folder_lock::~Folder_lock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace lodestone
