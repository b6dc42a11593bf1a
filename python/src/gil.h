// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <thread>

/// Python's global lock. When Python ends, it unwinds the stack of any other thread that asks for the lock; in the
/// middle of C++ that would abort the process. Such a thread is kept where it is, until the process is gone.
namespace lodestone::python {

/// Waits until the process ends.
[[noreturn]] inline void wait_for_the_end() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Releases the lock for its lifetime.
class Without_gil {
 public:
  Without_gil() : state_(PyEval_SaveThread()) {}
  ~Without_gil() noexcept(false) {
    try {
      PyEval_RestoreThread(state_);
    } catch (abi::__forced_unwind&) {
      wait_for_the_end();
    }
  }
  Without_gil(const Without_gil&) = delete;
  Without_gil& operator=(const Without_gil&) = delete;

 private:
  PyThreadState* state_;
};

/// Has the lock for its lifetime.
class With_gil {
 public:
  With_gil() {
    try {
      gil_.emplace();
    } catch (abi::__forced_unwind&) {
      wait_for_the_end();
    }
  }

 private:
  std::optional<pybind11::gil_scoped_acquire> gil_;
};

}  // namespace lodestone::python
