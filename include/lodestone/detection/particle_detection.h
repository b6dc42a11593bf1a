// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/busy.h"
#include "lodestone/detection/detection.h"
#include "lodestone/detection/frame_builder.h"
#include "lodestone/detection/meeting_search.h"
#include "lodestone/detection/particle_object.h"
#include "lodestone/detection/saved_object.h"
#include "lodestone/particles/candidate_pairs.h"
#include "lodestone/particles/confirmation.h"

namespace lodestone {

/// The modes `particles` and `senin` of a Detector: its objects, and what happens to them in a frame.
///
/// In a frame positions are read only where a particle looks and in the regions of candidate pairs; with meetings one
/// position per region, and those around the places where objects may touch. `update` reads a few vertices per region,
/// and all of a region that seems to have grown. After the first frame memory is allocated only where a result is
/// larger than any before, for such a region, and for repartitions; in mode `senin` also for the faces around a
/// particle that has moved. An object with a single particle is felt by others, and feels them, within its diameter.
class Particle_detection final : public Detection {
 public:
  /// What a refusal tells a user who asks another mode for this one's answers.
  static constexpr const char* needed = " needs a mode with particles";

  /// @param options  checked by `make_detection`
  explicit Particle_detection(const Detector_options& options)
      : options_(options), workers_(options.threads), frame_(options), meeting_search_(options, workers_) {}

  void add(const Watch_mesh& watch, const Object_options& options) override;
  Watched_mesh& mesh(Object_id object) override { return objects_[object]->particle_object.mesh(); }
  void place(Object_id object, const std::optional<Rigid_motion>& placement) override {
    Busy::check(busy_);
    objects_[object]->particle_object.place(placement);
  }

  /// Repartitions an object that has outgrown A*.
  void update(Object_id object) override;
  /// Reads the faces of the mesh anew.
  using Detection::rebuild;
  void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex) override;
  void save(Object_id object, State_writer& state) override;
  void load(Object_id object, State_reader& state) override;
  std::vector<Region_index> labels(Object_id object) const override {
    return objects_[object]->prepared ? objects_[object]->particle_object.labels() : std::vector<Region_index>();
  }
  void remove(Object_id object) override {
    Busy::check(busy_);
    objects_[object].reset();
    meeting_search_.forget(object);
  }
  const Frame& detect(const Collision_filter& filter) override;

  /// See `Detector::object`.
  /// Its edges are known, also before the first frame.
  const Particle_object& object(Object_id object) const {
    objects_[object]->particle_object.find_edges();
    return objects_[object]->particle_object;
  }

 private:
  struct Object {
    Object_id id;
    Object_options options;
    Particle_object particle_object;
    double radius = 0;  ///< of the bounding sphere at the last partition, if numbers of particles depend on it
    bool prepared = false;
    std::vector<std::uint32_t> vertices_before = {};  ///< of its particles, before the frame

    Object(Object_id i, std::unique_ptr<Watched_mesh> mesh, const Object_options& o)
        : id(i), options(o), particle_object(std::move(mesh)) {}

    /// Calls `work`, and names the object in the Bad_mesh or Bad_argument that it may throw.
    template <class Work>
    decltype(auto) named(const Work& work) const {
      try {
        return work();
      } catch (const Bad_mesh& error) {
        throw Bad_mesh(title_of(id, options) + ": " + error.what());
      } catch (const Bad_argument& error) {
        throw Bad_argument(title_of(id, options) + ": " + error.what());
      }
    }
  };

  bool meets() const { return options_.mode == Mode::particles && options_.meetings > 0; }
  Saved_origin origin(const Object& object) const;

  // Objects are built: divided into regions, or scattered with particles.
  enum class Seams { keep, close, open };
  /// What is known of an object while it is built.
  struct Building {
    Object* object = nullptr;
    Positions positions = {};
    std::size_t particles = 0;
    Numbered_partition division = {};
  };
  void prepare();
  void build(std::span<Object* const> objects, Seams seams);
  std::vector<Building> read(std::span<Object* const> objects) const;
  void measure(std::span<Building> all, Seams seams);
  void divide(std::span<Building> all);
  void start(std::span<Building> all);
  void start(Building& building, Workers& workers);
  template <class Work>
  void for_each(std::span<Building> all, const Work& work);
  void measure_new_radii();
  Radius_range radii() const;
  std::size_t particles_of(const Object& object, const Positions& positions, const Radius_range& radii) const;
  void write_maps(Object& object);
  bool has_outgrown(Particle_object& object);
  void make_room();

  // A frame, by any method.
  void note_vertices();
  void restore_vertices();
  void list_object_pairs(const Collision_filter& filter);
  void walk();
  void sort_contacts(Pair_result& result);
  void end_pair(Pair_result& result);

  // The published method, and its predecessor.
  void detect_as_published(const Collision_filter& filter);
  void find_candidates(const Collision_filter& filter);
  void check_regions(Object_pair pair);
  void list_candidates(Object_pair pair);

  // With meetings.
  void detect_by_meetings(const Collision_filter& filter);
  void find_near_objects(const Collision_filter& filter);
  void find_objects();
  void read_objects();
  void find_near_regions();
  template <class Read>
  void read_each(const Read& read);
  void search_near_objects();
  void walk_undecided_particles();
  void add_pulls(const Met_pair& pair);
  void report(Met_pair& pair);
  void list_near_regions(const Met_pair& pair);
  void move_to_meetings();
  void add_counts();
  void name_the_bad_object();

  Detector_options options_;
  Workers workers_;
  std::vector<std::unique_ptr<Object>> objects_;  ///< null: removed
  Frame_builder frame_;
  Frame_statistics since_last_frame_;  ///< what other calls have to tell the next frame

  // Memory of the stages, kept from frame to frame.
  bool has_room_ = true;        ///< whether it is as large as the objects need
  std::vector<Object_id> ids_;  ///< of the objects that have not been removed
  std::vector<Box> boxes_;
  std::vector<double> reach_;
  Broad_phase broad_phase_;
  std::vector<Object_pair> object_candidates_;
  std::vector<std::vector<std::uint32_t>> opponents_;  ///< per object: those it may meet
  std::vector<std::vector<Pull>> pulls_;               ///< per object, with meetings
  std::vector<Walking_object<Live_positions>> walking_;
  Relaxation_scratch relaxation_;
  std::vector<Candidate_pair> region_candidates_;
  Confirmation confirmation_;
  Meeting_search meeting_search_;
  std::vector<Met_pair> met_pairs_;
  bool busy_ = false;  ///< see Busy
};

}  // namespace lodestone
