// The pose sources without hardware, one table line each: address, help, properties, how it is opened. Real devices
// have theirs in haptics/device/device_catalogue. A new source is a file, its function in pose_sources.h and a line
// here. Plain data; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/device/pose_sources.h"

namespace app {

struct PoseSourceKind {
  std::string_view scheme;                   ///< of its address, up to the colon
  std::string_view help;                     ///< how the address continues, and what it is
  bool simulated;                            ///< moves by itself: needs no window, and can be stepped without a clock
  bool holds_any_tool;                       ///< also as the second hand
  bool follows_plan;                         ///< cuts the planned cut
  bool (*accepts)(const std::string& rest);  ///< the rest of an address; may throw UsageError to say more
  PoseSource (*open)(const std::string& rest, const PoseSourceContext& at);
};

std::span<const PoseSourceKind> poseSourceKinds();
/// Null for any other address, also a real device's. Throws UsageError where the scheme is right and the rest is wrong.
const PoseSourceKind* poseSourceKindOf(const std::string& address);
/// Throws UsageError for what is neither a pose source nor the address of a device.
void refuseUnlessPoseSource(const std::string& address);

/// Help text of `--device`: every pose source and every device.
std::string poseSourceHelp();

}  // namespace app
