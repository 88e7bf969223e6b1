// What a gzip stream, of several members too, or a bare zlib stream unpacks to. A stream that is cut, whose checksum
// does not fit, or behind which more stands than a line's end is a LoadError of one line. Any thread, a stream one
// thread; 256 KB of memory; about 300 MB/s.
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
/// Fewer if the stream ends before or is damaged.
std::string firstDecompressedBytes(const RegularFile& file, std::size_t count);

}  // namespace assets
