// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/pair_contacts.h"

namespace lodestone {

/// Searches many pairs of small objects side by side, each by one worker: a single one of them is over before another
/// thread has been woken. Keeps its memory from one frame to the next.
template <Bounding_volume Volume>
class Small_pairs {
 public:
  using Surface = Basic_tree_surface<Volume>;  ///< of an object

  /// @param workers  must outlive this
  explicit Small_pairs(Workers& workers) : workers_(workers) {}

  /// Whether the objects of a pair are small enough.
  static bool are_small(const Surface& a, const Surface& b) {
    return a.tree().leaf_count() + b.tree().leaf_count() < 1024;
  }

  /// Forgets all questions.
  void clear() { question_count_ = next_ = 0; }
  /// Asks about a pair of objects, or one with itself if both are the same, which may be asked about once.
  /// @param pair  number of the pair, ascending
  void ask(std::size_t pair, const Surface& a, const Surface& b, const Contact_request& request) {
    if (question_count_ == questions_.size()) questions_.emplace_back();
    Question& question = questions_[question_count_++];
    question.pair = pair, question.a = &a, question.b = &b, question.request = request;
  }
  /// Answers all questions, or forgets them if they are too few to be shared.
  void answer();
  /// What was found for a pair; null if it was not asked about. Called in ascending order.
  /// @param found       the contacts are appended
  /// @param intersects  with a tolerance: see `pair_contacts`
  const Pair_contacts* take(std::size_t pair, std::vector<Face_pair>& found, std::vector<std::uint8_t>& intersects) {
    if (next_ == question_count_ || questions_[next_].pair != pair) return nullptr;
    const Question& question = questions_[next_++];
    found.insert(found.end(), question.found.begin(), question.found.end());
    intersects.insert(intersects.end(), question.intersects.begin(), question.intersects.end());
    return &question.contacts;
  }

 private:
  struct Question {
    std::size_t pair = 0;
    const Surface* a = nullptr;
    const Surface* b = nullptr;
    Contact_request request;
    // The answer.
    Pair_contacts contacts;
    std::vector<Face_pair> found;
    std::vector<std::uint8_t> intersects;
  };

  /// With fewer questions than this per worker, the last to be answered can keep one of them busy for long.
  static constexpr std::size_t least_per_worker = 4;

  Workers& workers_;
  std::vector<Basic_contact_search<Volume>> searches_;  ///< per worker
  std::vector<Question> questions_;                     ///< then memory of earlier ones
  std::size_t question_count_ = 0;
  std::size_t next_ = 0;  ///< the question whose answer is taken next
};

template <Bounding_volume Volume>
void Small_pairs<Volume>::answer() {
  if (question_count_ < least_per_worker * workers_.count()) return clear();
  while (searches_.size() < workers_.count()) searches_.emplace_back(Workers::alone());
  workers_.run(question_count_, [&](std::size_t index, std::size_t worker) {
    Question& question = questions_[index];
    const auto search = [&](const Contact_request& request, std::vector<Face_pair>& found) {
      return question.a == question.b ? searches_[worker].within(*question.a, request, found)
                                      : searches_[worker].between(*question.a, *question.b, request, found);
    };
    question.found.clear(), question.intersects.clear();
    question.contacts = pair_contacts(question.request, search, question.found, question.intersects);
  });
}

}  // namespace lodestone
