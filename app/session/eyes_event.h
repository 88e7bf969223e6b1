// Where the surgeon's eyes were, as an event of a recording: at the start, and whenever they or the view have moved.
// Frame P, mm. Pure; any thread.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace app {

/// Kind of these events.
inline constexpr char kEyesEvent[] = "eyes";

struct EyesPlace {
  glm::dvec3 left_P_mm{0.0}, right_P_mm{0.0};
  bool in_stereo = false;
};

/// Eyes that moved less are where they were.
inline constexpr double kEyesMoved_mm = 5.0;

/// One line of JSON.
std::string eyesText(const EyesPlace& eyes);
/// None of other words, or numbers that are no place.
std::optional<EyesPlace> eyesFrom(const std::string& text);

}  // namespace app
