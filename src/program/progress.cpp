// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>

namespace lodestone {

namespace {

volatile std::sig_atomic_t interrupted = 0;
/// Whether somebody sits at a terminal, who may wait for the end.
volatile std::sig_atomic_t is_watched = 0;

/// A second signal ends the program at once, since a step can take long.
void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
  constexpr char told[] = "\nlodestone: ends after this step; a second signal ends it at once\n";
  if (is_watched != 0) [[maybe_unused]]
    const auto written = ::write(STDERR_FILENO, told, sizeof told - 1);
}

}  // namespace

void handle_interrupts() {
  is_watched = ::isatty(STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, note_interrupt) == SIG_IGN) std::signal(signal, SIG_IGN);  // as under nohup
  // Ignored, so that a write past the file-size limit, or to a pipe that nobody reads, fails with an error.
  for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
}

void check_interrupt() {
  if (interrupted != 0) throw Interrupted();
}

Progress_bar::Progress_bar(std::string label, bool quiet)
    : label_(std::move(label)), shown_(!quiet && ::isatty(STDERR_FILENO) != 0) {}

Progress_bar::~Progress_bar() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress_bar::operator()(std::size_t done, std::size_t of) {
  check_interrupt();
  if (!shown_ || of == 0) return;
  const auto now = Clock::now();
  if (!begun_) begun_ = {.done = done, .at = now};
  if (drawn_ && now - last_drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = true;
  last_drawn_ = now;

  constexpr std::size_t width = 30;
  const std::size_t filled = width * done / of;
  const double elapsed = std::chrono::duration<double>(now - begun_->at).count();
  std::string left;
  if (done > begun_->done)
    left = fmt::format("  {:.0f} s left",
                       elapsed * static_cast<double>(of - done) / static_cast<double>(done - begun_->done));
  fmt::print(stderr, "\r{} [{}{}] {}/{}{}\x1b[K", label_, std::string(filled, '#'), std::string(width - filled, '.'),
             done, of, left);
  std::fflush(stderr);
}

}  // namespace lodestone
