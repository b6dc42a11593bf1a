// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/contact_patches.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

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
  std::uint64_t place;  ///< see `edge` and `vertex`
  std::uint32_t index;  ///< of the contact among those of its face
  auto operator<=>(const Link&) const = default;

  static std::uint64_t edge(std::uint32_t v, std::uint32_t w) {
    const auto [low, high] = std::minmax(v, w);
    return std::uint64_t{low} << 32U | high;
  }
  /// After all edges.
  static std::uint64_t vertex(std::uint32_t v) { return std::uint64_t{no_vertex} << 32U | v; }
  /// Both ends of an edge, or a vertex twice.
  std::array<std::uint32_t, 2> ends() const {
    const auto first = static_cast<std::uint32_t>(place >> 32U), second = static_cast<std::uint32_t>(place);
    return {first == no_vertex ? second : first, second};
  }
};

/// Sets of contacts, which are merged.
class Contact_sets {
 public:
  /// Each contact is a set of its own.
  void start(std::size_t contacts) {
    rank_.assign(contacts, 0);
    parent_.resize(contacts);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  void join(std::uint32_t a, std::uint32_t b) { sets().union_set(a, b); }
  std::uint32_t set_of(std::uint32_t contact) { return sets().find_set(contact); }

 private:
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets() { return {rank_.data(), parent_.data()}; }

  std::vector<std::uint32_t> rank_, parent_;
};

/// Two contacts that are linked.
using Joint = std::array<std::uint32_t, 2>;

/// Links contacts that have a face in common. Keeps its memory from one face to the next.
class Linking {
 public:
  /// @param faces, partners  surfaces of the two faces of a contact
  Linking(const Object_surface& faces, const Object_surface& partners, double tolerance)
      : faces_(faces), partners_(partners), tolerance_(tolerance) {}

  /// Appends enough joints to connect all contacts of one face that are linked.
  /// @param contacts  of the face
  void link(std::span<const Partner> contacts, std::vector<Joint>& joints) {
    if (contacts.size() < 2) return;
    const std::uint32_t face = contacts.front().face;
    list_links(&faces_ == &partners_ ? faces_.corners()[face] : Corners{no_vertex, no_vertex, no_vertex}, contacts);
    sets_.start(contacts.size());
    const Triangle triangle = surface_triangle(faces_, face);
    for (auto first = links_.begin(); first != links_.end();) {
      const auto end = std::find_if(first, links_.end(), [&](const Link& l) { return l.place != first->place; });
      // Most contacts have been linked across an edge when it is the turn of its ends.
      const bool apart = std::any_of(
          first + 1, end, [&](const Link& l) { return sets_.set_of(l.index) != sets_.set_of(first->index); });
      if (apart && is_in_contact(first->ends(), triangle))
        for (auto link = first + 1; link != end; ++link) {
          sets_.join(first->index, link->index);
          joints.push_back({contacts[first->index].contact, contacts[link->index].contact});
        }
      first = end;
    }
  }

 private:
  /// The edges of all partners, then their vertices. Those at a corner of the face itself touch it anyway: left out.
  void list_links(const Corners& own, std::span<const Partner> contacts) {
    const auto is_own = [&](std::uint32_t v) { return std::ranges::find(own, v) != own.end(); };
    links_.clear();
    for (std::uint32_t index = 0; index < contacts.size(); ++index) {
      const Corners& corners = partners_.corners()[contacts[index].partner];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = corners[i], w = corners[(i + 1) % 3];
        if (is_own(v)) continue;
        links_.push_back({Link::vertex(v), index});
        if (!is_own(w)) links_.push_back({Link::edge(v, w), index});
      }
    }
    std::ranges::sort(links_);
  }

  bool is_in_contact(const std::array<std::uint32_t, 2>& ends, const Triangle& triangle) const {
    const auto point = [&](std::uint32_t v) {
      const double* p = partners_.coordinates().data() + 3 * std::size_t{v};
      return Point(p[0], p[1], p[2]);
    };
    const Point first = point(ends[0]), last = point(ends[1]);
    return tolerance_ > 0 ? triangles_nearer_than({first, last, last}, triangle, tolerance_)
                          : segment_intersects(first, last, triangle);
  }

