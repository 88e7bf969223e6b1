#include "app/session/compressed.h"

#include <string>

#include <zstd.h>

#include "app/session/session_error.h"

namespace app {

namespace {
constexpr int kLevel = 3;
}

std::vector<std::uint8_t> compress(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size)) throw SessionError(std::string("can not compress: ") + ZSTD_getErrorName(size));
  out.resize(size);
  out.shrink_to_fit();
  return out;
}

std::vector<std::uint8_t> decompress(std::span<const std::uint8_t> compressed, std::size_t expected_bytes) {
  // The frame says its size itself: a lying or damaged one is refused before anything is allocated.
  if (ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != expected_bytes) {
    throw SessionError("a compressed part is not the " + std::to_string(expected_bytes) +
                       " bytes it should be: the session is damaged");
  }
  std::vector<std::uint8_t> out(expected_bytes);
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), compressed.data(), compressed.size());
  if (ZSTD_isError(size) || size != expected_bytes) {
    throw SessionError("a compressed part can not be read: the session is damaged");
  }
  return out;
}

}  // namespace app
