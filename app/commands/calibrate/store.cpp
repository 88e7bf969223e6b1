// `molar calibrate list`, `diff`, `rollback`: what is kept, what differs, and back to the one before.

#include <cstdio>
#include <memory>

#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/record/rig_differences.h"
#include "calibration/record/rig_file.h"

namespace app {
namespace {

using namespace calibration;

struct StoreOptions {
  std::string store, before, after;
  std::optional<std::string> rig_id, serial, mount;

  RigStore rigs() const { return storeAt(store); }
};

std::string textOf(const RigLocation& location) {
  return location.rig_id + " / " + location.serial + " / " + location.mount;
}

/// The only location that fits the options.
RigLocation chosenLocation(const StoreOptions& options) {
  std::vector<RigLocation> fits;
  for (const RigLocation& location : options.rigs().locations())
    if (options.rig_id.value_or(location.rig_id) == location.rig_id &&
        options.serial.value_or(location.serial) == location.serial &&
        options.mount.value_or(location.mount) == location.mount)
      fits.push_back(location);
  if (fits.empty()) throw UsageError("calibrate: the store has no such rig, see molar calibrate list");
  if (fits.size() > 1)
    throw UsageError("calibrate: several rigs are meant (" + textOf(fits[0]) + ", " + textOf(fits[1]) +
                     "), say which with --rig-id, --serial, --mount");
  return fits.front();
}

/// A damaged pointer is reported; the records stay listed.
std::optional<std::string> currentOrReport(const RigStore& rigs, const RigLocation& location) {
  try {
    return rigs.currentName(location);
  } catch (const CalibrationError& error) {
    std::fprintf(stderr, "molar: %s\n", error.what());
    return std::nullopt;
  }
}

int list(const StoreOptions& options) {
  const RigStore rigs = options.rigs();
  for (const RigLocation& location : rigs.locations()) {
    std::printf("%s\n", textOf(location).c_str());
    const auto current = currentOrReport(rigs, location);
    for (const std::string& name : rigs.names(location)) {
      std::string line;
      try {
        line = recordLine(readRigRecord(rigs.pathOf(location, name).string()));
      } catch (const CalibrationError& error) {
        line = std::string("cannot be read: ") + error.what();
      }
      std::printf("  %s %s  %s\n", current == name ? "*" : " ", name.c_str(), line.c_str());
    }
  }
  if (rigs.locations().empty())
    std::fputs(
        "molar: nothing is kept yet: the first is made by molar calibrate collect --device openhaptics --keep, "
        "without hardware with --device practice:D\n",
        stderr);
  return 0;
}

int diff(const StoreOptions& options) {
  const auto lines = differences(baseRig(options.before), baseRig(options.after));
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  if (lines.empty()) std::fputs("molar: the two rigs are the same\n", stderr);
  return 0;
}

int rollBack(const StoreOptions& options) {
  const RigLocation location = chosenLocation(options);
  const std::string name = options.rigs().rollBack(location);
  std::fprintf(stderr, "molar: %s is in force again for %s\n", name.c_str(), textOf(location).c_str());
  return 0;
}

void addPlace(CommandLine& command, StoreOptions& options) {
  command.option("--rig-id", options.rig_id, "Name of the workstation");
  command.option("--serial", options.serial, "Serial of the device");
  command.option("--mount", options.mount, "right or left");
}

}  // namespace

void addCalibrateStore(CommandLine& calibrate) {
  auto o = std::make_shared<StoreOptions>();
  CommandLine& listing = calibrate.command("list", "Rigs that are kept; * is in force");
  addStore(listing, o->store);
  listing.does([o] { return list(*o); });

  CommandLine& compare = calibrate.command("diff", "What differs between two rigs, with units");
  compare.option("BEFORE", o->before, kBaseRigHelp).required();
  compare.option("AFTER", o->after, "The other").required();
  compare.does([o] { return diff(*o); });

  CommandLine& back = calibrate.command("rollback", "The rig before comes into force again");
  addStore(back, o->store);
  addPlace(back, *o);
  back.does([o] { return rollBack(*o); });
}

}  // namespace app
