// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/made_character.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace lodestone {

namespace {

using Eigen::Vector3d;

constexpr std::size_t most_joints_per_vertex = 4;

/// Adds a joint and the capsule that it moves, from the joint on. Returns the joint's index.
std::size_t add_limb(Made_character& character, Made_joint joint, const Vector3d& to, double radius_from,
                     double radius_to) {
  const std::size_t index = character.joints.size();
  character.capsules.push_back(
      {.joint = index, .from = joint.at, .to = to, .radius_from = radius_from, .radius_to = radius_to});
  character.joints.push_back(std::move(joint));
  return index;
}

/// A chain of joints along a line, which all bend about the same axis.
void add_finger(Made_character& hand, const std::string& name, Vector3d at, const Vector3d& along,
                const std::vector<double>& lengths, double radius, double phase) {
  const Vector3d direction = along.normalized();
  const Vector3d axis = Vector3d::UnitZ().cross(direction).normalized();
  std::size_t parent = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const Vector3d to = at + lengths[i] * direction;
    parent = add_limb(hand,
                      {.name = fmt::format("{}_{}", name, i + 1),
                       .parent = parent,
                       .at = at,
                       .axis = axis,
                       .middle = 0.25,
                       .swing = 0.35,
                       .phase = phase},
                      to, radius, 0.9 * radius);
    radius *= 0.9;
    at = to;
  }
}

/// The fingers point along x, and the palm looks down.
Made_character hand() {
  Made_character hand{.name = "hand", .surface = {.cell = 0.088, .rounding = 0.02}, .blend = 0.1};
  hand.joints.push_back(
      {.name = "wrist", .at = Vector3d::Zero(), .axis = Vector3d::UnitY(), .swing = 0.15, .phase = 0.1});
  const std::vector<double> places{-0.45, -0.15, 0.15, 0.45}, sizes{0.9, 1, 0.95, 0.75};
  for (const double y : places)
    hand.capsules.push_back({.from = {0, 0.6 * y, 0}, .to = {0.95, y, 0}, .radius_from = 0.2, .radius_to = 0.15});
  for (std::size_t i = 0; i < places.size(); ++i)
    add_finger(hand, fmt::format("finger_{}", i + 1), {1.02, places[i], 0}, {1, 0.4 * places[i], 0},
               {0.42 * sizes[i], 0.32 * sizes[i], 0.24 * sizes[i]}, 0.105, 0.2 * static_cast<double>(i));
  add_finger(hand, "thumb", {0.3, -0.35, 0}, {0.7, -0.75, -0.1}, {0.5, 0.35}, 0.13, 0.7);
  return hand;
}

/// Looks along x. Its head does not move: only morph targets do.
Made_character face() {
  Made_character face{.name = "face", .surface = {.cell = 0.135, .rounding = 0.04}};
  face.capsules = {{.from = {0, 0, 0.2}, .to = {0.05, 0, -0.2}, .radius_from = 0.65, .radius_to = 0.55},
                   {.from = {0.3, 0, -0.55}, .to = {0.36, 0, -0.6}, .radius_from = 0.24, .radius_to = 0.22},
                   {.from = {0.5, 0, 0.1}, .to = {0.72, 0, -0.15}, .radius_from = 0.08, .radius_to = 0.12},
                   {.from = {0.5, -0.3, 0.22}, .to = {0.5, 0.3, 0.22}, .radius_from = 0.13, .radius_to = 0.13},
                   {.from = {-0.05, -0.6, 0}, .to = {-0.05, -0.68, 0.1}, .radius_from = 0.12, .radius_to = 0.14},
                   {.from = {-0.05, 0.6, 0}, .to = {-0.05, 0.68, 0.1}, .radius_from = 0.12, .radius_to = 0.14},
                   {.from = {-0.12, 0, -0.5}, .to = {-0.15, 0, -1.1}, .radius_from = 0.33, .radius_to = 0.38}};
  face.targets = {
      {.name = "jaw", .centre = {0.35, 0, -0.65}, .reach = 0.6, .offset = {-0.06, 0, -0.16}, .turns = 3},
      {.name = "cheek_left", .centre = {0.4, 0.4, -0.2}, .reach = 0.35, .offset = {0.08, 0.08, 0.02}},
      {.name = "cheek_right", .centre = {0.4, -0.4, -0.2}, .reach = 0.35, .offset = {0.08, -0.08, 0.02}},
      {.name = "brows", .centre = {0.55, 0, 0.3}, .reach = 0.5, .offset = {0, 0, 0.12}, .turns = 2},
      {.name = "blink_left", .centre = {0.55, 0.25, 0.1}, .reach = 0.2, .offset = {0.04, 0, -0.05}, .turns = 5},
      {.name = "blink_right", .centre = {0.55, -0.25, 0.1}, .reach = 0.2, .offset = {0.04, 0, -0.05}, .turns = 5},
      {.name = "smile", .centre = {0.5, 0, -0.45}, .reach = 0.4, .offset = {0.02, 0, 0.09}, .phase = 0.4},
      {.name = "nose", .centre = {0.75, 0, -0.12}, .reach = 0.3, .offset = {0.06, 0, 0.05}, .turns = 2}};
  return face;
}

