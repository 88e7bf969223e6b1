// 8-bit greys, as pictures have them, are no Hounsfield: taken for it a whole jaw is soft tissue and nothing is seen or
// felt. Told by the values (all within 0..255), whatever the type they are stored in. A window makes Hounsfield of
// them. Any thread; a pass over the voxels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace assets {

/// What the greys 0 and 255 mean; linear between.
struct GreyWindow {
  double low_hu = -1000.0, high_hu = 3000.0;
};

/// Applies the window. Throws LoadError: 8-bit greys without a window, or a window for other values.
void applyGreyWindow(std::vector<std::int16_t>& values, const std::optional<GreyWindow>& window,
                     const std::string& path);

}  // namespace assets
