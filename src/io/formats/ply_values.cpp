// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply_values.h"

#include <cmath>
#include <cstdint>

#include "io/files/byte_order.h"

namespace lodestone {
namespace {

double load_as_double(const char* bytes, Ply_type type, std::endian order) {
  switch (type) {
    case Ply_type::int8:
      return load<std::int8_t>(bytes, order);
    case Ply_type::uint8:
      return load<std::uint8_t>(bytes, order);
    case Ply_type::int16:
      return load<std::int16_t>(bytes, order);
    case Ply_type::uint16:
      return load<std::uint16_t>(bytes, order);
    case Ply_type::int32:
      return load<std::int32_t>(bytes, order);
    case Ply_type::uint32:
      return load<std::uint32_t>(bytes, order);
    case Ply_type::float32:
      return load<float>(bytes, order);
    case Ply_type::float64:
      return load<double>(bytes, order);
  }
  return 0;  // unreachable: the switch is complete
}

}  // namespace

std::string_view Ply_text_values::next_word() {
  const auto word = text_.next_word_of_file();
  if (word.empty()) text_.fail("the file ends before all that its header announces");
  return word;
}

double Ply_text_values::next(Ply_type) { return text_.number(next_word()); }

void Ply_text_values::skip(Ply_type) { next_word(); }

double Ply_binary_values::next(Ply_type type) {
  skip(type);
  const double value = load_as_double(file_.view().data() + at_, type, order_);
  if (!std::isfinite(value)) fail("a coordinate is not finite");
  return value;
}

void Ply_binary_values::skip(Ply_type type) {
  at_ = end_;
  if (bytes_left() < bytes_of(type)) fail("the file ends before all that its header announces");
  end_ += bytes_of(type);
}

}  // namespace lodestone
