// How much of the guides that are seen through everything is shown. Any thread; pure.
#pragma once

#include "render/frame.h"

namespace render {

/// The canal through what covers it.
inline constexpr float kMandibularCanalThrough = 0.45f;

/// The tool at the hand: comes up as the hand leaves the tool that the bone holds, from 0.1 to 0.5 mm.
inline float ghostOpacity(const Frame& frame) {
  constexpr double kMost = 0.4, kFrom_mm = 0.1, kFull_mm = 0.5;
  if (!frame.tool_visible || !frame.layers.ghost_tool) return 0.0f;
  const double held_mm = glm::distance(frame.X_PT_at_hand.translation_mm, frame.X_PT.translation_mm);
  return static_cast<float>(kMost * glm::clamp((held_mm - kFrom_mm) / (kFull_mm - kFrom_mm), 0.0, 1.0));
}

}  // namespace render
