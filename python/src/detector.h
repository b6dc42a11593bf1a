// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "arrays.h"
#include "deadlock_mutex.h"
#include "frame.h"
#include "lodestone/detector.h"
#include "lodestone/io/motion/computed_motion.h"
#include "motion.h"
#include "options.h"
#include "program/missed_frames.h"

namespace lodestone::python {

/// One object of a detector: where its faces and positions come from.
class Python_object {
 public:
  Python_object(std::string name, const Given_mesh& mesh);
  /// @param on_demand  whether a motion that can be computed vertex by vertex shall be
  Python_object(std::string name, std::shared_ptr<Python_animation> animation, bool on_demand);
  Python_object(std::string name, std::shared_ptr<Python_skin> skin, const py::object& faces);

  const std::string& name() const { return name_; }
  const Indexed_mesh& mesh() const { return *mesh_; }
  /// Adds it to a detector.
  Object_id add_to(Detector<Any_strategy>& detector, const Object_options& options) const;

  /// Takes what Python has written since the last call. Without the GIL.
  /// @param hold  the number of the hold of all positions, in which it is read once; 0: there is none
  void refresh(std::uint64_t hold);
  /// The next `refresh` reads, whatever is held.
  void read_anew() { read_in_ = 0; }
  /// Takes other arrays, in exchange for its own. Without the GIL.
  /// @throws Bad_mesh, Bad_argument  it stays as it was
  void exchange(std::unique_ptr<Live_vertices>& vertices);
  void exchange(std::unique_ptr<Live_vertices>& vertices, std::vector<Corners>& faces);
  /// Refuses a list of changed faces that is incomplete. Of the faces that were there and still are, those that are not
  /// listed must have the same corners, in the same order.
  /// @throws Bad_argument  names the first that has not; its positions are not in arrays
  void check_changed(std::span<const Corners> faces, std::span<const std::uint32_t> changed) const;
  /// Poses an animation. -1: its last frame.
  /// @throws Bad_argument  there is no animation, or no such frame
  void set_frame(py::ssize_t number);
  /// Places it elsewhere from now on.
  /// @throws Bad_argument  no rotation and translation
  void place(const Eigen::Isometry3d& placement) { placement_ = make_rigid_motion(placement); }

  /// Keeps a Python object as long as this lives.
  void keep(py::object kept) { kept_.push_back(std::move(kept)); }

  /// Where its vertices are, placement included. Without the GIL.
  std::vector<double> positions() const;
  /// The skin that a query reads; null: none.
  Python_skin* skin() const { return skin_.get(); }

 private:
  void check_has_arrays() const;

  std::string name_;
  std::vector<Corners> faces_;
  std::unique_ptr<Live_vertices> vertices_;      ///< null: they are computed
  std::shared_ptr<Python_animation> animation_;  ///< null: there is none
  std::unique_ptr<Computed_motion> computed_;    ///< its motion, if it is computed on demand
  std::shared_ptr<Python_skin> skin_;
  std::vector<py::object> kept_;
  std::uint64_t read_in_ = 0;  ///< the hold in which positions were read last; 0: in none
  std::optional<Rigid_motion> placement_;  ///< none: where its mesh is
  std::vector<double> posed_;              ///< of an animation or a skin: a pose, at first that at rest
  std::unique_ptr<Indexed_mesh> mesh_;
};

/// A Detector for Python. Any number of threads may call it: they wait for each other, without the GIL.
class Python_detector {
 public:
  explicit Python_detector(const Detector_settings& settings);

  Object_id add(const py::object& mesh, const py::object& faces, const std::string& name, std::size_t particles,
                std::uint32_t groups, std::uint32_t meets, const py::object& file_vertex,
                const py::object& scattered_side);
  void set_vertices(Object_id object, const py::object& vertices);
  void set_frame(Object_id object, py::ssize_t frame);
  void update(std::optional<Object_id> object);
  void place(Object_id object, const py::object& matrix);
  void rebuild(Object_id object, const py::object& vertices, const py::object& faces, const py::object& changed,
               const py::object& file_vertex);

  /// A copy of what `Detector::detect` returns.
  Python_frame detect();
  Python_frame detect(Object_id a, Object_id b);

