// A appendChecksum at the end of a file: its length and checksums of its bytes. A reader that is helpless against
// damage (OpenVDB) is shown only files whose appendChecksum holds, so only whole files that this program wrote. Layout,
// little endian, after the file's own bytes: u64 length, u32 CRC-32, u32 Adler-32, 8 bytes "MOLARSEA". Readers that
// seek by offsets, as every OpenVDB tool does, never look there. Any thread; reads the file once, about 1 GB/s. Guards
// against accidents, not against forgery.
#pragma once

#include <string>

namespace assets {

/// Appends the appendChecksum. Throws LoadError if the file can not be written.
void appendChecksum(const std::string& path);

/// Throws LoadError if there is no such file, no appendChecksum, or a byte has changed.
void requireChecksum(const std::string& path);

}  // namespace assets
