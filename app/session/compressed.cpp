#include "app/session/compressed.h"

#include <new>
#include <string>

#include <zstd.h>

#include "app/session/session_error.h"

namespace app {
namespace {

constexpr int kLevel = 3;
/// A block of at most 128 KiB takes at least 4 bytes (RFC 8878, 3.1.1.2), which bounds the ratio.
constexpr std::size_t kMaxRatio = 32'768;

}  // namespace

struct Compressor::Context {
  ZSTD_CCtx* zstd = ZSTD_createCCtx();
  ~Context() { ZSTD_freeCCtx(zstd); }
};

Compressor::Compressor() : context_(std::make_unique<Context>()) {
  if (context_->zstd == nullptr) throw std::bad_alloc();
}
Compressor::~Compressor() = default;

std::vector<std::uint8_t> Compressor::compress(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compressCCtx(context_->zstd, out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size))
    throw SessionError(std::string("cannot compress: ") + ZSTD_getErrorName(size) + ": check the free memory",
                       SessionErrorKind::failed);
  out.resize(size);
  return out;
}

void refuseUnlessContentSize(std::span<const std::uint8_t> compressed, std::size_t expected_bytes) {
  if (ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != expected_bytes ||
      expected_bytes / kMaxRatio > compressed.size())
    throw damagedSession("a compressed part is not the " + std::to_string(expected_bytes) + " bytes it should be");
}

void decompressInto(std::span<std::uint8_t> out, std::span<const std::uint8_t> compressed) {
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), compressed.data(), compressed.size());
  if (ZSTD_isError(size) || size != out.size()) throw damagedSession("a compressed part cannot be read");
}

std::vector<std::uint8_t> decompress(std::span<const std::uint8_t> compressed, std::size_t expected_bytes) {
  refuseUnlessContentSize(compressed, expected_bytes);
  std::vector<std::uint8_t> out(expected_bytes);
  decompressInto(out, compressed);
  return out;
}

}  // namespace app
