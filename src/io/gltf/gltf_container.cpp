// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <tiny_gltf.h>
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "io/files/byte_order.h"
#include "io/files/file_bytes.h"
#include "io/files/inside_folder.h"
#include "io/files/json_reader.h"
#include "io/gltf/gltf_container.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

namespace fs = std::filesystem;
using detail::Json_value;

// A binary glTF file: magic number, version, length of the file; then chunks, each preceded by its length and type.
constexpr std::string_view glb_magic = "glTF";
constexpr std::size_t glb_header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

constexpr std::size_t most_buffers = 100'000;

struct Chunk {
  std::uint32_t type = 0;
  std::string_view bytes;
};

/// Reads the chunk at `offset` and advances `offset` past it; nothing at the end of the file.
std::optional<Chunk> next_chunk(const File_bytes& file, std::string_view bytes, std::size_t& offset) {
  if (offset == bytes.size()) return std::nullopt;
  if (bytes.size() - offset < chunk_header_bytes) file.fail_at(offset, "the file ends within the header of a chunk");
  const auto length = load<std::uint32_t>(bytes.data() + offset);
  const auto type = load<std::uint32_t>(bytes.data() + offset + 4);
  const auto body = offset + chunk_header_bytes;
  if (length > bytes.size() - body)
    file.fail_at(offset,
                 fmt::format("a chunk of {} bytes does not fit into the {} that follow", length, bytes.size() - body));
  offset = body + length;
  return Chunk{type, bytes.substr(body, length)};
}

void read_binary_gltf(const File_bytes& file, Gltf_document& document) {
  if (file.view().size() < glb_header_bytes) file.fail_at(file.view().size(), "the file ends within the header");
  const auto version = load<std::uint32_t>(file.view().data() + 4);
  const auto length = load<std::uint32_t>(file.view().data() + 8);
  if (version != 2) file.fail_at(4, fmt::format("expected version 2, found {}", version));
  if (length < glb_header_bytes || length > file.view().size())
    file.fail_at(8, fmt::format("{} bytes are announced, the file has {}", length, file.view().size()));
  const auto bytes = file.view().substr(0, length);

  auto offset = glb_header_bytes;
  const auto first = next_chunk(file, bytes, offset);
  if (!first || first->type != json_chunk) file.fail_at(glb_header_bytes, "expected a chunk of JSON");
  document.json = detail::parse_json_text(first->bytes, document.name);
  if (const auto second = next_chunk(file, bytes, offset); second && second->type == binary_chunk) {
    document.has_binary = true;
    document.binary.assign(second->bytes.begin(), second->bytes.end());
  }
  while (next_chunk(file, bytes, offset)) continue;  // further chunks must be complete, and are ignored
}

/// `uri` with percent-encoded characters decoded.
std::string decoded(const std::string& uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto digits = uri.substr(i + 1, 2);
    const bool escaped =
        uri[i] == '%' && digits.size() == 2 && digits.find_first_not_of("0123456789abcdefABCDEF") == digits.npos;
    result += escaped ? static_cast<char>(std::stoi(digits, nullptr, 16)) : uri[i];
    if (escaped) i += 2;
  }
  return result;
}

Bytes read_start(const fs::path& file, std::size_t length, const Json_value& uri) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!exists(status)) uri.fail(fmt::format("{}: there is no such file", detail::quoted_name(file.string())));
  // A pipe or a device could deliver bytes without end.
  if (!is_regular_file(status))
    uri.fail(fmt::format("{}: this is not a regular file", detail::quoted_name(file.string())));
  if (fs::file_size(file, error) < length)
    uri.fail(fmt::format("{}: the file is shorter than the {} bytes of its buffer", detail::quoted_name(file.string()),
                         length));
  Bytes bytes(length);
  std::ifstream in(file, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(length)))
    uri.fail(fmt::format("{}: the file cannot be read", detail::quoted_name(file.string())));
  return bytes;
}

/// What a data URI holds, whatever it names as its media type.
/// @param data  what follows `data:`
Bytes from_data_uri(const Json_value& uri, std::string_view data, std::size_t length) {
  constexpr std::string_view base64 = ";base64";
  const auto comma = data.find(',');
  if (comma == data.npos || !data.substr(0, comma).ends_with(base64)) uri.fail("expected a data URI in base64");
  const auto text = data.substr(comma + 1);
  if (text.size() < length) uri.fail(fmt::format("{} bytes are announced, the data URI is too short for them", length));
  Bytes bytes;
  std::string media_type;
  const bool is_decoded = tinygltf::DecodeDataURI(
      &bytes, media_type, fmt::format("data:application/octet-stream;base64,{}", text), 0, false);
  if (!is_decoded || bytes.size() < length)
    uri.fail(fmt::format("{} bytes are announced, the data URI has {}", length, bytes.size()));
  bytes.resize(length);
  return bytes;
}

Bytes from_uri(const Json_value& uri, std::size_t length, const fs::path& folder, Gltf_document& document) {
  const auto text = uri.text();
  constexpr std::string_view data = "data:";
  if (text.starts_with(data)) return from_data_uri(uri, std::string_view(text).substr(data.size()), length);
  const auto name = decoded(text);
  const bool is_printable = std::ranges::none_of(name, [](unsigned char c) { return c < ' ' || c == 0x7f; });
  // In what is not encoded, a colon ends a scheme, such as `http:`.
  if (!is_printable || text.find(':') != text.npos || !is_inside(folder, name))
    uri.fail(fmt::format("{} is not a file inside the folder of the glTF file", detail::quoted_name(name)));
  document.files.push_back(folder / name);
  return read_start(folder / name, length, uri);
}

}  // namespace

Gltf_document read_gltf_document(const fs::path& file, std::uintmax_t max_bytes) {
  const File_bytes bytes(file, max_bytes);
  Gltf_document document{.name = bytes.name(), .files = {file}};
  if (bytes.view().starts_with(glb_magic))
    read_binary_gltf(bytes, document);
  else
    document.json = detail::parse_json_text(bytes.view(), document.name);
  if (!document.json.is_object()) throw Bad_mesh(fmt::format("{}: /: expected an object", document.name));
  return document;
}

std::vector<Bytes> read_gltf_buffers(Gltf_document& document, const fs::path& folder, std::uintmax_t max_bytes) {
  const Json_value root(document.json, document.name);
  std::vector<Bytes> buffers;
  std::uintmax_t together = 0;  // a file can name another as often as it likes
  for (const auto& buffer : root.list("buffers", most_buffers)) {
    const auto length = buffer.at("byteLength").count(1, std::size_t{1} << 40U);
    together += length;
    if (together > max_bytes)
      buffer.fail(fmt::format("the buffers up to this one have {} bytes together, where at most {} are allowed",
                              together, max_bytes));
    if (const auto uri = buffer.find("uri")) {
      buffers.push_back(from_uri(*uri, length, folder, document));
      continue;
    }
    if (!buffers.empty() || !document.has_binary) buffer.fail("has neither a URI nor a binary chunk");
    if (length > document.binary.size())
      buffer.fail(fmt::format("{} bytes are announced, the binary chunk has {}", length, document.binary.size()));
    document.binary.resize(length);
    buffers.push_back(std::move(document.binary));
  }
  return buffers;
}

}  // namespace lodestone
