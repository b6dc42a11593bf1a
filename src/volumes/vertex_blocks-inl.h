// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_VERTEX_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_VERTEX_BLOCKS_INL_H
#undef LODESTONE_VERTEX_BLOCKS_INL_H
#else
#define LODESTONE_VERTEX_BLOCKS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

#include "lodestone/volumes/leaf_faces.h"
#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Vertices are handled eight at a time, in as many vectors as it takes to hold eight doubles: so results do not depend
/// on the instruction set.
constexpr std::size_t block_vertices = 8;
constexpr std::size_t block_vectors = block_vertices / double_lanes;

/// The positions of eight vertices.
struct Vertex_block {
  Vector3<Double_lanes> of[block_vectors];
};

/// The vertices of a leaf in blocks of eight. Only the last vertex may be the last of the mesh.
struct Vertex_blocks {
  const Leaf_faces& faces;
  std::size_t last;  ///< index of the last vertex

  explicit Vertex_blocks(const Leaf_faces& leaf) : faces(leaf), last(leaf.vertices.size() - 1) {}

  /// Index of the first vertex of the last block, which has one to eight vertices.
  std::size_t last_block() const { return last / block_vertices * block_vertices; }

  /// A block before the last one.
  HWY_INLINE Vertex_block load(std::size_t first) const {
    Vertex_block block;
    for (std::size_t i = 0; i < block_vectors; ++i)
      block.of[i] = load_inner_positions([&](std::size_t lane)
                                             HWY_ATTR { return faces.position(first + i * double_lanes + lane); });
    return block;
  }
  /// The last block, in which the last vertex is repeated.
  HWY_INLINE Vertex_block load_last() const {
    Vertex_block block;
    for (std::size_t i = 0; i < block_vectors; ++i)
      block.of[i] = load_positions([&](std::size_t lane) HWY_ATTR {
        return faces.position(std::min(last_block() + i * double_lanes + lane, last));
      });
    return block;
  }
};

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
