// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/run_reported.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "program/assumed_machine.h"
#include "program/exit_codes.h"
#include "program/progress.h"
#include "program/standard_input.h"

namespace lodestone {

namespace {

/// Always one line, even if file names contain line breaks. Nobody can be told if the line cannot be written.
int report(const char* what, int code) {
  std::fputs(fmt::format("lodestone: {}\n", printable(naming_standard_input(what))).c_str(), stderr);
  return code;
}

/// Ends quietly where nobody reads on, as `lodestone info FILE | head` does.
int report_output(const std::system_error& error) {
  if (error.code() == std::errc::broken_pipe) return exit_code::reader_left;
  return report(error.what(), exit_code::bad_output);
}

}  // namespace

int run_reported(const std::function<int()>& program) {
  try {
    handle_interrupts();
    const Assumed_machine machine;
    const int code = program();
    if (std::fflush(stdout) != 0) {
      if (errno == EPIPE) return exit_code::reader_left;
      throw Bad_output("the standard output cannot be written");
    }
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
    return report_output(error);
  } catch (const std::exception& error) {
    return report(error.what(), exit_code::unexpected);
  }
}

}  // namespace lodestone
