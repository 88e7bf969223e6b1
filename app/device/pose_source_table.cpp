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
bool isSomething(const std::string& rest) { return !rest.empty(); }
bool isModel(const std::string& rest) { return rest.empty() || haptics::findSimulatedPhantom(rest) != nullptr; }
bool isPractice(const std::string& rest) {
  return practiceRig(rest.empty() ? "practice" : "practice:" + rest).has_value();
}

constexpr std::array<PoseSourceKind, 6> kHands = {{
    {"mouse", "", false, false, false, isNothing, openMouse},
    {"scripted", "", true, false, true, isNothing, openScript},
    {"simulated", "[:omni|touch|desktop|premium], the script holding a Phantom in numbers", true, false, true, isModel,
     openSimulated},
    {"practice", ":SCENARIO[:SEED], the same with an Omni as untrue as real ones, A to G", true, false, true,
     isPractice, openPractice},
    {"replay", ":SESSION, a recorded hand", true, true, false, isSomething, openReplay},
    {"poses", ":FILE, a hand exactly where a pose CSV has it, that asks for its tools and actions", true, false, false,
     isSomething, openPoses},
}};

}  // namespace

std::span<const PoseSourceKind> poseSourceKinds() { return kHands; }

std::string restOf(const std::string& address) {
  const std::size_t colon = address.find(':');
  return colon == std::string::npos ? std::string() : address.substr(colon + 1);
}

const PoseSourceKind* poseSourceKindOf(const std::string& address) {
  const auto kind = std::ranges::find(kHands, address.substr(0, address.find(':')), &PoseSourceKind::scheme);
  if (kind == kHands.end() || address.ends_with(':')) return nullptr;
  return kind->takes(restOf(address)) ? &*kind : nullptr;
}

void refuseUnlessPoseSource(const std::string& address) {
  if (!poseSourceKindOf(address) && !haptics::isDeviceAddress(address))
    throw UsageError("--device " + address + ": there is no such hand, see molar rehearse --help and molar devices");
}

std::string poseSourceHelp() {
  std::string help = "Hand: ";
  for (const PoseSourceKind& kind : kHands) help += std::string(kind.scheme) + std::string(kind.help) + "; ";
  for (const haptics::DeviceKind& kind : haptics::deviceKinds())
    if (kind.open) help += std::string(kind.key) + std::string(kind.place) + ", ";
  return help + "usb: see molar devices";
}

}  // namespace app
