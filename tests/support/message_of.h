// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace lodestone {

/// What a call throws says; `no error` if it throws none.
template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace lodestone
