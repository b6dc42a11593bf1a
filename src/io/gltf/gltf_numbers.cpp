// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf/gltf_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/files/byte_order.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

[[noreturn]] void fail(const std::string& name, int accessor, const std::string& cause) {
  throw Bad_mesh(fmt::format("{}: /accessors/{}: {}", name, accessor, cause));
}

/// Integers of T as they are or, if normalized, divided by the largest T.
template <class T>
double integer_at(const char* bytes, bool normalized) {
  const auto value = static_cast<double>(load<T>(bytes));
  return normalized ? std::max(value / std::numeric_limits<T>::max(), -1.0) : value;
}

double number_at(const char* bytes, int component, bool normalized) {
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integer_at<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integer_at<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integer_at<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integer_at<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integer_at<std::uint32_t>(bytes, normalized);
    default:
      return load<float>(bytes);
  }
}

const char* view_bytes(const tinygltf::Model& model, int view, std::size_t offset) {
  const auto& place = model.bufferViews[static_cast<std::size_t>(view)];
  const auto& buffer = model.buffers[static_cast<std::size_t>(place.buffer)];
  return reinterpret_cast<const char*>(buffer.data.data()) + place.byteOffset + offset;
}

/// Overwrites elements with those of a sparse accessor.
void overlay(const tinygltf::Model& model, int number, std::size_t width, const std::string& name,
             std::vector<double>& values) {
  const auto& accessor = model.accessors[static_cast<std::size_t>(number)];
  const auto& sparse = accessor.sparse;
  const auto bytes_of = [](int component) {
    return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component)));
  };
  const auto* const indices =
      view_bytes(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset));
  const auto* const numbers =
      view_bytes(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset));
  double last = -1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
    const auto index =
        number_at(indices + i * bytes_of(sparse.indices.componentType), sparse.indices.componentType, false);
    if (index <= last || index >= static_cast<double>(accessor.count))
      fail(name, number, fmt::format("sparse index {} is out of order, or not below {}", index, accessor.count));
    last = index;
    for (std::size_t k = 0; k < width; ++k)
      values[static_cast<std::size_t>(index) * width + k] = number_at(
          numbers + (i * width + k) * bytes_of(accessor.componentType), accessor.componentType, accessor.normalized);
  }
}

}  // namespace

std::vector<double> gltf_numbers(const tinygltf::Model& model, int number, const std::string& name) {
  const auto& accessor = model.accessors[static_cast<std::size_t>(number)];
  const auto width =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  const auto bytes =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
  std::vector<double> values(accessor.count * width);
  if (accessor.bufferView >= 0) {
    const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const auto stride = view.byteStride > 0 ? view.byteStride : width * bytes;
    const auto* const first = view_bytes(model, accessor.bufferView, accessor.byteOffset);
    for (std::size_t i = 0; i < accessor.count; ++i)
      for (std::size_t k = 0; k < width; ++k)
        values[i * width + k] = number_at(first + i * stride + k * bytes, accessor.componentType, accessor.normalized);
  }
  if (accessor.sparse.isSparse) overlay(model, number, width, name, values);
  const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
  if (bad != values.end())
    fail(name, number, fmt::format("element {} (counted from 0) is not finite", (bad - values.begin()) / width));
  return values;
}

std::vector<std::uint32_t> gltf_whole_numbers(const tinygltf::Model& model, int number, const std::string& name) {
  const auto values = gltf_numbers(model, number, name);
  return {values.begin(), values.end()};
}

}  // namespace lodestone
