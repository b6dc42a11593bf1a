// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace lodestone {

/// Makes names differ.
class Unique_names {
 public:
  /// @return the name, with a number if it is taken: `ball`, `ball_2`, `ball_3`
  std::string take(const std::string& wanted) {
    std::string name = wanted;
    if (taken_.insert(name).second) return name;
    std::size_t& use = uses_.try_emplace(wanted, 1).first->second;
    do name = numbered(wanted, ++use);
    while (!taken_.insert(name).second);
    return name;
  }

  /// @return a name of which `name_1` to `name_N` are not taken: the wanted one, or that with a number. They are now
  std::string take_numbered(const std::string& wanted, std::size_t count) {
    std::string name = wanted;
    for (std::size_t use = 2; any_is_taken(name, count); ++use) name = numbered(wanted, use);
    for (std::size_t number = 1; number <= count; ++number) taken_.insert(numbered(name, number));
    return name;
  }
  static std::string numbered(const std::string& name, std::size_t number) {
    return name + "_" + std::to_string(number);
  }

 private:
  bool any_is_taken(const std::string& name, std::size_t count) const {
    for (std::size_t number = 1; number <= count; ++number)
      if (taken_.contains(numbered(name, number))) return true;
    return false;
  }

  std::set<std::string> taken_;
  std::map<std::string, std::size_t> uses_;  ///< of names that have been wanted more than once: the last number
};

}  // namespace lodestone
