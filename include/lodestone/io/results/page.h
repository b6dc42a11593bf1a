// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

enum class Page_kind { detect, partition, experiment };

/// What a page says about itself as a whole.
struct Page_head {
  Page_kind kind = Page_kind::detect;
  std::string title;
  std::optional<std::string> mode = {}, strategy = {};
  std::size_t first_frame = 0;  ///< number in the scene of the page's first frame
  std::size_t frame_step = 1;   ///< frames of the scene from one of the page to the next
  double frames_per_second = 30;
  std::optional<std::string> report = {};  ///< Markdown
};

/// Two faces that meet, with the ends of the segment in which they do; or a side of the polygon, if they are coplanar.
struct Page_contact {
  Object_id a = 0;
  std::uint32_t face_a = 0;
  Object_id b = 0;
  std::uint32_t face_b = 0;
  std::optional<std::array<double, 6>> ends = {};  ///< x y z of each; equal ends: a point
};

/// One frame. What is empty or missing in the first frame must be so in all.
struct Page_frame {
  std::vector<Positions> positions;                        ///< per object
  std::vector<std::vector<std::uint32_t>> particles = {};  ///< per object: vertex of each particle, in region order
  std::string numbers = {};                                ///< the frame's line of frames.jsonl, line break included
  std::string stages = {};                                 ///< times and truth: a JSON object
  std::optional<std::vector<Candidate_regions>> candidates = {};
  std::optional<std::vector<Page_contact>> contacts = {};
};

struct Page_plot {
  std::string name, title, description;
  std::string spec;  ///< Vega-Lite, its data inline: JSON
};

/// What the viewer shows, gathered frame by frame and packed as docs/page_format.md says.
///
/// Positions are rounded to 65536 steps of the box that an object needs over all frames, so they are kept until the
/// end: 24 bytes per vertex and frame. The same calls give the same bytes.
class Page {
 public:
  explicit Page(Page_head head) : head_(std::move(head)) {}

  /// Adds an object. All objects come before the first frame.
  /// @throws Bad_argument  a corner that is no vertex
  Object_id add_object(std::string name, std::uint32_t vertices, std::vector<Corners> corners);
  /// The region of each vertex of an object from the next frame on. Labels that hold already change nothing.
  /// @throws Bad_argument  no such object, another number of labels than of vertices
  void set_regions(Object_id object, const std::vector<Region_index>& labels);
  /// @throws Bad_argument  other objects or vertices than the page has, a part that earlier frames have or lack
  /// @throws Bad_mesh      a coordinate that is not finite
  void add_frame(Page_frame frame);
  /// @throws Bad_argument  its specification is not JSON
  void add_plot(Page_plot plot);

  const std::string& title() const { return head_.title; }
  std::size_t frames() const { return frames_.size(); }
  const std::vector<Corners>& corners(Object_id object) const { return objects_.at(object).corners; }

  /// The container.
  std::string data() const;

 private:
  struct Partition_from {
    std::size_t frame = 0;  ///< of the page
    std::size_t regions = 0;
    std::vector<Region_index> labels;
  };
  struct Object {
    std::string name;
    std::uint32_t vertices = 0;
    std::vector<Corners> corners;
    std::vector<Partition_from> partitions = {};
    Box box = {};  ///< over all frames
  };

  Page_head head_;
  std::vector<Object> objects_;
  std::vector<Page_frame> frames_;
  std::vector<Page_plot> plots_;
};

/// How many frames of a scene lie between two of its page: 1, unless the page would get too long.
/// @param vertices  of all objects together
/// @param most      frames of the page, at most; 0: as many as hold 5 million positions (about 15 MB of
///                  page), and at least one
std::size_t page_frame_step(std::size_t frames, std::size_t vertices, std::size_t most = 0);

/// Writes a page: the template with the title in each place of `@LODESTONE_TITLE@`, escaped for HTML, and the data,
/// as base64, in that of `@LODESTONE_DATA@`. Neither is looked through for further places.
/// @return number of bytes
/// @throws Bad_argument  the template has not one place for the data
/// @throws Bad_output    as Atomic_file
std::size_t write_page(Atomic_file& file, std::string_view page_template, std::string_view title,
                       std::string_view data);

}  // namespace lodestone
