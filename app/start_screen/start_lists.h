// What can be chosen on the start screen, from where the program itself has it: the table of cases, the devices that
// are plugged in, the calibrations in force, the positions of the patient and the recorded sessions. Pure, but for
// startListsHere(), which searches devices and reads folders: some tenths of a second, main thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/session/session_list.h"
#include "app/start_screen/start_menu.h"
#include "calibration/record/rig_store.h"
#include "haptics/device/found_device.h"

namespace app {

/// `devices` as found; `calibrations` with one in force; `sessions` newest first, of which the newest readable ones are
/// offered.
StartLists startLists(std::span<const haptics::FoundDevice> devices,
                      std::span<const calibration::RigLocation> calibrations, std::span<const SessionListing> sessions);

/// Of this machine and user. A search that fails leaves its part out.
StartLists startListsHere();

inline constexpr std::size_t kSessionsOffered = 12;

}  // namespace app