  /// Asks the detector without the GIL, once it has read what Python has written.
  /// @param question  called with the detector; must not touch Python's objects
  template <class Question>
  auto ask(const Question& question) {
    const Without_gil without_gil;
    const std::lock_guard lock(mutex_);
    const Reading reading(*this);
    return question(detector_);
  }
  /// The same for what reads no positions.
  template <class Change>
  auto change(const Change& change) {
    const Without_gil without_gil;
    const std::lock_guard lock(mutex_);
    check_no_visitor();
    return change(detector_);
  }

  /// The same for what a visitor may know.
  template <class Question>
  auto look(const Question& question) {
    const Without_gil without_gil;
    const std::lock_guard lock(mutex_);
    return question(detector_);
  }

  const Detector_options& options() const { return settings_.options; }
  /// How particles are made, of the objects so far.
  Particle_setting particle_setting();
  std::string name(Object_id object) {
    return look([&](auto&) { return at(object).name(); });
  }
  py::array positions(Object_id object);
  std::string text();
  /// Positions and faces of all objects, for a page.
  struct Shown_object {
    std::string name;
    std::vector<Corners> faces;
    std::vector<double> positions;
  };
  std::vector<Shown_object> shown();
  /// @throws Bad_argument  another frame was found since, or objects were moved, added, removed or rebuilt
  void check_is_shown(const Python_frame& frame);

  /// Promises something about the motion of an object, which keeps the promise.
  template <class Promise>
  void promise(Object_id object, const Promise& promise, py::object kept) {
    change([&](auto& detector) {
      at(object).keep(std::move(kept));  // first: the detector refers to it
      detector.promise(object, promise);
    });
  }
  void remove(Object_id object);

  /// Until `release_positions`, positions are read once: see `Detector::hold_positions`.
  void hold_positions();
  /// Ends a promise; at most as often as one was made. Waits for nobody, since Python calls it anywhere: where a block
  /// is left by an error, or a generator is thrown away while a visitor is called.
  void release_positions() { ++released_; }

 private:
  /// While a query reads positions.
  class Reading {
   public:
    explicit Reading(Python_detector& detector);
    ~Reading() { detector_.reading_ = false; }
    Reading(const Reading&) = delete;

   private:
    Python_detector& detector_;
    std::vector<std::unique_ptr<Python_skin::Reading>> skins_;
  };

  /// @throws Bad_argument  a visitor called
  void check_no_visitor() const;
  /// The number of the hold, once promises that have ended are gone; 0: there is none.
  std::uint64_t current_hold();
  Python_object& at(Object_id object) const;
  /// An object for messages: its id and its name.
  /// @throws Bad_argument  there is no such object
  std::string title_of(Object_id object) const;
  /// Reads the array of an object, unless it has been read in this hold.
  /// @throws Bad_mesh  names the object
  void refresh(Object_id object, std::uint64_t hold);
  /// Sets positions or faces of an object. Its errors name the object.
  template <class Change>
  void change_object(Object_id object, const Change& change);
  template <class Detect>
  Python_frame found(const Detect& detect);
  /// Grows with every change of an object, and with every pose of a skin. Writing into arrays does not count.
  std::uint64_t poses() const;

  Detector_settings settings_;
  std::size_t fewest_particles_ = 0;  ///< of all objects ever added; see Particle_setting
  Deadlock_mutex mutex_;  ///< a visitor that calls the detector gets an error, not a deadlock
  bool reading_ = false;  ///< a query reads; who gets here then is its visitor
  std::vector<std::unique_ptr<Python_object>> objects_;  ///< null: removed
  std::vector<Object_id> ids_;                           ///< of those that are there, ascending
  std::uint64_t last_frame_ = 0;  ///< number of the frame that was found last
  std::uint64_t poses_ = 0;       ///< how often objects were moved, added, removed or rebuilt, but for what `poses` adds
  Detector<Any_strategy> detector_;
  Position_hold hold_;  ///< of what is copied from Python
  std::vector<Held_positions> held_;
  std::atomic<std::size_t> released_ = 0;  ///< promises that have ended, and are still in `held_`
};

void add_detector(py::module_& module);

}  // namespace lodestone::python
