// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "detector.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/results/page.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"
#include "program/page_contacts.h"
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

std::vector<Page_contact> contacts_of(const Frame& frame, const std::vector<Shown_object>& objects) {
  std::vector<Page_contact> contacts;
  for (const auto& pair : frame.pairs)
    for (const auto& [a, b] : frame.contacts(pair))
      add_page_contacts(contacts, {.a = pair.a, .face_a = a, .b = pair.b, .face_b = b},
                        triangle_of_face(objects[pair.a], a), triangle_of_face(objects[pair.b], b));
  return contacts;
}

/// As a line of frames.jsonl.
std::string numbers_of_frame(const Frame& frame, const std::vector<Shown_object>& objects) {
  Json pairs = Json::array();
  for (const auto& pair : frame.pairs) {
    Json faces = Json::array();
    for (const auto& [a, b] : frame.contacts(pair)) faces.push_back({a, b});
    pairs.push_back({{"a", title_of_object(objects[pair.a], pair.a)},
                     {"b", title_of_object(objects[pair.b], pair.b)},
                     {"collides", pair.collides},
                     {"faces", std::move(faces)}});
  }
  const auto& s = frame.statistics;
  const Json line{{"frame", frame.number},
                  {"pairs", std::move(pairs)},
                  {"statistics",
                   {{"candidates", s.candidates},
                    {"exact_tests", s.exact_tests},
                    {"contacts", s.contacts},
                    {"vertices_read", s.vertices_read}}}};
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Times and outcome. `positive` needs a mode that finds all.
std::string stages_of(const Frame& frame, bool with_tolerance) {
  const auto& s = frame.statistics.seconds;
  const auto microseconds = [](double seconds) { return std::round(1e8 * seconds) / 100; };
  return Json{{"microseconds",
               {{"build", microseconds(s.build)},
                {"repartition", microseconds(s.repartition)},
                {"refit", microseconds(s.refit)},
                {"broad_phase", microseconds(s.broad_phase)},
                {"relaxation", microseconds(s.relaxation)},
                {"candidates", microseconds(s.candidates)},
                {"confirmation", microseconds(s.confirmation)}}},
              {"positive", frame.collides()},
              {"found", frame.collides()},
              {"near", with_tolerance ? Json(frame.near()) : Json()},
              {"nearest", nullptr}}
      .dump();
}

/// A page to which frames are added while a detector goes on.
class Python_page {
 public:
  Python_page(std::shared_ptr<Python_detector> detector, const std::string& title, double frames_per_second)
      : detector_(std::move(detector)),
        page_({.title = title,
               .mode = std::string(name_of(detector_->options().mode)),
               .frames_per_second = frames_per_second}) {
    if (!(frames_per_second > 0) || !std::isfinite(frames_per_second))
      throw Bad_argument("frames_per_second must be finite and > 0");
    std::size_t id = 0;
    for (auto& object : detector_->shown()) {
      sizes_.push_back({object.positions.size(), object.faces.size()});
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
    Page_frame shown{.positions = {}, .numbers = numbers_of_frame(*frame.frame, objects)};
    if (finds_all(options.mode)) shown.stages = stages_of(*frame.frame, options.exact.tolerance > 0);
    if (options.contacts != Contact_query::yes_no) shown.contacts = contacts_of(*frame.frame, objects);
    for (const auto& object : objects)
      shown.positions.emplace_back(Eigen::Map<const Positions>(
          object.positions.data(), static_cast<Eigen::Index>(object.positions.size() / 3), 3));
    page_.add_frame(std::move(shown));
  }

  void save(const std::filesystem::path& path) const {
    if (path.extension() != ".html") throw Bad_argument(path.string() + ": a page is written as .html");
    const Without_gil without_gil;
    const auto viewer = viewer_template(path);
    Atomic_file file(path);
    write_page(file, viewer, page_.title(), page_.data());
    file.commit();
  }

  std::size_t frames() const { return page_.frames(); }
  std::string text() const { return "<lodestone.Page " + page_.title() + ": " + std::to_string(frames()) + " frames>"; }

 private:
  /// @throws Bad_argument  the detector has other objects than when the page was begun
  /// @throws Bad_mesh      a coordinate that is not finite
  void check_objects(const std::vector<Shown_object>& objects) const {
    bool same = objects.size() == sizes_.size();
    for (std::size_t i = 0; same && i < objects.size(); ++i)
      same = sizes_[i] == std::pair(objects[i].positions.size(), objects[i].faces.size());
    if (!same)
      throw Bad_argument("the detector has other objects or faces than when the page was begun: begin another page");
    for (std::size_t i = 0; i < objects.size(); ++i) check_finite(objects[i].positions, title_of_object(objects[i], i));
  }

  std::shared_ptr<Python_detector> detector_;
  Page page_;
  std::vector<std::pair<std::size_t, std::size_t>> sizes_;  ///< per object: coordinates and faces
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
