// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes that the caller gives.
#include "lodestone/bounds/box_promise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "bounds/given_object.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

static_assert(Motion_bound<Promised_boxes> && Motion_promise<Box_promise>);

Aabb shifted(const Aabb& of, double x) {
  Aabb box = of;
  box.low[0] += x;
  box.high[0] += x;
  return box;
}

/// Each region moves along x by its index, and their boxes with it.
TEST(Box_promise, every_vertex_lies_in_the_boxes_of_its_nodes) {
  const Face_soup soup(potato(8));
  Given_object object(soup, 6, octants(soup));
  std::size_t in_one = 0, in_several = 0;
  const Box_promise promise([&](Region_index region, const Aabb& rest) {
    ++(region == several_regions ? in_several : in_one);
    if (region != several_regions) return shifted(rest, region);
    Aabb box;
    box.enclose(rest, shifted(rest, 7));
    return box;
  });
  const Promised_boxes bound = promise.bound(object.bounded());
  ASSERT_EQ(bound.node_count(), object.layout.node_count());
  for (std::uint32_t v = 0; v < object.vertex_count(); ++v) object.now[3 * std::size_t{v}] += object.labels[v];
  EXPECT_EQ(nodes_outside(bound, object), 0U);
  EXPECT_GT(in_one, 10U);
  EXPECT_GT(in_several, 10U);
}

TEST(Box_promise, is_asked_with_the_box_at_rest_and_taken_as_it_is) {
  Given_object object(potato(5));
  const Box_promise promise([](Region_index region, const Aabb& rest) {
    EXPECT_EQ(region, 0U);  // no labels
    return rest;
  });
  const Promised_boxes bound = promise.bound(object.bounded());
  for (std::uint32_t node = 0; node < bound.node_count(); ++node) EXPECT_EQ(bound.box(node), object.fitted_node(node));
}

TEST(Box_promise, refuses_a_box_that_ends_before_it_begins) {
  Given_object object(potato(3));
  int axis = 0;
  const Box_promise promise([&](Region_index, const Aabb& rest) {
    Aabb box = rest;
    std::swap(box.low[axis], box.high[axis]);
    return box;
  });
  const Promised_boxes bound = promise.bound(object.bounded());
  for (axis = 0; axis < 3; ++axis) EXPECT_THROW(bound.box(0), Bad_argument);
}

TEST(Box_promise, opens_axes_that_are_not_finite) {
  Given_object object(potato(3));
  const Box_promise promise([](Region_index, const Aabb& rest) {
    Aabb box = rest;
    box.low[0] = std::nan("");
    box.high[2] = std::numeric_limits<double>::infinity();
    return box;
  });
  const Aabb box = promise.bound(object.bounded()).box(0), rest = object.fitted_node(0);
  for (const int axis : {0, 2}) {
    EXPECT_EQ(box.low[axis], open_box.low[axis]);
    EXPECT_EQ(box.high[axis], open_box.high[axis]);
  }
  EXPECT_EQ(box.low[1], rest.low[1]);
  EXPECT_EQ(box.high[1], rest.high[1]);
}

TEST(Box_promise, that_is_broken_is_noticed_on_what_is_read) {
  Given_object object(potato(8));
  const Box_promise promise([](Region_index, const Aabb& rest) { return rest; });
  Promised_boxes bound = promise.bound(object.bounded());
  const auto surface = object.surface(bound);
  surface->pose(1);
  EXPECT_FALSE(surface->is_broken());
  for (const auto vertex : object.layout.vertices(1)) object.now[3 * std::size_t{vertex}] += 3;
  surface->start_frame();
  surface->pose(1);
  EXPECT_TRUE(surface->is_broken());
}

TEST(Box_promise, refuses_to_be_without_a_function) { EXPECT_THROW(Box_promise{nullptr}, Bad_argument); }

}  // namespace
}  // namespace lodestone
