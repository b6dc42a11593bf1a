// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh and the numbered files that move it. The first byte chooses their formats. A line `---` parts the files: the
// mesh, `frame_0`, `frame_1` and so on; up to four.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/read_input.h"
#include "fuzz/scratch_folder.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/scenes/scene_file.h"

namespace {

using namespace lodestone::fuzz;
using lodestone::Point;

constexpr std::array<std::string_view, 4> formats{".obj", ".off", ".ply", ".stl"};
constexpr std::size_t most_files = 4;

/// Up to four files; the last one is whatever is left.
std::vector<std::string_view> files_in(std::string_view text) {
  constexpr std::string_view line = "\n---\n";
  std::vector<std::string_view> files;
  for (auto end = text.find(line); end != text.npos && files.size() + 1 < most_files; end = text.find(line)) {
    files.push_back(text.substr(0, end + 1));
    text.remove_prefix(end + line.size());
  }
  files.push_back(text);
  return files;
}

/// The positions of a frame are those of its file, wherever the file can be read by itself.
void check_positions(const std::vector<Point>& positions, const std::filesystem::path& file) {
  accepts([&] {
    const auto read = lodestone::read_mesh(file);
    require(read.file_vertices == positions.size(), "a frame has another number of vertices than its file");
    for (const auto v : read.mesh.vertices())
      require(read.mesh.point(v) == positions[read.file_vertex[v]], "a vertex of a frame is not where its file says");
  });
}

/// STL files number their vertices each in its own way.
void check_frames(const lodestone::Motion& motion, std::size_t vertices, std::string_view format) {
  std::vector<Point> positions(vertices);
  for (std::size_t frame = 0; frame < motion.frames; ++frame)
    accepts([&] {
      motion.pose(frame, positions);
      if (format != ".stl")
        check_positions(positions, scratch().path() / ("frame_" + std::to_string(frame) + std::string(format)));
    });
}

void write_files(const std::vector<std::string_view>& files, std::string_view mesh_format, std::string_view format) {
  for (std::size_t frame = 0; frame < most_files; ++frame)
    std::filesystem::remove(scratch().path() / ("frame_" + std::to_string(frame) + std::string(format)));
  scratch().write("mesh" + std::string(mesh_format), files.front());
  for (std::size_t file = 1; file < files.size(); ++file)
    scratch().write("frame_" + std::to_string(file - 1) + std::string(format), files[file]);
  scratch().write("scene.json", R"({"objects": [{"name": "a", "mesh": "mesh)" + std::string(mesh_format) +
                                    R"(", "motion": {"sequence": "frame_#)" + std::string(format) + R"("}}]})");
}

}  // namespace

LODESTONE_FUZZ_TARGET(sequence) {
  if (input.empty()) return;
  const auto mesh_format = formats[input.front() % 4], format = formats[input.front() / 4 % 4];
  const auto files = files_in({reinterpret_cast<const char*>(input.data()) + 1, input.size() - 1});
  write_files(files, mesh_format, format);
  accepts([&] {
    const auto animation = lodestone::read_animation(scratch().path() / ("frame_#" + std::string(format)));
    require(animation.motion.frames == files.size() - 1, "a sequence has another number of frames than files");
    check_frames(animation.motion, animation.vertices, format);
  });
  accepts([&] {
    auto scene = lodestone::read_scene(scratch().path() / "scene.json");
    auto& object = scene.objects.front();
    require(object.mesh.is_valid(false), "an object with a sequence is invalid");
    check_frames(object.motion, object.file_vertices, format);
    for (std::size_t frame = 0; frame < scene.frames; ++frame) accepts([&] { pose(object, frame); });
  });
}
