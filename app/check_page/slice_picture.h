// A plane through a scan: grey values between its voxels, teeth tinted and outlined, each in the colour of its number
// (jaw_views.h). Frame P, mm. Pure but for parallel rows (TBB); any thread. Cost: 25 ns of CPU a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "app/check_page/jaw_views.h"
#include "render/image.h"

namespace app {

inline constexpr double kToothTint = 0.16;

/// The pixels of a box; `what` of every voxel. A pixel is the same whatever box it is drawn with.
void drawSlice(const assets::CtVolume& ct, const std::vector<std::uint8_t>& what, const JawViews::Plane& plane,
               const GreyRange& range, const PixelBox& box, render::Image& image);

}  // namespace app
