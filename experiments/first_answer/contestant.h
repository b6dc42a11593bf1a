// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/pairs.h"

/// What takes part in the experiment `first_answer`: ways to ask about two meshes, once or again and again.
namespace lodestone {

/// What one way keeps of two meshes between two questions. The first is asked right after it has been made.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;

  /// Follows the meshes, whose vertices have moved since the last question.
  virtual void update() {}
  virtual bool any() = 0;
  /// Adds all face pairs that intersect, in any order. Only for those that report them.
  virtual void all(std::vector<Face_pair>& found) = 0;
};

struct Once_contestant {
  std::string library, method;
  bool reports_pairs = true;
  /// Makes what the question needs of two meshes, which outlive it.
  std::function<std::unique_ptr<Session>(const Surface_mesh& a, const Surface_mesh& b, Contact_query query)> begin;

  std::string name() const { return library + ": " + method; }
};

/// `find_collisions`, a Detector, and all peers on one thread.
std::vector<Once_contestant> once_contestants();

}  // namespace lodestone
