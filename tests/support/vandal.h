// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace lodestone::test {

/// Damages files at random: bytes, digits, lengths. The seed is fixed, so that a failure can be repeated.
class Vandal {
 public:
  std::string damaged(std::string bytes) {
    for (std::size_t blows = 1 + random_() % 4; blows > 0 && !bytes.empty(); --blows) hit(bytes);
    return bytes;
  }

 private:
  void hit(std::string& bytes) {
    const auto at = random_() % bytes.size();
    switch (random_() % 5) {
      case 0:
        bytes[at] = static_cast<char>(random_());
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.insert(at, bytes.substr(random_() % bytes.size(), random_() % 20));
        break;
      case 3:
        bytes.erase(at, random_() % 20);
        break;
      default:
        replace_number(bytes, at);
    }
  }

  void replace_number(std::string& bytes, std::size_t from) {
    const std::vector<std::string> numbers = {"-1",  "0",   "4294967296", "1e999", "2147483648", "99999999999999999999",
                                              "nan", "1.5", "-0",         "",      "255",        "3 3"};
    const auto at = bytes.find_first_of("0123456789", from);
    if (at != std::string::npos) bytes.replace(at, 1, numbers[random_() % numbers.size()]);
  }

  std::mt19937 random_{2006};
};

}  // namespace lodestone::test
