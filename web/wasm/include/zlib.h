// SPDX-License-Identifier: GPL-3.0-or-later
// The part of zlib that pages need, without compression: deflate streams of stored blocks (RFC 1951, 3.2.4). A page
// that stays in the browser need not be small.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

using Bytef = unsigned char;
using uInt = unsigned;

struct z_stream {
  Bytef* next_in = nullptr;
  uInt avail_in = 0;
  Bytef* next_out = nullptr;
  uInt avail_out = 0;
  std::string waiting = {};  ///< for room in the output
  bool finished = false;
};

inline constexpr int Z_OK = 0, Z_NO_FLUSH = 0, Z_FINISH = 4, Z_BEST_COMPRESSION = 9, Z_DEFLATED = 8,
                     Z_DEFAULT_STRATEGY = 0;

inline int deflateInit2(z_stream*, int, int, int, int, int) { return Z_OK; }
inline int deflateEnd(z_stream*) { return Z_OK; }

/// @param last  whether it is the last of the stream
inline void add_stored_block(std::string& out, const Bytef* bytes, std::size_t size, bool last) {
  const auto low = [](std::size_t number) { return static_cast<char>(number & 0xff); };
  const std::size_t complement = ~size;
  out += {low(last ? 1 : 0), low(size), low(size >> 8), low(complement), low(complement >> 8)};
  out.append(reinterpret_cast<const char*>(bytes), size);
}

inline int deflate(z_stream* stream, int flush) {
  constexpr std::size_t largest_block = 0xffff;
  while (stream->avail_in > 0) {
    const auto size = std::min<std::size_t>(largest_block, stream->avail_in);
    add_stored_block(stream->waiting, stream->next_in, size, false);
    stream->next_in += size;
    stream->avail_in -= static_cast<uInt>(size);
  }
  if (flush == Z_FINISH && !stream->finished) {
    add_stored_block(stream->waiting, nullptr, 0, true);
    stream->finished = true;
  }
  const auto size = std::min<std::size_t>(stream->avail_out, stream->waiting.size());
  std::memcpy(stream->next_out, stream->waiting.data(), size);
  stream->waiting.erase(0, size);
  stream->next_out += size;
  stream->avail_out -= static_cast<uInt>(size);
  return Z_OK;
}
