// A piece of sound as one whole FLAC file in memory: 16 bits, mono. Any thread; 5 ms for 2 s at 48 kHz.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Samples -1..1; what is louder is cut off. Throws UsageError: there is no memory.
std::string flacOf(std::span<const float> samples, int rate_Hz);

/// None: it is no such file, of another rate, or longer than `most` samples.
std::optional<std::vector<float>> soundOfFlac(std::string_view flac, int rate_Hz, std::size_t most);

}  // namespace app
