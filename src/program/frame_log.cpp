// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/frame_log.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/results/frame_json.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

Json points_json(const Intersection_points& points) {
  Json json = Json::array();
  for (const auto& p : points) json.push_back({p.x(), p.y(), p.z()});
  return json;
}

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// The name of the object that is inside the other, or null.
Json inside_json(const std::vector<Scene_object>& objects, const Pair_result& pair) {
  if (pair.containment == Containment::none) return nullptr;
  return objects[pair.containment == Containment::a_in_b ? pair.a : pair.b].name;
}

Json normal_json(const Contact_normal& contact) {
  return {{"normal", vector_json(contact.normal)}, {"depth", contact.depth}};
}

Json parting_json(const std::optional<Parting>& parting) {
  if (!parting) return nullptr;
  return {{"translation", vector_json(parting->translation)}, {"length", parting->length}};
}

using Faces_in_files = std::array<std::uint32_t, 2>;

/// The faces of each contact as the files number them, and the index of that contact in the frame. Sorted here, since
/// the triangles of a polygon need not follow each other in the mesh.
std::vector<std::pair<Faces_in_files, std::size_t>> contacts_in_files(const Scene_object& a, const Scene_object& b,
                                                                      const Frame& frame, const Pair_result& pair) {
  std::vector<std::pair<Faces_in_files, std::size_t>> contacts;
  std::size_t index = pair.first_contact;
  for (const auto& [face_a, face_b] : frame.contacts(pair))
    contacts.push_back({{a.file_face[face_a], b.file_face[face_b]}, index++});
  std::ranges::sort(contacts);
  return contacts;
}

/// @param contacts  as they are listed: patches refer to them by their indices in that list
Json patches_json(std::span<const Contact_patch> patches, const Pair_result& pair,
                  std::span<const std::pair<Faces_in_files, std::size_t>> contacts) {
  std::vector<std::uint32_t> listed(contacts.size());
  for (std::uint32_t i = 0; i < contacts.size(); ++i) listed[contacts[i].second - pair.first_contact] = i;
  std::vector<std::pair<std::vector<std::uint32_t>, const Contact_patch*>> sorted;
  for (const auto& patch : patches) {
    auto& indices = sorted.emplace_back(std::vector<std::uint32_t>(), &patch).first;
    for (const auto contact : patch.contacts) indices.push_back(listed[contact]);
    std::ranges::sort(indices);
  }
  std::ranges::sort(sorted);  // by their first contacts, of which no two have the same
  Json json = Json::array();
  for (const auto& [indices, patch] : sorted)
    json.push_back({{"point", vector_json(patch->point)},
                    {"normal", vector_json(patch->normal)},
                    {"depth", patch->depth},
                    {"length", patch->length},
                    {"contacts", indices}});
  return json;
}

/// What is told of the contacts: their faces, and if asked for their normals, patches and points.
void add_contacts(Json& json, std::span<const std::pair<Faces_in_files, std::size_t>> contacts, const Frame& frame,
                  const Pair_result& pair, const Detector_options& options) {
  auto& faces = json["faces"] = Json::array();
  for (const auto& [in_files, index] : contacts) faces.push_back(in_files);
  if (tolerance_of(options.exact, {pair.a, pair.b}) > 0) {
    auto& intersects = json["intersects"] = Json::array();
    for (const auto& [in_files, index] : contacts) intersects.push_back(frame.intersects(index));
  }
  if (options.contact_normals) {
    auto& normals = json["normals"] = Json::array();
    for (const auto& [in_files, index] : contacts) normals.push_back(normal_json(frame.contact_normals[index]));
  }
  if (options.exact.patches) json["patches"] = patches_json(frame.patches_of(pair), pair, contacts);
  if (options.contact_points) {
    auto& points = json["points"] = Json::array();
    for (const auto& [in_files, index] : contacts) points.push_back(points_json(frame.contact_points[index]));
  }
}

Json pair_json(const std::vector<Scene_object>& objects, const Frame& frame, const Pair_result& pair,
               const Detector_options& options) {
  const auto &a = objects[pair.a], &b = objects[pair.b];
  Json json = verdict_json(a.name, b.name, pair, options);
  if (options.exact.containment && pair.a != pair.b) json["inside"] = inside_json(objects, pair);
  if (options.exact.parting && pair.a != pair.b) json["parting"] = parting_json(pair.parting);
  if (pair.capped) json["capped"] = true;
  if (pair.unfinished) json["unfinished"] = true;
  if (options.contacts != Contact_query::yes_no)
    add_contacts(json, contacts_in_files(a, b, frame, pair), frame, pair, options);
  return json;
}

Json closest_json(const std::vector<Scene_object>& objects, std::span<const Pair_closest> closest) {
  const auto point = [](const Point& p) { return Json{p.x(), p.y(), p.z()}; };
  Json json = Json::array();
  for (const auto& [pair, found] : closest) {
    const auto &a = objects[pair.a], &b = objects[pair.b];
    json.push_back({{"a", a.name},
                    {"b", b.name},
                    {"distance", found.points.distance},
                    {"faces", {a.file_face[found.faces.a], b.file_face[found.faces.b]}},
                    {"points", {point(found.points.a), point(found.points.b)}}});
  }
  return json;
}

Json impacts_json(const std::vector<Scene_object>& objects, std::span<const Object_impact> impacts) {
  Json json = Json::array();
  for (const auto& [pair, impact] : impacts) {
    const auto &a = objects[pair.a], &b = objects[pair.b];
    json.push_back({{"a", a.name},
                    {"b", b.name},
                    {"time", impact.time},
                    {"faces", {a.file_face[impact.faces.a], b.file_face[impact.faces.b]}},
                    {"point", {impact.point.x(), impact.point.y(), impact.point.z()}}});
  }
  return json;
}

}  // namespace

const Pair_result* listed(const Frame& frame, Object_pair pair) {
  const auto found =
      std::ranges::find_if(frame.pairs, [pair](const auto& other) { return other.a == pair.a && other.b == pair.b; });
  return found == frame.pairs.end() ? nullptr : &*found;
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string frame_line(std::size_t frame, const std::vector<Scene_object>& objects, const Frame_findings& findings,
                       const Detector_options& options, bool independent) {
  const auto& [result, truth, closest, impacts] = findings;
  Json pairs = Json::array();
  for (const auto& pair : result.pairs) pairs.push_back(pair_json(objects, result, pair, options));
  if (truth) {
    for (const auto& [pair, faces] : *truth) {
      if (const Pair_result* found = listed(result, pair))
        pairs[static_cast<std::size_t>(found - result.pairs.data())]["truth"] = !faces.empty();
      else if (!faces.empty())
        pairs.push_back(
            {{"a", objects[pair.a].name}, {"b", objects[pair.b].name}, {"collides", false}, {"truth", true}});
    }
  }
  Json line{{"frame", frame}, {"pairs", std::move(pairs)}};
  if (closest) line["closest"] = closest_json(objects, *closest);
  if (impacts) line["impacts"] = impacts_json(objects, *impacts);
  line["statistics"] = statistics_json(result.statistics, options.mode, independent);
  return json_text(line);
}

}  // namespace lodestone
