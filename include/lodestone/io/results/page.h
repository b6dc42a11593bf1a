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

/// What a page shows.
enum class Page_kind {
  detect,      ///< a run: frames with contacts
  partition,   ///< one surface and its regions
  experiment,  ///< a report with plots
};

/// What applies to a page as a whole.
struct Page_head {
  Page_kind kind = Page_kind::detect;        ///< what the viewer shows first
  std::string title;                         ///< plain text
  std::optional<std::string> mode = {};      ///< its name, for a run
  std::optional<std::string> strategy = {};  ///< its name, if surfaces are divided
  std::vector<std::string> states = {};      ///< what the labels of vertices mean; empty: they are regions
  std::size_t first_frame = 0;               ///< frame of the scene that is the page's first
  std::size_t frame_step = 1;                ///< frames of the scene per frame of the page
  double frames_per_second = 30;             ///< of the page, when it plays
  bool first_contacts = false;               ///< of each pair the run listed one contact only
  std::optional<std::string> note = {};      ///< what a reader must know of all frames: plain sentences
  std::optional<std::string> report = {};    ///< Markdown
};

/// Two faces in contact, with the ends of their common segment. If they are coplanar: one side of their common polygon.
/// If they are near but apart: the nearest point of each.
struct Page_contact {
  Object_id a = 0;                                 ///< first object
  std::uint32_t face_a = 0;                        ///< its face
  Object_id b = 0;                                 ///< second object
  std::uint32_t face_b = 0;                        ///< its face
  std::optional<std::array<double, 6>> ends = {};  ///< x y z of each; equal ends: a point
  bool apart = false;                              ///< near, but apart; only with `ends`
};

/// One frame. A part that is empty or missing in the first frame must be empty or missing in all.
struct Page_frame {
  std::vector<Positions> positions;                        ///< per object
  std::vector<std::vector<std::uint32_t>> particles = {};  ///< per object: vertex of each particle, in region order
  std::string numbers = {};                                ///< the frame's line of frames.jsonl, with its line break
  std::string stages = {};                                 ///< times and truth, as a JSON object
  std::optional<std::vector<Candidate_regions>> candidates = {};  ///< none: the run does not list them
  std::optional<std::vector<Page_contact>> contacts = {};         ///< none: the run does not list them
};

/// A plot beside a report.
struct Page_plot {
  std::string name;         ///< that of its file, without the extension
  std::string title;        ///< plain text
  std::string description;  ///< what a reader sees in it, in plain sentences
  std::string spec;         ///< Vega-Lite as JSON, with inline data
};

/// The data that the viewer shows, collected frame by frame and packed as docs/page_format.md describes.
///
/// Positions are quantised to 65536 steps of the object's bounding box over all frames, so all positions stay in memory
/// until the end: 24 bytes per vertex and frame. The same calls give the same bytes.
class Page {
 public:
  /// A page without objects and frames.
  explicit Page(Page_head head) : head_(std::move(head)) {}

  /// Adds an object. All objects come before the first frame.
  /// @throws Bad_argument  a corner that is not a vertex
  Object_id add_object(std::string name, std::uint32_t vertices, std::vector<Corners> corners);
  /// Sets the region of each vertex of an object from the next frame on. Labels that equal the current ones change
  /// nothing.
  /// @throws Bad_argument  no such object, not one label per vertex
  void set_regions(Object_id object, const std::vector<Region_index>& labels);
  /// Adds the next frame.
  /// @throws Bad_argument  the frame differs from the page in its objects or vertices, or from the first frame in its
  ///                       parts
  /// @throws Bad_mesh      a coordinate that is not finite
  void add_frame(Page_frame frame);
  /// Adds a plot, below those added before.
  /// @throws Bad_argument  the specification is not JSON
  void add_plot(Page_plot plot);

  /// The title of the head.
  const std::string& title() const { return head_.title; }
  /// Number of frames added.
  std::size_t frames() const { return frames_.size(); }
  /// The faces of an object.
  const std::vector<Corners>& corners(Object_id object) const { return objects_.at(object).corners; }

  /// The container of docs/page_format.md.
  std::string data() const;

 private:
  struct Partition_from {
    std::size_t frame = 0;  ///< of the page, from which the labels apply
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

/// Frames of a scene per frame of its page: 1, unless the page would have too many frames.
/// @param vertices  of all objects together
/// @param most      maximum number of frames on the page; 0: as many as have 5 million positions together (10 to 35 MB
///                  of page), and at least one
std::size_t page_frame_step(std::size_t frames, std::size_t vertices, std::size_t most = 0);

/// Writes a page: the template with every `@LODESTONE_TITLE@` replaced by the title, escaped for HTML, and
/// `@LODESTONE_DATA@` replaced by the data in base64. The inserted text is not searched for further marks.
/// @return number of bytes
/// @throws Bad_argument  the template does not have `@LODESTONE_DATA@` exactly once
/// @throws Bad_output    as Atomic_file
std::size_t write_page(Atomic_file& file, std::string_view page_template, std::string_view title,
                       std::string_view data);

}  // namespace lodestone
