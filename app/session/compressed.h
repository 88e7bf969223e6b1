// Bytes compressed with Zstandard for the session file, and back. Any thread, one Compressor a thread.
// Level 3: a block of 50 ticks in about 0.1 ms, a 16-million-voxel bone in about 0.1 s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace app {

/// Keeps its tables from one call to the next, which is half of the work for a block of ticks.
class Compressor {
 public:
  Compressor();
  ~Compressor();
  std::vector<std::uint8_t> compress(std::span<const std::uint8_t> bytes);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// The bytes again, which must be exactly as many as `out` has room for; throws SessionError otherwise.
void decompressInto(std::span<std::uint8_t> out, std::span<const std::uint8_t> compressed);

/// Throws SessionError unless the frame says that it holds so many bytes and can do so: before they are allocated.
void refuseUnlessContentSize(std::span<const std::uint8_t> compressed, std::size_t expected_bytes);

/// Both: judged, allocated, filled.
std::vector<std::uint8_t> decompress(std::span<const std::uint8_t> compressed, std::size_t expected_bytes);

}  // namespace app
