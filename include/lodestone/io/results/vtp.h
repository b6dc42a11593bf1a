// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/concepts.h"

/// Files for ParaView and other programs built on VTK: points with lines and polygons, and lists of such files over
/// time.
namespace lodestone {

/// A named array with one number per point or per cell.
struct Vtp_array {
  std::string name;  ///< as ParaView lists it
  /// In the order of points, or of cells.
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint32_t>, std::vector<double>> values;
};

/// The contents of a .vtp file. Cells are in VTK's order: first all vertices, then all lines, then all polygons.
struct Vtp_data {
  std::vector<Point> points = {};                         ///< of all cells
  std::vector<std::vector<std::uint32_t>> vertices = {};  ///< cells of one point each
  std::vector<std::vector<std::uint32_t>> lines = {};     ///< of two points or more
  std::vector<std::vector<std::uint32_t>> polygons = {};  ///< of three points or more
  std::vector<Vtp_array> point_data = {};                 ///< arrays with one number per point
  std::vector<Vtp_array> cell_data = {};                  ///< arrays with one number per cell
};

/// Writes XML PolyData: a text header, followed by all numbers as raw little-endian bytes (`appended` data). The file
/// appears whole or not at all.
/// @throws Bad_output
/// @throws Bad_argument  an array without one number per point or cell, a cell that refers to a point out of range
void write_vtp(const std::filesystem::path& file, const Vtp_data& data);
/// The same to a file that has been opened, which it commits.
void write_vtp(Atomic_file& file, const Vtp_data& data);

/// One moment of a .pvd file.
struct Pvd_step {
  double time = 0;   ///< as ParaView shows it
  std::string file;  ///< relative to the .pvd file
};

/// Text of a .pvd file: the list of .vtp files that ParaView plays as one object over time.
std::string pvd_text(const std::vector<Pvd_step>& steps);

}  // namespace lodestone