  const Object_surface& faces_;
  const Object_surface& partners_;
  double tolerance_;
  std::vector<Link> links_;
  Contact_sets sets_;
};

/// The contacts as the faces of one surface see them.
class Seen_contacts {
 public:
  /// @param contacts  that have faces of the surface, in any order
  Seen_contacts(const Object_surface& faces, const Object_surface& partners, std::vector<Partner> contacts)
      : faces_(&faces), partners_(&partners), contacts_(std::move(contacts)) {
    if (!std::ranges::is_sorted(contacts_)) std::ranges::sort(contacts_);
    for (std::size_t first = 0; first < contacts_.size();) {
      begin_.push_back(first);
      const std::uint32_t face = contacts_[first].face;
      while (first < contacts_.size() && contacts_[first].face == face) ++first;
    }
    begin_.push_back(contacts_.size());
  }

  std::size_t batches() const { return (face_count() + batch_faces - 1) / batch_faces; }
  /// The joints of the contacts of some faces.
  std::vector<Joint> joints_of(std::size_t batch, double tolerance) const {
    std::vector<Joint> joints;
    Linking linking(*faces_, *partners_, tolerance);
    const std::size_t end = std::min((batch + 1) * batch_faces, face_count());
    for (std::size_t i = batch * batch_faces; i < end; ++i)
      linking.link(std::span(contacts_).subspan(begin_[i], begin_[i + 1] - begin_[i]), joints);
    return joints;
  }

 private:
  static constexpr std::size_t batch_faces = 64;

  std::size_t face_count() const { return begin_.size() - 1; }

  const Object_surface *faces_, *partners_;
  std::vector<Partner> contacts_;   ///< sorted
  std::vector<std::size_t> begin_;  ///< per face with contacts and past the last: the first of them
};

/// The contacts as either surface sees them, or as the only one does.
std::vector<Seen_contacts> seen_contacts(const Object_surface& a, const Object_surface& b,
                                         std::span<const Face_pair> contacts) {
  std::vector<Partner> of_a, of_b;
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    of_a.push_back({contacts[i].a, contacts[i].b, i});
    of_b.push_back({contacts[i].b, contacts[i].a, i});
  }
  std::vector<Seen_contacts> seen;
  if (&a == &b) {
    // One face can be the first of one pair and the second of another.
    of_a.insert(of_a.end(), of_b.begin(), of_b.end());
    seen.emplace_back(a, a, std::move(of_a));
  } else {
    seen.emplace_back(a, b, std::move(of_a));
    seen.emplace_back(b, a, std::move(of_b));
  }
  return seen;
}

void link_contacts(std::span<const Seen_contacts> seen, double tolerance, Contact_sets& sets, Workers& workers) {
  constexpr std::size_t batches_worth_sharing = 8;  // fewer take less time than waking another thread
  const std::size_t of_first = seen.front().batches(), batches = of_first + (seen.size() > 1 ? seen[1].batches() : 0);
  std::vector<std::vector<Joint>> joints(batches);
  Workers& sharing = batches < batches_worth_sharing ? Workers::alone() : workers;
  sharing.run(batches, [&](std::size_t i, std::size_t) {
    joints[i] = i < of_first ? seen[0].joints_of(i, tolerance) : seen[1].joints_of(i - of_first, tolerance);
  });
  for (const auto& of_batch : joints)
    for (const auto& [a, b] : of_batch) sets.join(a, b);
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
                                           const Contact_geometry& contacts, double tolerance, Workers& workers) {
  Contact_sets sets;
  sets.start(contacts.faces.size());
  link_contacts(seen_contacts(a, b, contacts.faces), tolerance, sets, workers);
  std::vector<Contact_patch> patches;
  constexpr auto none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> patch_of_set(contacts.faces.size(), none);
  for (std::uint32_t i = 0; i < contacts.faces.size(); ++i) {
    std::size_t& patch = patch_of_set[sets.set_of(i)];
    if (patch == none) {
      patch = patches.size();
      patches.emplace_back();
    }
    patches[patch].contacts.push_back(i);
  }
  for (Contact_patch& patch : patches) measure(patch, contacts);
  return patches;
}

}  // namespace lodestone
