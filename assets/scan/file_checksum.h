// Checksum trailer at the end of a file, so that OpenVDB, which crashes on damaged input, is given intact files only.
// Layout, little endian, after the file's own bytes: u64 length, u32 CRC-32, u32 Adler-32, 8 bytes "MOLARSEA". OpenVDB
// tools seek by offsets and ignore it. Detects accidents, not forgery. Any thread; one pass, about 1 GB/s.
#pragma once

#include <string>

namespace assets {

/// Throws LoadError if the file cannot be written.
void appendChecksum(const std::string& path);

/// Throws LoadError if there is no such file, no checksum, or a byte has changed.
void requireChecksum(const std::string& path);

}  // namespace assets
