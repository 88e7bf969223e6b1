// What the apex locator told, as an event of a recording: on every change of its display, so that a replay sounds and
// says the same whatever becomes of the model. Pure; any thread.
#pragma once

#include <optional>
#include <string>

namespace app {

/// Kind of these events; the first says what the locator is: "real, seed 4711".
inline constexpr char kLocatorEvent[] = "apex locator";

struct LocatorTold {
  double left_mm = 0.0;  ///< to the foramen, in tenths
  bool is_apex = false;  ///< at the foramen, beyond it, or in a perforation
  std::string where;     ///< "distal", "perforation"
  bool operator==(const LocatorTold&) const = default;
};

/// "1.4 distal", "APEX distal", "off".
std::string locatorText(const std::optional<LocatorTold>& told);
/// None: the display is off, or the text is of something else.
std::optional<LocatorTold> locatorFrom(const std::string& text);

}  // namespace app
