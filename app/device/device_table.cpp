#include "app/device/device_table.h"

#include <fmt/core.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/text/wrapped_text.h"

namespace app {
namespace {

using haptics::DeviceCatalogue;
using haptics::DeviceKind;
using haptics::FoundDevice;

const char* nameOf(haptics::Provenance provenance) {
  constexpr const char* kNames[] = {"simulated", "replay", "public-protocol", "vendor-library"};
  return kNames[static_cast<int>(provenance)];
}

const char* nameOf(haptics::DeviceTrouble trouble) {
  constexpr const char* kNames[] = {"not-there", "no-rights", "no-driver", "busy",
                                    "not-ready", "faulty",    "no-means",  "bad-setting"};
  return kNames[static_cast<int>(trouble)];
}

bool isReal(const FoundDevice& device) { return device.provenance != haptics::Provenance::simulated; }

std::string bold(const std::string& text, const TerminalFormat& look) {
  return look.coloured ? "\033[1m" + text + "\033[0m" : text;
}

std::string here(const DeviceCatalogue& catalogue, const TerminalFormat& look) {
  std::size_t longest = 0;
  for (const FoundDevice& one : catalogue.devices) longest = std::max(longest, one.address.size());
  const std::size_t indent = 2 + longest + 2;
  std::string text;
  for (const FoundDevice& one : catalogue.devices) {
    text += fmt::format("  {:{}}  ", one.address, longest);
    text += wrappedText(one.name + ", " + one.location + ", by " + one.driver, indent, look.width) + "\n";
    if (!one.advice.empty())
      text += std::string(indent, ' ') + "→ " + wrappedText(one.advice, indent + 2, look.width) + "\n";
  }
  if (std::ranges::none_of(catalogue.devices, isReal)) text += "  No device with motors, no pedal.\n";
  for (const haptics::DeviceError& trouble : catalogue.troubles)
    text += "  " + wrappedText(trouble.what(), 2, look.width) + "\n";
  return text;
}

std::string kinds(const TerminalFormat& look) {
  std::size_t longest = 0;
  for (const DeviceKind& kind : haptics::deviceKinds()) longest = std::max(longest, kind.key.size());
  const std::size_t indent = 2 + longest + 2;
  std::string text;
  for (const DeviceKind& kind : haptics::deviceKinds()) {
    std::string said = std::string(kind.name) + ", by " + std::string(kind.driver) + ". ";
    said += kind.isHardware() ? "Tested with " + std::string(kind.proof) + ", " +
                                    (kind.ran_on_a_unit ? "and on a real unit." : "never on a real unit.")
                              : "No hardware.";
    text += fmt::format("  {:{}}  ", kind.key, longest);
    text += wrappedText(said, indent, look.width) + "\n";
  }
  return text;
}

}  // namespace

std::string asText(const DeviceCatalogue& catalogue, const TerminalFormat& look) {
  std::string text = bold("Here now", look) + ", and the address that --device takes\n" + here(catalogue, look);
  text += "\n" + bold("What Molar drives", look) + "\n" + kinds(look);
  const bool untested = std::ranges::any_of(
      haptics::deviceKinds(), [](const DeviceKind& kind) { return kind.isHardware() && !kind.ran_on_a_unit; });
  if (untested)
    text += "\n" +
            wrappedText(
                "Whoever owns a unit can test it in ten minutes with a kitchen balance: molar devices "
                "check ADDRESS writes a report.",
                0, look.width) +
            "\n";
  return text;
}

std::string asJson(const DeviceCatalogue& catalogue) {
  using nlohmann::ordered_json;
  ordered_json devices = ordered_json::array(), all_kinds = ordered_json::array(), troubles = ordered_json::array();
  for (const FoundDevice& one : catalogue.devices)
    devices.push_back({{"name", one.name},
                       {"address", one.address},
                       {"place", one.location},
                       {"provenance", nameOf(one.provenance)},
                       {"driver", one.driver},
                       {"next_step", one.advice}});
  for (const DeviceKind& kind : haptics::deviceKinds())
    all_kinds.push_back({{"key", kind.key},
                         {"name", kind.name},
                         {"driver", kind.driver},
                         {"proved_against", kind.proof},
                         {"is_hardware", kind.isHardware()},
                         {"ran_on_a_real_unit", kind.ran_on_a_unit}});
  for (const haptics::DeviceError& one : catalogue.troubles)
    troubles.push_back({{"kind", nameOf(one.trouble)}, {"line", one.what()}});
  const ordered_json all = {{"devices", devices}, {"kinds", all_kinds}, {"troubles", troubles}};
  return all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
