// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/run_reported.h"

#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <system_error>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "program/exit_codes.h"
#include "program/progress.h"

namespace lodestone {

namespace {

/// Always one line, even if file names contain line breaks.
int report(const char* what, int code) {
  fmt::print(stderr, "lodestone: {}\n", printable(what));
  return code;
}

}  // namespace

int run_reported(const std::function<int()>& program) {
  try {
    handle_interrupts();
    const int code = program();
    if (std::fflush(stdout) != 0) throw Bad_output("the standard output cannot be written");
    return code;
  } catch (const Interrupted&) {
    return report("interrupted", exit_code::interrupted);
  } catch (const Bad_output& error) {
    return report(error.what(), exit_code::bad_output);
  } catch (const Bad_argument& error) {
    return report(error.what(), exit_code::bad_usage);
  } catch (const Error& error) {
    return report(error.what(), exit_code::bad_input);
  } catch (const std::bad_alloc&) {
    return report("not enough memory for this input", exit_code::bad_input);
  } catch (const std::system_error& error) {
    // Readers throw their own error types: this one comes from a folder or the standard output.
    return report(error.what(), exit_code::bad_output);
  } catch (const std::exception& error) {
    return report(error.what(), exit_code::unexpected);
  }
}

}  // namespace lodestone
