// The hands that need no hardware, one line each: the address, what it is, what it can serve, how it begins. Real
// devices have theirs in haptics/device/device_catalogue. A new hand is a file, its name in hands.h and a line here.
// Plain data; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/device/pose_sources.h"

namespace app {

struct PoseSourceKind {
  std::string_view scheme;                 ///< of its address, up to the colon
  std::string_view help;                   ///< how the address goes on, and what it is
  bool simulated;                          ///< it works by itself: no window, no clock of its own
  bool holds_any_tool;                     ///< as the other hand too
  bool follows_plan;                       ///< it takes the cut that is planned
  bool (*takes)(const std::string& rest);  ///< whether an address may go on so; may throw UsageError to say more
  PoseSource (*begin)(const std::string& rest, const PoseSourceContext& at);
};

std::span<const PoseSourceKind> poseSourceKinds();
/// Of this address; null for what is none, a real device too. Throws UsageError for one that goes on wrongly and says
/// how.
const PoseSourceKind* poseSourceKindOf(const std::string& address);
/// Behind the scheme and its colon.
std::string restOf(const std::string& address);

/// Throws UsageError for what is neither a hand nor the address of a device.
void refuseUnlessPoseSource(const std::string& address);
/// The line of `--device`: every hand and every device.
std::string poseSourceHelp();

}  // namespace app
