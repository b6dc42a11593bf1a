// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <utility>

/// Switches by which one build holds all mutants of scripts/mutate: the environment variable `LODESTONE_MUTANT` turns
/// one of them on. At its end a process appends the numbers of all mutants that it came to, to the file that
/// `LODESTONE_REACHED` names.
namespace lodestone_mutation {

struct Record {
  int active = 0;
  const char* file = nullptr;
  std::array<std::atomic<bool>, 4096> reached{};

  Record() {
    if (const char* text = std::getenv("LODESTONE_MUTANT")) active = std::atoi(text);
    file = std::getenv("LODESTONE_REACHED");
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;
  ~Record() {
    if (file == nullptr) return;
    std::FILE* out = std::fopen(file, "a");
    if (out == nullptr) return;
    for (std::size_t mutant = 0; mutant < reached.size(); ++mutant)
      if (reached[mutant]) std::fprintf(out, "%zu\n", mutant);
    std::fclose(out);
  }
};
inline Record record;

/// Whether the mutant is on. Not constexpr: what the compiler must know cannot be switched, and does not compile.
inline bool on(int mutant) {
  if (record.file != nullptr) record.reached[static_cast<std::size_t>(mutant)].store(true, std::memory_order_relaxed);
  return record.active == mutant;
}

/// Stands within a binary operator: `a + b` becomes `a + operation<7> + b`, so that what binds how stays the same.
template<int mutant>
struct Operation {};
template<int mutant>
inline constexpr Operation<mutant> operation{};

/// The left operand of a switched operator.
template<class Left, int mutant>
struct Operand {
  Left&& left;
};

#define LODESTONE_SWITCH(original, mutated)                                                                 \
  template<class Left, int mutant>                                                                          \
  Operand<Left, mutant> operator original(Left&& left, Operation<mutant>) {                                 \
    return {std::forward<Left>(left)};                                                                      \
  }                                                                                                         \
  template<class Left, int mutant, class Right>                                                             \
  auto operator original(Operand<Left, mutant> operand, Right&& right) {                                    \
    return on(mutant) ? operand.left mutated right : operand.left original right;                           \
  }
LODESTONE_SWITCH(<, <=)
LODESTONE_SWITCH(<=, <)
LODESTONE_SWITCH(>, >=)
LODESTONE_SWITCH(>=, >)
LODESTONE_SWITCH(==, !=)
LODESTONE_SWITCH(!=, ==)
LODESTONE_SWITCH(+, -)
LODESTONE_SWITCH(-, +)
LODESTONE_SWITCH(*, /)
LODESTONE_SWITCH(/, *)
#undef LODESTONE_SWITCH

/// `a += b` becomes `a += operation<7> += b`, which takes the right operand first.
#define LODESTONE_SWITCH(original, mutated)                                                                 \
  template<int mutant, class Right>                                                                         \
  Operand<Right, mutant> operator original(Operation<mutant>, Right&& right) {                              \
    return {std::forward<Right>(right)};                                                                    \
  }                                                                                                         \
  template<class Left, int mutant, class Right>                                                             \
  decltype(auto) operator original(Left&& left, Operand<Right, mutant> operand) {                           \
    if (on(mutant)) return left mutated operand.left;                                                       \
    return left original operand.left;                                                                      \
  }
LODESTONE_SWITCH(+=, -=)
LODESTONE_SWITCH(-=, +=)
#undef LODESTONE_SWITCH

/// `!a` becomes `operation<7> ->* a`, which binds nearly as tightly.
template<int mutant, class Right>
bool operator->*(Operation<mutant>, const Right& right) {
  return on(mutant) ? static_cast<bool>(right) : !right;
}

/// The lesser of values, or the greater if the mutant is on; and the other way round.
template<int mutant>
struct Least {
  template<class T>
  static T of(const T& a, const T& b) {
    return on(mutant) ? std::max(a, b) : std::min(a, b);
  }
  template<class T>
  static T of(std::initializer_list<T> values) {
    return on(mutant) ? std::max(values) : std::min(values);
  }
};
template<int mutant>
struct Greatest {
  template<class T>
  static T of(const T& a, const T& b) {
    return on(mutant) ? std::min(a, b) : std::max(a, b);
  }
  template<class T>
  static T of(std::initializer_list<T> values) {
    return on(mutant) ? std::min(values) : std::max(values);
  }
};

}  // namespace lodestone_mutation
