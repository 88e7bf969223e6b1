#include "haptics/device/pedal/found_pedal.h"

#include <linux/input-event-codes.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace haptics {
namespace {

constexpr int kLettersOfAKeyboard = 20;

constexpr std::array<std::pair<std::uint16_t, std::uint16_t>, 6> kFootSwitches = {
    {{0x0c45, 0x7403}, {0x0c45, 0x7404}, {0x413d, 0x2107}, {0x1a86, 0xe026}, {0x3553, 0xb001}, {0x05f3, 0x00ff}}};

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool saysItIsAPedal(const InputTraits& traits) {
  const std::string name = lowerCase(traits.name);
  if (name.find("foot") != std::string::npos || name.find("pedal") != std::string::npos) return true;
  return std::ranges::count(kFootSwitches, std::pair(traits.vendor, traits.product)) > 0;
}

bool isButtonOfAJoystick(std::uint16_t code) {
  return (code >= BTN_JOYSTICK && code < BTN_DIGI) || (code >= BTN_TRIGGER_HAPPY && code <= BTN_TRIGGER_HAPPY40);
}

std::vector<FoundPedal> allOf(const InputFolders& folders) {
  std::vector<FoundPedal> all;
  for (InputTraits& traits : inputDevices(folders.classes)) {
    FoundPedal found;
    found.kind = kindOf(traits);
    found.path = folders.nodes / traits.node;
    found.may_be_read = access(found.path.c_str(), R_OK) == 0;
    found.traits = std::move(traits);
    all.push_back(std::move(found));
  }
  return all;
}

}  // namespace

InputKind kindOf(const InputTraits& traits) {
  if (traits.keys.empty() && traits.axes.empty()) return InputKind::other;
  if (traits.moves_a_pointer || traits.hasKey(BTN_TOUCH) || traits.hasKey(BTN_TOOL_PEN)) return InputKind::other;
  if (saysItIsAPedal(traits)) return InputKind::foot_switch;
  if (traits.letters() >= kLettersOfAKeyboard) return InputKind::keyboard;
  return std::ranges::any_of(traits.keys, isButtonOfAJoystick) ? InputKind::joystick : InputKind::other;
}

std::vector<FoundPedal> findPedals(const InputFolders& folders) {
  std::vector<FoundPedal> pedals = allOf(folders);
  std::erase_if(pedals, [](const FoundPedal& one) {
    return one.kind != InputKind::foot_switch && one.kind != InputKind::joystick;
  });
  std::ranges::stable_sort(pedals, {}, &FoundPedal::kind);
  return pedals;
}

std::vector<FoundPedal> pedalsMeant(const std::string& wanted, const InputFolders& folders) {
  if (wanted == "auto") return findPedals(folders);
  std::vector<FoundPedal> meant = allOf(folders);
  std::error_code none;
  const std::filesystem::path path = std::filesystem::weakly_canonical(wanted, none);
  std::erase_if(meant, [&](const FoundPedal& one) {
    if (wanted.find('/') != std::string::npos) return std::filesystem::weakly_canonical(one.path, none) != path;
    return lowerCase(one.traits.name).find(lowerCase(wanted)) == std::string::npos;
  });
  std::ranges::stable_sort(meant, {}, &FoundPedal::kind);
  return meant;
}

}  // namespace haptics
