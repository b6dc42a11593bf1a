// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/find_collisions.h"

#include <utility>

namespace lodestone {

Collisions collisions_of(Frame&& frame) {
  if (frame.pairs.empty()) {
    Collisions none;
    none.statistics = frame.statistics;
    return none;
  }
  return {.collides = frame.collides(),
          .near = frame.near(),
          .faces = std::move(frame.face_pairs),
          .intersects = std::move(frame.contact_intersects),
          .points = std::move(frame.contact_points),
          .normals = std::move(frame.contact_normals),
          .capped = frame.capped(),
          .containment = frame.pairs.front().containment,
          .parting = frame.pairs.front().parting,
          .patches = std::move(frame.patches),
          .unfinished = frame.unfinished(),
          .statistics = frame.statistics};
}

template std::optional<Frame> frame_at_once(const Surface_mesh&, Own_points<Surface_mesh>, const Surface_mesh&,
                                            Own_points<Surface_mesh>, const Detector_options&);
template Frame self_frame_at_once(const Surface_mesh&, Own_points<Surface_mesh>, Detector_options,
                                  std::span<const std::uint32_t>);
template std::optional<Frame> frame_at_once(const Indexed_mesh&, Own_points<Indexed_mesh>, const Indexed_mesh&,
                                            Own_points<Indexed_mesh>, const Detector_options&);
template Frame self_frame_at_once(const Indexed_mesh&, Own_points<Indexed_mesh>, Detector_options,
                                  std::span<const std::uint32_t>);

}  // namespace lodestone
