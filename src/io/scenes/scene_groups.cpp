// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/scene_groups.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>

namespace lodestone::detail {

namespace {

constexpr std::size_t most_groups = 32;

/// The bit of each group, in the order in which the scene names them.
class Group_bits {
 public:
  /// @param place  for the message
  std::uint32_t of_member(const std::string& name, const Json_value& place) {
    const auto [group, is_new] = bits_.try_emplace(name, bits_.size());
    if (is_new && bits_.size() > most_groups)
      place.fail(
          fmt::format("group {} is one too many: a scene has at most {}, with \"default\", that of objects "
                      "without the key \"groups\"",
                      as_json(name), most_groups));
    return std::uint32_t{1} << group->second;
  }
  std::uint32_t of_met(const Json_value& name) const {
    const auto group = bits_.find(name.text());
    if (group == bits_.end())
      name.fail(fmt::format("there is no group {}: no object has it in its \"groups\"", as_json(name.text())));
    return std::uint32_t{1} << group->second;
  }

 private:
  std::map<std::string, std::size_t> bits_;
};

std::uint32_t read_membership(const Json_value& object, Group_bits& bits) {
  const auto groups = object.find("groups");
  if (!groups) return bits.of_member("default", object);
  std::uint32_t member = 0;
  for (const auto& name : groups->elements(most_groups)) member |= bits.of_member(name.text(), name);
  return member;
}

}  // namespace

void read_groups(const Json_value& value, std::vector<Scene_object>& objects) {
  const auto elements = value.elements(objects.size());
  Group_bits bits;
  for (std::size_t o = 0; o < objects.size(); ++o) objects[o].collision.groups = read_membership(elements[o], bits);
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (!elements[o].has("meets")) continue;
    auto& meets = objects[o].collision.meets = 0;
    for (const auto& name : elements[o].list("meets", most_groups)) meets |= bits.of_met(name);
  }
}

}  // namespace lodestone::detail
