// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>

#include "detector.h"
#include "io/files/small_text.h"
#include "io/results/frame_json.h"
#include "io/results/page_frame.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/results/page.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/saved_state.h"
#include "program/missed_frames.h"
#include "program/viewer.h"

/// The viewer's page of the frames of a detector.
namespace lodestone::python {

namespace {

using Json = nlohmann::ordered_json;
using Shown_object = Python_detector::Shown_object;

std::string title_of_object(const Shown_object& object, std::size_t id) {
  return object.name.empty() ? "object " + std::to_string(id) : object.name;
}

Triangle triangle_of_face(const Shown_object& object, std::uint32_t face) {
  return face_triangle(object.faces.at(face),
                       [&](std::uint32_t corner) { return object.positions.data() + 3 * std::size_t{corner}; });
}

/// As a line of frames.jsonl.
std::string numbers_of_frame(const Frame& frame, const std::vector<Shown_object>& objects,
                             const Detector_options& options) {
  Json pairs = Json::array();
  for (const auto& pair : frame.pairs) {
    pairs.push_back(verdict_json(title_of_object(objects[pair.a], pair.a), title_of_object(objects[pair.b], pair.b),
                                 pair, options));
    Json faces = Json::array(), intersects = Json::array();
    for (std::size_t i = pair.first_contact; i < pair.first_contact + pair.contacts; ++i) {
      faces.push_back({frame.face_pairs[i].a, frame.face_pairs[i].b});
      intersects.push_back(frame.intersects(i));
    }
    pairs.back()["faces"] = std::move(faces);
    if (tolerance_of(options.exact, {pair.a, pair.b}) > 0) pairs.back()["intersects"] = std::move(intersects);
  }
  const Json line{{"frame", frame.number},
                  {"pairs", std::move(pairs)},
                  {"statistics", statistics_json(frame.statistics, options.mode)}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// A page to which frames are added while a detector goes on.
class Python_page {
 public:
  Python_page(std::shared_ptr<Python_detector> detector, const std::string& title, double frames_per_second)
      : detector_(std::move(detector)),
        page_({.title = title,
               .mode = std::string(name_of(detector_->options().mode)),
               .frames_per_second = frames_per_second,
               .first_contacts = detector_->options().contacts == Contact_query::first,
               .note = missing_note(detector_->options(), detector_->particle_setting())}) {
    if (!(frames_per_second > 0) || !std::isfinite(frames_per_second))
      throw Bad_argument("frames_per_second must be finite and > 0");
    std::size_t id = 0;
    for (auto& object : detector_->shown()) {
      surfaces_.push_back({object.positions.size(), hash_of(std::as_bytes(std::span(object.faces)))});
      page_.add_object(title_of_object(object, id++), static_cast<std::uint32_t>(object.positions.size() / 3),
                       std::move(object.faces));
    }
  }

  void add(const Python_frame& frame) {
    if (!py::isinstance<Python_detector>(frame.detector) ||
        &frame.detector.cast<const Python_detector&>() != detector_.get())
      throw Bad_argument("the frame is not one of the page's detector");
    const auto& options = detector_->options();
    auto objects = detector_->shown();
    check_objects(objects);
    detector_->check_is_shown(frame);  // after `shown`, since another thread may move objects
    const Without_gil without_gil;
    const Frame& found = *frame.frame;
    Page_frame shown{.positions = {}, .numbers = numbers_of_frame(found, objects, options)};
    if (finds_all(options.mode))
      shown.stages = page_stages(found, {.positive = found.collides(), .with_tolerance = has_tolerance(options.exact)});
    if (options.contacts != Contact_query::yes_no)
      shown.contacts = page_contacts(
          found, [&](Object_id object, std::uint32_t face) { return triangle_of_face(objects[object], face); });
    for (const auto& object : objects)
      shown.positions.emplace_back(Eigen::Map<const Positions>(
          object.positions.data(), static_cast<Eigen::Index>(object.positions.size() / 3), 3));
    const std::lock_guard lock(mutex_);
    page_.add_frame(std::move(shown));
  }

  void save(const std::filesystem::path& path) const {
    if (lower_case(path.extension().string()) != ".html") throw Bad_argument(path.string() + ": a page is written as .html");
    const Without_gil without_gil;
    const auto viewer = viewer_template(path);
    const std::lock_guard lock(mutex_);
    Atomic_file file(path);
    write_page(file, viewer, page_.title(), page_.data());
    file.commit();
  }

  std::size_t frames() const {
    const Without_gil without_gil;
    const std::lock_guard lock(mutex_);
    return page_.frames();
  }
  std::string text() const { return "<lodestone.Page " + page_.title() + ": " + std::to_string(frames()) + " frames>"; }

 private:
  /// @throws Bad_argument  the detector has other objects than when the page was begun
  /// @throws Bad_mesh      a coordinate that is not finite
  void check_objects(const std::vector<Shown_object>& objects) const {
    bool same = objects.size() == surfaces_.size();
    for (std::size_t i = 0; same && i < objects.size(); ++i)
      same = surfaces_[i] ==
             std::pair(objects[i].positions.size(), hash_of(std::as_bytes(std::span(objects[i].faces))));
    if (!same)
      throw Bad_argument("the detector has other objects or faces than when the page was begun: begin another page");
    for (std::size_t i = 0; i < objects.size(); ++i) check_finite(objects[i].positions, title_of_object(objects[i], i));
  }

  std::shared_ptr<Python_detector> detector_;
  Page page_;
  mutable std::mutex mutex_;  ///< of the page: threads add frames and save without the GIL
  std::vector<std::pair<std::size_t, std::uint64_t>> surfaces_;  ///< per object: coordinates, and a hash of its faces
};

}  // namespace

void add_pages(py::module_& module) {
  py::class_<Python_page>(module, "PageBase", "See `Page`.")
      .def(py::init<std::shared_ptr<Python_detector>, const std::string&, double>(), py::arg("detector").none(false),
           py::arg("title") = "Lodestone", py::arg("frames_per_second") = 30.0)
      .def("add", &Python_page::add, py::arg("frame"),
           "Adds a frame: what was found, and where the vertices of all objects are now. Call it before you move them\n"
           "and before you ask for the next frame: it refuses an earlier one.")
      .def("save", &Python_page::save, py::arg("path"), "Writes the page: one .html file that needs nothing else.")
      .def("__len__", &Python_page::frames, "Number of frames.")
      .def("__repr__", &Python_page::text);
}

}  // namespace lodestone::python