void add_leg(Made_character& body, const std::string& side, double y, double phase) {
  const auto thigh = add_limb(
      body, {.name = "thigh_" + side, .at = {0, y, 0.9}, .middle = -0.1, .swing = 0.35, .turns = 2, .phase = phase},
      {0, y, 0.5}, 0.1, 0.075);
  const auto shin = add_limb(body,
                             {.name = "shin_" + side,
                              .parent = thigh,
                              .at = {0, y, 0.5},
                              .middle = 0.35,
                              .swing = 0.3,
                              .turns = 2,
                              .phase = phase + 0.2},
                             {0, y, 0.1}, 0.07, 0.055);
  add_limb(body, {.name = "foot_" + side, .parent = shin, .at = {0, y, 0.06}, .swing = 0.2, .turns = 2, .phase = phase},
           {0.18, y, 0.04}, 0.055, 0.05);
}

/// Stretches its right arm forwards; the left one hangs.
void add_arms(Made_character& body, std::size_t chest) {
  const auto upper =
      add_limb(body, {.name = "upper_arm_right", .parent = chest, .at = {0, -0.28, 1.4}, .swing = 0.15, .phase = 0.3},
               {0.28, -0.36, 1.36}, 0.065, 0.055);
  const auto lower = add_limb(body, {.name = "forearm_right", .parent = upper, .at = {0.28, -0.36, 1.36}, .swing = 0.2},
                              {0.54, -0.37, 1.36}, 0.055, 0.045);
  add_limb(body, {.name = "hand_right", .parent = lower, .at = {0.56, -0.37, 1.36}, .swing = 0.3, .turns = 3},
           {0.72, -0.37, 1.36}, 0.05, 0.04);
  const auto hanging = add_limb(
      body, {.name = "upper_arm_left", .parent = chest, .at = {0, 0.28, 1.4}, .swing = 0.3, .turns = 2, .phase = 0.5},
      {0, 0.42, 1.12}, 0.065, 0.055);
  const auto forearm = add_limb(body,
                                {.name = "forearm_left",
                                 .parent = hanging,
                                 .at = {0, 0.42, 1.12},
                                 .middle = -0.4,
                                 .swing = 0.3,
                                 .turns = 2,
                                 .phase = 0.5},
                                {0.02, 0.47, 0.87}, 0.055, 0.045);
  add_limb(body, {.name = "hand_left", .parent = forearm, .at = {0.02, 0.48, 0.85}, .swing = 0.2}, {0.04, 0.49, 0.7},
           0.05, 0.04);
}

