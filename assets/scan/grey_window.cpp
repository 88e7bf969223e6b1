#include "assets/scan/grey_window.h"

#include <algorithm>
#include <cmath>

#include "assets/load_error.h"

namespace assets {

void applyGreyWindow(std::vector<std::int16_t>& values, const std::optional<GreyWindow>& window,
                     const std::string& path) {
  constexpr int kMaxGrey = 255;
  const auto [min, max] = std::ranges::minmax(values);
  const bool is_8_bit = min >= 0 && max <= kMaxGrey;
  if (is_8_bit && !window)
    throw LoadError(path + ": its values are 8-bit greys (" + std::to_string(min) + " to " + std::to_string(max) +
                    "), not Hounsfield; import it with the HU of 0 and 255, for example --window=-1000:3000");
  if (!window) return;
  if (!is_8_bit)
    throw LoadError(path + ": its values go from " + std::to_string(min) + " to " + std::to_string(max) +
                    ", a window is for 8-bit greys (0 to 255); leave --window out");
  for (std::int16_t& value : values)
    value =
        static_cast<std::int16_t>(std::lround(window->low_hu + (window->high_hu - window->low_hu) * value / kMaxGrey));
}

}  // namespace assets
