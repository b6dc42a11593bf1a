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
  if (tree_ && is_current_) return true;
  const bool paid_before = Ray_tree::refit_pays(rays_at_pose_, faces);
  rays_at_pose_ += rays;
  if (!Ray_tree::refit_pays(rays_at_pose_, faces)) return false;
  if (!tree_) rays_without_tree_ += paid_before ? rays : rays_at_pose_;
  return tree_ || Ray_tree::pays(rays_without_tree_, faces);
}

void Kept_ray_tree::forget() {
  tree_.reset();
  rays_at_pose_ = rays_without_tree_ = 0;
}

}  // namespace lodestone
