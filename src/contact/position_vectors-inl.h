// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_POSITION_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_POSITION_VECTORS_INL_H
#undef LODESTONE_POSITION_VECTORS_INL_H
#else
#define LODESTONE_POSITION_VECTORS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A position fills one vector of four lanes, two of two or four of one. The lane past z holds what follows in memory,
// the next vertex, and means nothing.
#if HWY_TARGET == HWY_SCALAR
constexpr std::size_t lanes = 1;
#else
constexpr std::size_t lanes = HWY_MAX_BYTES >= 32 ? 4 : 2;
#endif
constexpr std::size_t vectors = 4 / lanes;
using Position_tag = hn::CappedTag<double, lanes>;

/// Vector i of a vertex that may be the last of the mesh: nothing past its z is read.
HWY_INLINE hn::Vec<Position_tag> load_last(const double* vertex, std::size_t i) {
  const Position_tag d;
  const std::size_t held = 3 - i * lanes < lanes ? 3 - i * lanes : lanes;
  return hn::MaskedLoad(hn::FirstN(d, held), d, vertex + i * lanes);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
