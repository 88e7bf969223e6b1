#include "haptics/device/openhaptics/find_open_haptics.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "haptics/device/openhaptics/hd_library.h"

namespace haptics {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultName = "Default Device";
constexpr std::size_t kMostLines = 1000;

std::vector<fs::path> homes() {
  if (const char* home = std::getenv("GTDD_HOME"); home && *home) return {home};
  std::vector<fs::path> places;
  if (const char* home = std::getenv("HOME"); home && *home) places.push_back(fs::path(home) / ".3dsystems");
  places.push_back("/usr/share/3DSystems");
  return places;
}

/// Of the first home that has any.
std::vector<fs::path> configurationFiles() {
  for (const fs::path& home : homes()) {
    std::vector<fs::path> files;
    std::error_code trouble;
    for (fs::directory_iterator entry(home / "config", trouble), end; !trouble && entry != end;
         entry.increment(trouble))
      if (entry->path().extension() == ".config") files.push_back(entry->path());
    std::ranges::sort(files);
    if (!files.empty()) return files;
  }
  return {};
}

/// The number N of "Channel=N", the serial port the device hangs on.
std::optional<int> channelIn(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  for (std::size_t i = 0; i < kMostLines && std::getline(in, line); ++i) {
    std::erase_if(line, [](unsigned char c) { return c <= ' '; });
    constexpr std::string_view kKey = "Channel=";
    if (!line.starts_with(kKey) || line.size() > kKey.size() + 3) continue;
    const std::string digits = line.substr(kKey.size());
    const bool is_number = !digits.empty() && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
    if (is_number) return std::stoi(digits);
  }
  return std::nullopt;
}

FoundDevice configured(const fs::path& file) {
  FoundDevice found;
  const std::string name = file.stem().string();
  found.name = "Phantom or Touch \"" + name + "\"";
  found.address = name == kDefaultName ? "openhaptics" : "openhaptics:" + name;
  found.location = "OpenHaptics, " + file.string();
  if (const auto channel = channelIn(file)) found.location += ", channel " + std::to_string(*channel);
  return found;
}

}  // namespace

std::vector<FoundDevice> findOpenHaptics(const std::string& library) {
  std::vector<FoundDevice> found;
  for (const fs::path& file : configurationFiles()) found.push_back(configured(file));

  std::string driver = "OpenHaptics by 3D Systems", why_not;
  try {
    driver += ", " + HdLibrary(library).path();
    const auto is_default = [](const FoundDevice& device) { return device.address == "openhaptics"; };
    if (std::ranges::none_of(found, is_default)) {
      FoundDevice unnamed;
      unnamed.name = "Phantom or Touch, default device";
      unnamed.address = "openhaptics";
      unnamed.location = "OpenHaptics, no configuration of that name found";
      unnamed.advice = "If one is plugged in, run Touch_Setup once, the program that came with its driver.";
      found.insert(found.begin(), unnamed);
    }
  } catch (const DeviceError& error) {
    why_not = error.what();
  }
  for (FoundDevice& device : found) {
    device.provenance = Provenance::vendor_library;
    device.driver = driver;
    if (why_not.empty()) continue;
    device.address.clear();
    device.advice = why_not;
  }
  return found;
}

}  // namespace haptics
