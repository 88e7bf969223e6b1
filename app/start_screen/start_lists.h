// What can be chosen on the start screen, from where the program itself has it: the imported patients and the table of
// cases, what is done and on which tooth, the devices that are plugged in, the calibrations in force, the positions of
// the patient, how far its mouth opens, and the sessions. Pure, but for startListsHere(), which searches devices and
// reads folders: some tenths of a second, main thread.
#pragma once

#include <string>
#include <vector>

#include "app/case/root_canals.h"
#include "app/session/session_list.h"
#include "app/start_screen/start_menu.h"
#include "app/station/patient_list.h"
#include "calibration/record/rig_store.h"
#include "haptics/device/found_device.h"

namespace app {

/// What was found on this machine.
struct StartFindings {
  std::vector<PatientListing> patients;  ///< the newest first
  std::vector<haptics::FoundDevice> devices;
  std::vector<calibration::RigLocation> calibrations;  ///< with one in force
  std::vector<SessionListing> sessions;                ///< the newest first; the newest readable ones are offered
  std::vector<CanalTooth> teeth;                       ///< of the built-in patient's right side
};

StartLists startLists(const StartFindings& found);

/// Of this machine and user. A search that fails leaves its part out.
StartLists startListsHere();

inline constexpr std::size_t kSessionsOffered = 12, kPatientsOffered = 12;

}  // namespace app
