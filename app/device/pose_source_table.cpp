#include "app/device/pose_source_table.h"

#include <algorithm>
#include <array>

#include "app/device/practice_device.h"
#include "app/text/usage_error.h"
#include "haptics/device/device_catalogue.h"
#include "haptics/device/simulated/phantom_mechanics.h"

namespace app {
namespace {

bool isNothing(const std::string& rest) { return rest.empty(); }
bool isScript(const std::string& rest) { return rest.empty() || rest == kThirdMolarScript || rest == kFlapScript; }
bool isSomething(const std::string& rest) { return !rest.empty(); }
bool isModel(const std::string& rest) { return rest.empty() || haptics::findSimulatedPhantom(rest) != nullptr; }
bool isPractice(const std::string& rest) {
  return practiceRig(rest.empty() ? "practice" : "practice:" + rest).has_value();
}

constexpr std::array<PoseSourceKind, 6> kSources = {{
    {"mouse", "", false, false, false, isNothing, openMouse},
    {"scripted", "", true, false, true, isScript, openScript},
    {"simulated", "[:omni|touch|desktop|premium], the script with a simulated Phantom", true, false, true, isModel,
     openSimulated},
    {"practice", ":SCENARIO[:SEED], the same with an Omni that has the errors of a real one, A to G", true, false, true,
     isPractice, openPractice},
    {"replay", ":SESSION, a recorded session", true, true, false, isSomething, openReplay},
    {"poses", ":FILE, the poses of a CSV file exactly, with its tools and actions", true, false, false, isSomething,
     openPoses},
}};

}  // namespace

std::span<const PoseSourceKind> poseSourceKinds() { return kSources; }

const PoseSourceKind* poseSourceKindOf(const std::string& address) {
  const auto kind = std::ranges::find(kSources, address.substr(0, address.find(':')), &PoseSourceKind::scheme);
  if (kind == kSources.end() || address.ends_with(':')) return nullptr;
  return kind->accepts(haptics::addressRest(address)) ? &*kind : nullptr;
}

void refuseUnlessPoseSource(const std::string& address) {
  if (!poseSourceKindOf(address) && !haptics::isDeviceAddress(address))
    throw UsageError("--device " + address + ": there is no such device, see molar rehearse --help and molar devices");
}

std::string poseSourceHelp() {
  std::string help = "Device or simulation: ";
  for (const PoseSourceKind& kind : kSources) help += std::string(kind.scheme) + std::string(kind.help) + "; ";
  for (const haptics::DeviceKind& kind : haptics::deviceKinds())
    if (kind.open) help += std::string(kind.key) + std::string(kind.suffix) + ", ";
  return help + "usb: see molar devices";
}

}  // namespace app
