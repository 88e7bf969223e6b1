// 8-bit grey values are no Hounsfield values: read as such, a whole jaw would be soft tissue. Recognised by all values
// lying in 0..255, whatever their type in the file; a window maps them to Hounsfield. Any thread; one pass.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace assets {

/// HU of the grey values 0 and 255; linear between.
struct GreyWindow {
  double low_hu = -1000.0, high_hu = 3000.0;
};

/// Throws LoadError: 8-bit grey values without a window, or a window for other values.
void applyGreyWindow(std::vector<std::int16_t>& values, const std::optional<GreyWindow>& window,
                     const std::string& path);

}  // namespace assets