/// Walks along x on the spot, and breathes.
Made_character body() {
  Made_character body{.name = "body", .surface = {.cell = 0.055, .rounding = 0.015}, .blend = 0.08};
  body.joints.push_back({.name = "hips", .at = {0, 0, 0.95}, .axis = Vector3d::UnitZ(), .swing = 0.08, .turns = 2});
  body.capsules.push_back({.from = {0, -0.07, 0.95}, .to = {0, 0.07, 0.95}, .radius_from = 0.14, .radius_to = 0.14});
  const auto spine = add_limb(
      body, {.name = "spine", .at = {0, 0, 1.02}, .axis = Vector3d::UnitZ(), .swing = 0.06, .turns = 2, .phase = 0.5},
      {0, 0, 1.2}, 0.13, 0.14);
  const auto chest =
      add_limb(body, {.name = "chest", .parent = spine, .at = {0, 0, 1.22}, .middle = 0.05, .swing = 0.04},
               {0, 0, 1.38}, 0.15, 0.14);
  body.capsules.push_back(
      {.joint = chest, .from = {0, -0.22, 1.4}, .to = {0, 0.22, 1.4}, .radius_from = 0.08, .radius_to = 0.08});
  const auto neck =
      add_limb(body, {.name = "neck", .parent = chest, .at = {0, 0, 1.48}, .swing = 0.1}, {0.01, 0, 1.58}, 0.06, 0.06);
  add_limb(body, {.name = "head", .parent = neck, .at = {0.01, 0, 1.62}, .axis = Vector3d::UnitZ(), .swing = 0.3},
           {0.02, 0, 1.76}, 0.1, 0.11);
  add_arms(body, chest);
  add_leg(body, "right", -0.16, 0);
  add_leg(body, "left", 0.16, 0.5);
  body.targets = {
      {.name = "breath", .centre = {0.12, 0, 1.3}, .reach = 0.25, .offset = {0.04, 0, 0.01}, .turns = 3},
      {.name = "belly", .centre = {0.12, 0, 1.1}, .reach = 0.2, .offset = {0.05, 0, 0}, .turns = 3, .phase = 0.3},
      {.name = "biceps", .centre = {0.14, -0.32, 1.4}, .reach = 0.12, .offset = {0, 0, 0.03}, .turns = 2},
      {.name = "chin", .centre = {0.12, 0, 1.66}, .reach = 0.08, .offset = {0.03, 0, -0.02}, .turns = 4}};
  return body;
}

}  // namespace

Vector3d Made_target::offset_at(const Vector3d& point) const {
  const double apart = (point - centre).squaredNorm() / (reach * reach);
  return apart < 1 ? ((1 - apart) * (1 - apart) * offset).eval() : Vector3d::Zero();
}

const std::vector<Made_character>& made_characters() {
  static const std::vector<Made_character> characters{hand(), face(), body()};
  return characters;
}

std::vector<std::pair<std::size_t, double>> joints_at(const Made_character& character, const Vector3d& point) {
  std::vector<double> distances(character.joints.size(), std::numeric_limits<double>::infinity());
  for (const auto& capsule : character.capsules)
    distances[capsule.joint] = std::min(distances[capsule.joint], capsule.distance(point));
  const auto nearest = static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
  std::vector<std::pair<std::size_t, double>> found;
  for (std::size_t joint = 0; joint < distances.size(); ++joint) {
    const bool is_kin =
        joint == nearest || character.joints[nearest].parent == joint || character.joints[joint].parent == nearest;
    const double weight = 1 - (distances[joint] - distances[nearest]) / character.blend;
    if (is_kin && weight > 0) found.emplace_back(joint, weight * weight);
  }
  std::ranges::sort(found, std::ranges::greater(), [](const auto& f) { return f.second; });
  found.resize(std::min(found.size(), most_joints_per_vertex));
  double sum = 0;
  for (const auto& [joint, weight] : found) sum += weight;
  for (auto& [joint, weight] : found) weight /= sum;
  return found;
}

}  // namespace lodestone
