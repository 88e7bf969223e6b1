// Linear light and its sRGB code, IEC 61966-2-1. Any thread; pure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace render {

/// 0..1 of both.
inline double lightOfSrgb(double code) { return code > 0.04045 ? std::pow((code + 0.055) / 1.055, 2.4) : code / 12.92; }
inline double srgbOfLight(double light) {
  return light > 0.0031308 ? 1.055 * std::pow(light, 1.0 / 2.4) - 0.055 : 12.92 * std::max(light, 0.0);
}

/// Light of each byte.
inline std::array<float, 256> lightOfBytes() {
  std::array<float, 256> light;
  for (std::size_t n = 0; n < light.size(); ++n)
    light[n] = static_cast<float>(lightOfSrgb(static_cast<double>(n) / 255.0));
  return light;
}

}  // namespace render
