// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/files/byte_order.h"
#include "io/files/small_text.h"
#include "io/results/animation_frames.h"
#include "io/results/region_colour.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/files/atomic_files.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The number of weights is quadratic in the number of frames, and graphics cards support 2048 texture layers.
constexpr std::size_t most_gltf_frames = 2048;
// The largest change of the time between two frames by rounding to floats, as a share of that time. Beyond it readers,
// `uniform_keys` too, may not see that frames follow each other at equal distances.
constexpr double most_rounding = 0.25;

// Constants of the format.
constexpr int unsigned_byte = 5121, unsigned_int = 5125, floats = 5126;
constexpr int vertex_data = 34962, index_data = 34963;

/// The smallest and the largest coordinates of one accessor.
struct Range {
  std::array<float, 3> low{}, high{};
};

void extend(Range& range, std::size_t i, float value) {
  auto& [low, high] = range;
  low[i % 3] = i < 3 ? value : std::min(low[i % 3], value);
  high[i % 3] = i < 3 ? value : std::max(high[i % 3], value);
}

/// From the first frame to another.
std::vector<float> difference(std::span<const float> frame, const std::vector<float>& first) {
  std::vector<float> result(first.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    result[i] = static_cast<float>(static_cast<double>(frame[i]) - static_cast<double>(first[i]));
  return result;
}

/// From sRGB to linear light, which glTF uses for vertex colours.
std::uint8_t linear(std::uint8_t channel) {
  const double shown = channel / 255.0;
  const double light = shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
  return static_cast<std::uint8_t>(std::lround(255 * light));
}

/// Writes one animation. The indices of accessors and buffer views follow from the order in `json`.
class Gltf_writer {
 public:
  Gltf_writer(const fs::path& output, const Animation& animation, const Animation_output_options& options)
      : animation_(animation), options_(options), frames_(output, animation, options, 2) {}

  /// Reads all frames once, for the ranges that the JSON states before the data.
  void measure();
  /// @param uri  of the buffer; empty: the binary chunk after the JSON
  Json json(const std::string& uri) const;
  std::size_t buffer_bytes() const;
  /// Reads all frames once more.
  void write_buffer(Atomic_file& out);

 private:
  std::size_t vertices() const { return animation_.vertices; }
  /// A view of the buffer.
  struct View {
    std::size_t bytes = 0;
    int stride = 0, target = 0;  ///< 0: not given
  };
  /// Corners, positions of each frame, colours, times, weights; in the order of the buffer.
  std::vector<View> views() const;
  Json view_list() const;
  Json accessors() const;
  std::string small_views() const;

  const Animation& animation_;
  const Animation_output_options& options_;
  Animation_frames frames_;
  std::vector<Range> ranges_;
  std::vector<float> first_;
};

void Gltf_writer::measure() {
  if (frames_.size() > most_gltf_frames)
    throw Bad_argument(fmt::format("glTF output has at most {} frames, found {}", most_gltf_frames, frames_.size()));
  const double step = 1 / options_.frames_per_second;
  for (std::size_t frame = 1; frame < frames_.size(); ++frame)
    if (const double before = frames_.time(frame - 1), time = frames_.time(frame);
        !(std::abs(time - before - step) <= most_rounding * step))
      throw Bad_argument(
          fmt::format("glTF times are floats, too coarse here: frames {} and {} would be {} s apart, not {} s",
                      frame - 1, frame, time - before, step));
  ranges_.resize(frames_.size());
  for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
    const auto found = frames_.floats(frame);
    if (frame == 0) first_.assign(found.begin(), found.end());
    const auto stored = frame == 0 ? first_ : difference(found, first_);
    for (std::size_t i = 0; i < stored.size(); ++i) {
      if (!std::isfinite(stored[i]))
        throw Bad_motion(fmt::format("vertex {} (counted from 0) moves farther than a float can express", i / 3));
      extend(ranges_[frame], i, stored[i]);
    }
  }
}

std::vector<Gltf_writer::View> Gltf_writer::views() const {
  const auto frames = frames_.size();
  std::vector<View> views{{.bytes = 12 * animation_.faces.size(), .target = index_data}};
  // Readers store offsets within a view as 32-bit numbers, and all frames together can be longer.
  views.insert(views.end(), frames, {.bytes = 12 * vertices(), .stride = 12, .target = vertex_data});
  if (!options_.regions.empty()) views.push_back({.bytes = 4 * vertices(), .stride = 4, .target = vertex_data});
  if (frames == 1) return views;
  views.push_back({.bytes = 4 * frames});
  views.push_back({.bytes = 4 * frames * (frames - 1)});
  return views;
}

std::size_t Gltf_writer::buffer_bytes() const {
  std::size_t sum = 0;
  for (const View& view : views()) sum += view.bytes;
  return sum;
}

