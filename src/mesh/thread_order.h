// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if defined(LODESTONE_TSAN)
#include <sanitizer/tsan_interface.h>
#endif

namespace lodestone {

/// Tells ThreadSanitizer that what this thread has done so far comes before what other threads do after they call
/// `comes_after` with the same address. For oneTBB, which is not instrumented: it guarantees this order, and the
/// sanitizer cannot see it. Otherwise nothing.
inline void comes_before([[maybe_unused]] const void* address) {
#if defined(LODESTONE_TSAN)
  __tsan_release(const_cast<void*>(address));
#endif
}

/// See `comes_before`.
inline void comes_after([[maybe_unused]] const void* address) {
#if defined(LODESTONE_TSAN)
  __tsan_acquire(const_cast<void*>(address));
#endif
}

}  // namespace lodestone
