// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/kept_ray_tree.h"

namespace lodestone {

const Ray_tree& Kept_ray_tree::of(const Layout_view& surface, Workers& workers) {
  if (!tree_)
    tree_.emplace(surface, workers);
  else if (!is_current_)
    tree_->refit(surface, workers);
  is_current_ = true;
  rays_without_tree_ = 0;
  return *tree_;
}

bool Kept_ray_tree::pays_for(std::size_t rays, std::size_t faces) {
  if (!Ray_tree::refit_pays(rays, faces)) return false;
  if (!tree_) rays_without_tree_ += rays;
  return tree_ || Ray_tree::pays(rays_without_tree_, faces);
}

void Kept_ray_tree::forget() {
  tree_.reset();
  rays_without_tree_ = 0;
}

}  // namespace lodestone
