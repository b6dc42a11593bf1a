// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/vtp.h"

#include <fmt/format.h>

#include <string_view>

#include "io/files/byte_order.h"
#include "lodestone/mesh/errors.h"
#include "mesh/coordinates_of.h"

namespace lodestone {
namespace {

using Cells = std::vector<std::vector<std::uint32_t>>;

constexpr const char* type_of(std::uint8_t) { return "UInt8"; }
constexpr const char* type_of(std::uint32_t) { return "UInt32"; }
constexpr const char* type_of(std::int64_t) { return "Int64"; }
constexpr const char* type_of(double) { return "Float64"; }

std::string in_xml(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// The two parts of the file under construction: the description of the arrays, and their bytes, each array preceded by
/// its length.
class Vtp_text {
 public:
  template <class Value>
  void add_array(std::string_view name, const std::vector<Value>& values, int components = 1) {
    header_ += fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
                           type_of(Value{}), in_xml(name), components, bytes_.size());
    header_ += '\n';
    append(bytes_, static_cast<std::uint64_t>(values.size() * sizeof(Value)));
    for (const Value value : values) append(bytes_, value);
  }
  void add_text(std::string_view text) { header_ += text; }

  void write(Atomic_file& file) const {
    file.write(header_);
    file.write("<AppendedData encoding=\"raw\">\n_");
    file.write(bytes_);
    file.write("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  std::string header_, bytes_;
};

void add_points(Vtp_text& text, const std::vector<Point>& points) {
  text.add_text("<Points>\n");
  text.add_array("Points", coordinates_of(points), 3);
  text.add_text("</Points>\n");
}

void add_cells(Vtp_text& text, const char* element, const Cells& cells, std::size_t points) {
  std::vector<std::int64_t> corners, ends;
  for (const auto& cell : cells) {
    for (const auto point : cell) {
      if (point >= points) throw Bad_argument(fmt::format("a cell refers to point {} of {}", point, points));
      corners.push_back(point);
    }
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  text.add_text(fmt::format("<{}>\n", element));
  text.add_array("connectivity", corners);
  text.add_array("offsets", ends);
  text.add_text(fmt::format("</{}>\n", element));
}

void add_data(Vtp_text& text, const char* element, const std::vector<Vtp_array>& arrays, std::size_t count) {
  text.add_text(fmt::format("<{}>\n", element));
  for (const auto& [name, values] : arrays)
    std::visit(
        [&, &array = name](const auto& numbers) {
          if (numbers.size() != count)
            throw Bad_argument(fmt::format("array {} has {} values, expected {}", array, numbers.size(), count));
          text.add_array(array, numbers);
        },
        values);
  text.add_text(fmt::format("</{}>\n", element));
}

}  // namespace

void write_vtp(Atomic_file& file, const Vtp_data& data) {
  Vtp_text text;
  text.add_text(fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      data.points.size(), data.vertices.size(), data.lines.size(), data.polygons.size()));
  add_points(text, data.points);
  add_cells(text, "Verts", data.vertices, data.points.size());
  add_cells(text, "Lines", data.lines, data.points.size());
  add_cells(text, "Polys", data.polygons, data.points.size());
  add_data(text, "PointData", data.point_data, data.points.size());
  add_data(text, "CellData", data.cell_data, data.vertices.size() + data.lines.size() + data.polygons.size());
  text.add_text("</Piece>\n</PolyData>\n");
  text.write(file);
  file.commit();
}

void write_vtp(const std::filesystem::path& file, const Vtp_data& data) {
  Atomic_file out(file);
  write_vtp(out, data);
}

std::string pvd_text(const std::vector<Pvd_step>& steps) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [time, file] : steps)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", time, in_xml(file));
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace lodestone
