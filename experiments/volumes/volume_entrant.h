// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "lodestone/queries/contact_search.h"
#include "shared/lap_timer.h"
#include "volumes/contestants.h"
#include "volumes/walk_counts.h"

namespace lodestone {

/// A region tree of one volume for each object, refitted in every frame and never rebuilt.
template <Bounding_volume Volume>
class Volume_entrant : public Entrant {
 public:
  Volume_entrant(std::span<const Moving_mesh> meshes, std::shared_ptr<Scene_division> division,
                 std::shared_ptr<Volume_figures> figures)
      : meshes_(meshes.begin(), meshes.end()), division_(std::move(division)), figures_(std::move(figures)) {
    for (std::size_t o = 0; o < meshes.size(); ++o) {
      auto& object = objects_.emplace_back(std::make_unique<Object>(meshes[o].corners));
      object->build(division_->labels(o), meshes[o].coordinates(), {});
      addresses_.push_back(object.get());
      figures_->nodes += object->tree().node_count();
    }
    figures_->node_bytes = sizeof(Volume);
  }

  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.collides.assign(pairs.size(), false);
    answer_.contacts.resize(pairs.size());
    for (auto& contacts : answer_.contacts) contacts.clear();

    Lap_timer timer;
    update();
    answer_.update_seconds = timer.lap();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      answer_.collides[p] = ask(pairs[p], Contact_query::yes_no, unlisted_).found;
    answer_.any_seconds = timer.lap();
    for (std::size_t p = 0; p < pairs.size(); ++p) ask(pairs[p], Contact_query::all, answer_.contacts[p]);
    answer_.all_seconds = timer.lap();
    return answer_;
  }

  void inspect(std::span<const Object_pair> pairs, std::size_t frame, std::size_t frames) override {
    update();
    ++figures_->frames;
    for (const auto& pair : pairs) {
      const Walk_counts counts = count_walk(objects_[pair.a]->tree(), objects_[pair.b]->tree());
      figures_->volume_tests += counts.volume_tests;
      figures_->leaf_pairs += counts.leaf_pairs;
      std::vector<Face_pair> found;
      figures_->exact_tests += ask(pair, Contact_query::all, found).exact_tests;
    }
    if (frame == 0) figures_->first = tightness(frame);
    if (frame + 1 == frames) figures_->last = tightness(frame);
  }

 private:
  using Object = Basic_tree_surface<Volume>;

  void update() {
    coordinates_.clear();
    for (const auto& mesh : meshes_) coordinates_.push_back(mesh.coordinates());
    refit<Volume>(addresses_, coordinates_, Workers::alone());
  }

  Contact_summary ask(Object_pair pair, Contact_query query, std::vector<Face_pair>& found) {
    return search_.between(*objects_[pair.a], *objects_[pair.b], {.query = query}, found);
  }

  Tightness tightness(std::size_t frame) const {
    std::vector<const Tree_layout*> layouts;
    for (const auto& object : objects_) layouts.push_back(&object->tree());
    const auto& measure = division_->measure(frame, layouts, meshes_);
    Volume_sums sums;
    for (std::size_t o = 0; o < objects_.size(); ++o)
      add_volumes(objects_[o]->tree(), division_->pieces(o), meshes_[o].coordinates(), measure.regions[o], sums);
    return tightness_of(sums, measure.hulls);
  }

  std::vector<Moving_mesh> meshes_;
  std::shared_ptr<Scene_division> division_;
  std::shared_ptr<Volume_figures> figures_;
  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<Object*> addresses_;
  std::vector<Coordinates> coordinates_;
  Basic_contact_search<Volume> search_{Workers::alone()};
  std::vector<Face_pair> unlisted_;
  Answer answer_;
};

}  // namespace lodestone
