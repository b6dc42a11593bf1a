// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/contact_patches.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "lodestone/queries/surface_triangle.h"
#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

namespace {

constexpr auto no_vertex = std::numeric_limits<std::uint32_t>::max();

/// A contact as one of its faces sees it.
struct Partner {
  std::uint32_t face;     ///< the one that sees
  std::uint32_t partner;  ///< the other
  std::uint32_t contact;
  auto operator<=>(const Partner&) const = default;
};

/// A vertex or an edge of the partner in a contact.
struct Link {
  std::array<std::uint32_t, 2> vertices;  ///< ascending; the second is `no_vertex` for a vertex
  std::uint32_t contact;
};

/// Sets of contacts, which are merged.
class Contact_sets {
 public:
  explicit Contact_sets(std::size_t contacts)
      : rank_(contacts), parent_(contacts), sets_(rank_.data(), parent_.data()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  Contact_sets(const Contact_sets&) = delete;

  void join(std::uint32_t a, std::uint32_t b) { sets_.union_set(a, b); }
  std::uint32_t set_of(std::uint32_t contact) { return sets_.find_set(contact); }

 private:
  std::vector<std::uint32_t> rank_, parent_;
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets_;
};

/// Links contacts that have a face in common.
class Linking {
 public:
  Linking(double tolerance, Contact_sets& sets) : tolerance_(tolerance), sets_(sets) {}

  /// @param faces, partners    surfaces of the two faces of a contact
  /// @param contacts           sorted
  void link(const Object_surface& faces, const Object_surface& partners, std::span<const Partner> contacts) {
    for (auto first = contacts.begin(); first != contacts.end();) {
      const auto end = std::find_if(first, contacts.end(), [&](const Partner& p) { return p.face != first->face; });
      if (end - first > 1) link_around(faces, first->face, partners, {first, end});
      first = end;
    }
  }

 private:
  /// Links the contacts of one face.
  void link_around(const Object_surface& faces, std::uint32_t face, const Object_surface& partners,
                   std::span<const Partner> contacts) {
    list_links(&faces == &partners ? faces.corners()[face] : Corners{no_vertex, no_vertex, no_vertex}, partners,
               contacts);
    const Triangle triangle = surface_triangle(faces, face);
    for (auto first = links_.begin(); first != links_.end();) {
      const auto end = std::find_if(first, links_.end(), [&](const Link& l) { return l.vertices != first->vertices; });
      // Most contacts have been linked across an edge when it is the turn of its ends.
      const bool apart = std::any_of(
          first, end, [&](const Link& l) { return sets_.set_of(l.contact) != sets_.set_of(first->contact); });
      if (apart && is_in_contact(partners, first->vertices, triangle))
        for (auto link = first; link != end; ++link) sets_.join(first->contact, link->contact);
      first = end;
    }
  }

  /// The edges of all partners, then their vertices. Those at a corner of the face itself touch it anyway: left out.
  void list_links(const Corners& own, const Object_surface& partners, std::span<const Partner> contacts) {
    const auto is_own = [&](std::uint32_t v) { return std::ranges::find(own, v) != own.end(); };
    links_.clear();
    for (const Partner& contact : contacts) {
      const Corners& corners = partners.corners()[contact.partner];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [v, w] = std::minmax(corners[i], corners[(i + 1) % 3]);
        if (!is_own(v) && !is_own(w)) links_.push_back({{v, w}, contact.contact});
        if (!is_own(corners[i])) links_.push_back({{corners[i], no_vertex}, contact.contact});
      }
    }
    std::ranges::sort(links_, {}, [](const Link& l) {
      return std::tuple(l.vertices[1] == no_vertex, l.vertices[0], l.vertices[1], l.contact);
    });
  }

