// Decompressed bytes of a gzip stream, of several members too, or a bare zlib stream. Throws LoadError of one line for
// a truncated stream, a wrong checksum, or more than a line end after it. One thread a stream; 256 KB; about 300 MB/s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "assets/scan/byte_source.h"
#include "assets/scan/regular_file.h"

namespace assets {

std::unique_ptr<ByteSource> decompressedSource(const RegularFile& file, std::uint64_t from_byte);

bool isGzip(const RegularFile& file);
/// Fewer if the stream ends earlier or is damaged.
std::string firstDecompressedBytes(const RegularFile& file, std::size_t count);

}  // namespace assets
