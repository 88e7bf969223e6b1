#include "assets/scan/grey_window.h"

#include <algorithm>
#include <cmath>

#include "assets/load_error.h"

namespace assets {

void applyGreyWindow(std::vector<std::int16_t>& values, const std::optional<GreyWindow>& window,
                     const std::string& path) {
  constexpr int kBrightest = 255;
  const auto [least, most] = std::ranges::minmax(values);
  const bool is_8_bit = least >= 0 && most <= kBrightest;
  if (is_8_bit && !window)
    throw LoadError(path + ": its values are 8-bit greys (" + std::to_string(least) + " to " + std::to_string(most) +
                    "), no Hounsfield; import it with the HU that 0 and 255 mean, for example --window=-1000:3000");
  if (!window) return;
  if (!is_8_bit)
    throw LoadError(path + ": its values go from " + std::to_string(least) + " to " + std::to_string(most) +
                    ", a window is for 8-bit greys (0 to 255); leave --window out");
  for (std::int16_t& value : values)
    value = static_cast<std::int16_t>(
        std::lround(window->low_hu + (window->high_hu - window->low_hu) * value / kBrightest));
}

}  // namespace assets