  bool is_in_contact(const Object_surface& surface, const std::array<std::uint32_t, 2>& vertices,
                     const Triangle& triangle) const {
    const auto point = [&](std::uint32_t v) {
      const double* p = surface.coordinates().data() + 3 * std::size_t{v};
      return Point(p[0], p[1], p[2]);
    };
    const Point first = point(vertices[0]), last = vertices[1] == no_vertex ? first : point(vertices[1]);
    return triangles_nearer_than({first, last, last}, triangle, tolerance_);
  }

  double tolerance_;
  Contact_sets& sets_;
  std::vector<Link> links_;
};

void link_contacts(const Object_surface& a, const Object_surface& b, std::span<const Face_pair> contacts,
                   double tolerance, Contact_sets& sets) {
  std::vector<Partner> of_a, of_b;
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    of_a.push_back({contacts[i].a, contacts[i].b, i});
    of_b.push_back({contacts[i].b, contacts[i].a, i});
  }
  Linking linking(tolerance, sets);
  const auto link = [&](const Object_surface& faces, const Object_surface& partners, std::vector<Partner>& list) {
    std::ranges::sort(list);
    linking.link(faces, partners, list);
  };
  if (&a == &b) {
    // One face can be the first of one pair and the second of another.
    of_a.insert(of_a.end(), of_b.begin(), of_b.end());
    return link(a, a, of_a);
  }
  link(a, b, of_a);
  link(b, a, of_b);
}

Eigen::Vector3d vector_of(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Mean of points, without a sum that could overflow.
Eigen::Vector3d mean_of(const Intersection_points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Point& p : points) mean += vector_of(p) / static_cast<double>(points.size());
  return mean;
}

/// Length of a segment, or of the outline of a polygon, in which two faces meet; 0 if they meet in a point or not.
double length_of(const Intersection_points& points, const Contact_normal& normal) {
  if (points.size() < 2 || normal.depth < 0) return 0;
  double length = 0;
  const std::size_t sides = points.size() == 2 ? 1 : points.size();
  for (std::size_t i = 0; i < sides; ++i)
    length += (vector_of(points[(i + 1) % points.size()]) - vector_of(points[i])).stableNorm();
  return std::isnan(length) ? std::numeric_limits<double>::infinity() : length;
}

/// What each contact counts, such that the sum is 1.
std::vector<double> weights_of(std::vector<double> lengths) {
  for (double& length : lengths) length = std::min(length, std::numeric_limits<double>::max());
  const double largest = *std::ranges::max_element(lengths);
  for (double& length : lengths) length = largest > 0 ? length / largest : 1;
  const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  for (double& length : lengths) length /= sum;
  return lengths;
}

void measure(Contact_patch& patch, const Contact_geometry& contacts) {
  std::vector<double> lengths;
  for (const std::uint32_t i : patch.contacts) lengths.push_back(length_of(contacts.points[i], contacts.normals[i]));
  const std::vector<double> weights = weights_of(lengths);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  patch.depth = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const std::uint32_t i = patch.contacts[k];
    patch.point += weights[k] * mean_of(contacts.points[i]);
    normal += weights[k] * contacts.normals[i].normal;
    patch.depth = std::max(patch.depth, contacts.normals[i].depth);
    patch.length += lengths[k];
  }
  // Shorter sums are rounding.
  if (normal.norm() > 1e-8) patch.normal = normal.normalized();
}

}  // namespace

std::vector<Contact_patch> contact_patches(const Object_surface& a, const Object_surface& b,
                                           const Contact_geometry& contacts, double tolerance) {
  Contact_sets sets(contacts.faces.size());
  link_contacts(a, b, contacts.faces, tolerance, sets);
  std::vector<Contact_patch> patches;
  std::map<std::uint32_t, std::size_t> patch_of;
  for (std::uint32_t i = 0; i < contacts.faces.size(); ++i) {
    const auto [entry, is_new] = patch_of.try_emplace(sets.set_of(i), patches.size());
    if (is_new) patches.emplace_back();
    patches[entry->second].contacts.push_back(i);
  }
  for (Contact_patch& patch : patches) measure(patch, contacts);
  return patches;
}

}  // namespace lodestone
