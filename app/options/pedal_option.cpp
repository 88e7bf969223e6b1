#include "app/options/pedal_option.h"

#include <span>

#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "haptics/device/haptic_device.h"

namespace app {
namespace {

constexpr std::size_t kMaxBindings = 64;

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw UsageError("--pedal " + text.substr(0, 60) + ": " + reason);
}

haptics::HandAction actionNamed(const std::string& where, const std::string& name) {
  const auto action = haptics::handActionNamed(name);
  if (!action) refuse(where, "no such action, choose one of " + joined(haptics::kHandActionNames));
  return *action;
}

haptics::PedalChoice fromFile(const std::string& path) {
  assets::TomlReader keys = assets::TomlReader::fromFile(path);
  haptics::PedalChoice choice;
  choice.wanted = keys.text("", "device", "auto");
  for (const std::string& control : keys.keysOf("actions")) {
    haptics::PedalBinding binding{control, actionNamed(path, keys.text("actions", control))};
    binding.threshold = keys.number("thresholds", control, {0.15, 0.95, "of the travel"}, binding.threshold);
    choice.mapping.push_back(binding);
  }
  keys.refuseUnknownKeys();
  return choice;
}

haptics::PedalChoice fromWords(const std::string& text) {
  const std::vector<std::string_view> parts = split(text);
  haptics::PedalChoice choice;
  choice.wanted = parts.front();
  for (const std::string_view one : std::span(parts).subspan(1)) {
    const std::size_t equals = one.find('=');
    if (equals == std::string_view::npos) refuse(text, "write SWITCH=ACTION after the comma, as KEY_B=drill");
    choice.mapping.push_back(
        {std::string(one.substr(0, equals)), actionNamed(text, std::string(one.substr(equals + 1)))});
  }
  return choice;
}

}  // namespace

std::optional<haptics::PedalChoice> pedalFrom(const std::string& text) {
  if (text == "none") return {};
  haptics::PedalChoice choice = text.ends_with(".toml") ? fromFile(text) : fromWords(text);
  if (choice.wanted.empty()) refuse(text, "name a pedal, or auto, before the first comma");
  if (choice.mapping.size() > kMaxBindings) refuse(text, "no pedal has so many switches, give at most 64");
  try {
    for (const haptics::PedalBinding& binding : choice.mapping) haptics::switchOf(binding);
  } catch (const haptics::DeviceError& error) {
    refuse(text, error.what());
  }
  return choice;
}

void refuseUnlessPlugged(const haptics::PedalChoice& choice) {
  if (choice.wanted == "auto" || !haptics::pedalsMeant(choice.wanted).empty()) return;
  std::string present;
  for (const haptics::FoundPedal& pedal : haptics::findPedals())
    present += (present.empty() ? "" : ", ") + pedal.traits.name;
  refuse(choice.wanted, present.empty() ? "no pedal is plugged in, plug it in or leave --pedal out"
                                        : "no such pedal is plugged in, choose one of " + present);
}

}  // namespace app
