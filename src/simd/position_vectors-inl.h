// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_POSITION_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_POSITION_VECTORS_INL_H
#undef LODESTONE_POSITION_VECTORS_INL_H
#else
#define LODESTONE_POSITION_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

// A position fills one vector of four lanes, two of two, or four of one where there are no vectors.
using D = hwy::HWY_NAMESPACE::CappedTag<double, 4>;
constexpr std::size_t lanes = hwy::HWY_NAMESPACE::MaxLanes(D());
constexpr std::size_t vectors = 4 / lanes;

/// Vector `i` of a vertex that may be the last of the mesh: nothing past its z is read. The lane past z means nothing.
///
/// `MaskedLoad` keeps to its mask, and needs no alignment, only where the machine has such an instruction: with four
/// lanes it does.
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load_last(const double* vertex, std::size_t i) {
  namespace hn = hwy::HWY_NAMESPACE;
  if constexpr (lanes == 4) return hn::MaskedLoad(hn::FirstN(D(), 3), D(), vertex);
  return (i + 1) * lanes <= 3 ? hn::LoadU(D(), vertex + i * lanes) : hn::Set(D(), vertex[2]);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