Json Gltf_writer::view_list() const {
  Json result = Json::array();
  std::size_t begin = 0;
  for (const View& view : views()) {
    Json json{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", view.bytes}};
    if (view.stride > 0) json["byteStride"] = view.stride;
    if (view.target > 0) json["target"] = view.target;
    result.push_back(std::move(json));
    begin += view.bytes;
  }
  return result;
}

/// Corners, positions of each frame, colours, times, weights: one per view.
Json Gltf_writer::accessors() const {
  Json result = Json::array();
  const auto add = [&](int component, std::size_t count, const char* type) -> Json& {
    result.push_back({{"bufferView", result.size()}, {"componentType", component}, {"count", count}, {"type", type}});
    return result.back();
  };
  add(unsigned_int, 3 * animation_.faces.size(), "SCALAR");
  for (const Range& range : ranges_) {
    auto& accessor = add(floats, vertices(), "VEC3");
    accessor["min"] = range.low;
    accessor["max"] = range.high;
  }
  if (!options_.regions.empty()) add(unsigned_byte, vertices(), "VEC4")["normalized"] = true;
  const auto frames = frames_.size();
  if (frames == 1) return result;
  auto& times = add(floats, frames, "SCALAR");
  times["min"] = {frames_.time(0)};
  times["max"] = {frames_.time(frames - 1)};
  add(floats, frames * (frames - 1), "SCALAR");
  return result;
}

Json Gltf_writer::json(const std::string& uri) const {
  const auto frames = frames_.size();
  const bool coloured = !options_.regions.empty();
  Json primitive{{"attributes", {{"POSITION", 1}}}, {"indices", 0}};
  if (coloured) primitive["attributes"]["COLOR_0"] = frames + 1;
  for (std::size_t frame = 1; frame < frames; ++frame) primitive["targets"].push_back({{"POSITION", frame + 1}});
  Json buffer{{"byteLength", buffer_bytes()}};
  if (!uri.empty()) buffer["uri"] = uri;
  // Double-sided, since surfaces may be open.
  primitive["material"] = 0;
  Json result{{"asset", {{"version", "2.0"}, {"generator", "Lodestone"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},
              {"nodes", {{{"mesh", 0}}}},
              {"materials", {{{"doubleSided", true}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}}},
              {"meshes", {{{"primitives", Json::array({primitive})}}}},
              {"buffers", Json::array({buffer})},
              {"bufferViews", view_list()},
              {"accessors", accessors()}};
  if (frames == 1) return result;
  const auto times = frames + 1 + (coloured ? 1 : 0);
  result["animations"] = {{{"name", "frames"},
                           {"samplers", {{{"input", times}, {"interpolation", "LINEAR"}, {"output", times + 1}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  return result;
}

/// Colours, times and weights.
std::string Gltf_writer::small_views() const {
  std::string bytes;
  for (const auto region : options_.regions) {
    for (const auto channel : region_colour(region)) append(bytes, linear(channel));
    append(bytes, std::uint8_t{255});
  }
  const auto frames = frames_.size();
  for (std::size_t frame = 0; frame < frames && frames > 1; ++frame) append(bytes, frames_.time(frame));
  for (std::size_t frame = 0; frame < frames; ++frame)
    for (std::size_t target = 1; target < frames; ++target) append(bytes, target == frame ? 1.F : 0.F);
  return bytes;
}

void Gltf_writer::write_buffer(Atomic_file& out) {
  std::string bytes;
  for (const auto& face : animation_.faces)
    for (const auto corner : face) append(bytes, corner);
  out.write(bytes);
  for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
    bytes.clear();
    const auto found = frames_.floats(frame);
    for (const float value : frame == 0 ? first_ : difference(found, first_)) append(bytes, value);
    out.write(bytes);
  }
  out.write(small_views());
}

void write_glb(const fs::path& output, Gltf_writer& writer) {
  auto text = writer.json({}).dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  constexpr std::size_t headers = 28;
  const auto length = headers + text.size() + writer.buffer_bytes();
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw Bad_argument(
        fmt::format("{}: {} bytes are too many for a .glb file; .gltf has no such limit", output.string(), length));
  std::string head = "glTF";
  for (const auto number : {std::size_t{2}, length, text.size()}) append(head, static_cast<std::uint32_t>(number));
  head += "JSON" + text;
  append(head, static_cast<std::uint32_t>(writer.buffer_bytes()));
  head += std::string("BIN\0", 4);
  Atomic_file out(output);
  out.write(head);
  writer.write_buffer(out);
  out.commit();
}

/// `name` with the characters percent-encoded that a URI may not contain.
std::string in_uri(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    result += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

void write_gltf_and_bin(const fs::path& output, Gltf_writer& writer) {
  Atomic_files files(output.parent_path());
  const auto buffer = output.filename().replace_extension(".bin");
  const auto name = buffer.string();
  if (std::ranges::any_of(name, [](unsigned char c) { return c < ' ' || c == 0x7f; }))
    throw Bad_argument(printable(output.string()) + ": the name of a .gltf file may have no control characters");
  Atomic_file bytes = files.open(buffer);
  writer.write_buffer(bytes);
  bytes.commit();
  Atomic_file text = files.open(output.filename());
  text.write(writer.json(in_uri(name)).dump(1) + "\n");
  text.commit();
  files.commit();
}

}  // namespace

void write_gltf(const fs::path& output, const Animation& animation, const Animation_output_options& options) {
  if (!options.regions.empty() && options.regions.size() != animation.vertices)
    throw Bad_argument(fmt::format("{} regions are given for {} vertices", options.regions.size(), animation.vertices));
  Gltf_writer writer(output, animation, options);
  writer.measure();
  if (lower_case(output.extension().string()) == ".glb")
    write_glb(output, writer);
  else
    write_gltf_and_bin(output, writer);
}

}  // namespace lodestone
