// The table of instruments of the second hand: option values, names in messages and meshes come from it. Meshes in
// their own frame, mm (dental_mirror.h, retractor.h). Any thread.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "assets/instrument/dental_mirror.h"
#include "assets/instrument/retractor.h"

namespace assets {

enum class SecondInstrument { mirror, retractor };

struct SecondInstrumentEntry {
  SecondInstrument instrument;
  std::string_view name;
  MeshModel (*model)();
};

inline constexpr std::array<SecondInstrumentEntry, 2> kSecondInstruments{
    {{SecondInstrument::mirror, "mirror", dentalMirror}, {SecondInstrument::retractor, "retractor", retractor}}};

constexpr const SecondInstrumentEntry& entryOf(SecondInstrument instrument) {
  return kSecondInstruments[static_cast<std::size_t>(instrument)];
}

inline std::vector<std::string> secondInstrumentNames() {
  std::vector<std::string> names;
  for (const SecondInstrumentEntry& entry : kSecondInstruments) names.emplace_back(entry.name);
  return names;
}

}  // namespace assets
