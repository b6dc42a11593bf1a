// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/files/byte_order.h"
#include "io/results/page_sections.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view magic = "LDSTPAGE";
constexpr std::uint32_t version = 1;

constexpr std::string_view name_of(Page_kind kind) {
  constexpr std::string_view names[] = {"detect", "partition", "experiment"};
  return names[static_cast<int>(kind)];
}

Json text_or_null(const std::optional<std::string>& text) { return text ? Json(*text) : Json(); }

Json box_json(const Box& box) {
  if (box.isEmpty()) return {0, 0, 0, 0, 0, 0};
  return {box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()};
}

/// The sections of a container, with the names that its header uses for them.
class Section_list {
 public:
  std::string add(std::string name, const Section& section) {
    places_[name] = {{"offset", bytes_.size()}, {"bytes", section.bytes.size()}, {"raw", section.raw}};
    bytes_ += section.bytes;
    return name;
  }
  const Json& places() const { return places_; }
  const std::string& bytes() const { return bytes_; }

 private:
  Json places_ = Json::object();
  std::string bytes_;
};

Json plots_json(const std::vector<Page_plot>& plots) {
  Json json = Json::array();
  for (const auto& plot : plots)
    json.push_back({{"name", plot.name},
                    {"title", plot.title},
                    {"description", plot.description},
                    {"spec", Json::parse(plot.spec)}});
  return json;
}

std::string container(const std::string& header, const std::string& sections) {
  std::string bytes(magic);
  append(bytes, version);
  append(bytes, static_cast<std::uint32_t>(header.size()));
  return bytes + header + sections;
}

/// @throws Bad_argument  the two frames have different parts
void check_parts(const Page_frame& first, const Page_frame& frame) {
  if (frame.particles.size() != first.particles.size() || frame.numbers.empty() != first.numbers.empty() ||
      frame.stages.empty() != first.stages.empty() || frame.candidates.has_value() != first.candidates.has_value() ||
      frame.contacts.has_value() != first.contacts.has_value())
    throw Bad_argument("a frame of a page must have exactly the parts of the first frame");
}

}  // namespace

Object_id Page::add_object(std::string name, std::uint32_t vertices, std::vector<Corners> corners) {
  if (!frames_.empty()) throw Bad_argument("objects must be added before the first frame of a page");
  for (const auto& face : corners)
    for (const auto corner : face)
      if (corner >= vertices) throw Bad_argument(fmt::format("a face refers to vertex {} of {}", corner, vertices));
  objects_.push_back({.name = std::move(name), .vertices = vertices, .corners = std::move(corners)});
  return static_cast<Object_id>(objects_.size() - 1);
}

void Page::set_regions(Object_id object, const std::vector<Region_index>& labels) {
  if (object >= objects_.size()) throw Bad_argument(fmt::format("the page has no object {}", object));
  auto& [name, vertices, corners, partitions, box] = objects_[object];
  if (labels.size() != vertices) throw Bad_argument(fmt::format("{} labels for {} vertices", labels.size(), vertices));
  if (!partitions.empty() && partitions.back().labels == labels) return;
  if (!partitions.empty() && partitions.back().frame == frames_.size()) partitions.pop_back();
  const std::size_t regions = labels.empty() ? 0 : std::size_t{*std::ranges::max_element(labels)} + 1;
  partitions.push_back({.frame = frames_.size(), .regions = regions, .labels = labels});
}

void Page::add_frame(Page_frame frame) {
  const std::size_t objects = objects_.size();
  if (frame.positions.size() != objects || (!frame.particles.empty() && frame.particles.size() != objects))
    throw Bad_argument(fmt::format("the frame has {} objects, the page {}", frame.positions.size(), objects));
  check_parts(frames_.empty() ? frame : frames_.front(), frame);
  for (std::size_t o = 0; o < objects; ++o) {
    if (frame.positions[o].rows() != objects_[o].vertices)
      throw Bad_argument(fmt::format("{} positions for {} vertices", frame.positions[o].rows(), objects_[o].vertices));
    if (!frame.positions[o].allFinite())
      throw Bad_mesh(fmt::format("object {} has a coordinate that is not finite", o));
    for (const auto& row : frame.positions[o].rowwise()) objects_[o].box.extend(row.transpose());
  }
  frames_.push_back(std::move(frame));
}

void Page::add_plot(Page_plot plot) {
  if (!Json::accept(plot.spec)) throw Bad_argument("the specification of plot " + plot.name + " is not JSON");
  plots_.push_back(std::move(plot));
}

std::size_t page_frame_step(std::size_t frames, std::size_t vertices, std::size_t most) {
  constexpr std::size_t positions = 5'000'000;
  if (most == 0) most = std::max<std::size_t>(1, positions / std::max<std::size_t>(1, vertices));
  return std::max<std::size_t>(1, (frames + most - 1) / most);
}

std::string Page::data() const {
  Section_list sections;
  const Page_frame nothing{.positions = {}};
  const Page_frame& first = frames_.empty() ? nothing : frames_.front();
  const auto section_if = [&](bool there, const char* name, Section (*section)(std::span<const Page_frame>)) {
    return there ? Json(sections.add(name, section(frames_))) : Json();
  };

  Json objects = Json::array();
  for (Object_id o = 0; o < objects_.size(); ++o) {
    const Object& object = objects_[o];
    Json partitions = Json::array();
    for (const auto& [frame, regions, labels] : object.partitions)
      partitions.push_back({{"frame", frame},
                            {"regions", regions},
                            {"labels", sections.add(fmt::format("labels_{}_{}", o, frame), labels_section(labels))}});
    const bool particles = !first.particles.empty();
    objects.push_back(
        {{"name", object.name},
         {"vertices", object.vertices},
         {"triangles", object.corners.size()},
         {"box", box_json(object.box)},
         {"topology", sections.add(fmt::format("topology_{}", o), topology_section(object.corners))},
         {"positions", sections.add(fmt::format("positions_{}", o), positions_section(frames_, o, object.box))},
         {"partitions", std::move(partitions)},
         {"particles",
          particles ? Json(sections.add(fmt::format("particles_{}", o), particles_section(frames_, o))) : Json()}});
  }
  Json header{{"kind", name_of(head_.kind)},
              {"title", head_.title},
              {"mode", text_or_null(head_.mode)},
              {"strategy", text_or_null(head_.strategy)},
              {"states", head_.states.empty() ? Json() : Json(head_.states)},
              {"frames", frames_.size()},
              {"first_frame", head_.first_frame},
              {"frame_step", head_.frame_step},
              {"frames_per_second", head_.frames_per_second},
              {"first_contacts", head_.first_contacts},
              {"note", text_or_null(head_.note)},
              {"objects", std::move(objects)},
              {"numbers", section_if(!first.numbers.empty(), "numbers", numbers_section)},
              {"stages", section_if(!first.stages.empty(), "stages", stages_section)},
              {"candidates", section_if(first.candidates.has_value(), "candidates", candidates_section)},
              {"contacts", section_if(first.contacts.has_value(), "contacts", contacts_section)},
              {"plots", plots_json(plots_)},
              {"report", text_or_null(head_.report)}};
  header["sections"] = sections.places();
  return container(header.dump(-1, ' ', false, Json::error_handler_t::replace), sections.bytes());
}

}  // namespace lodestone
