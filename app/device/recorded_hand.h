// The hand of a recorded session as a device: X_DH is its X_PT, so the frame of the device is the patient's. Start-up
// only; reads the whole file.
#pragma once

#include <memory>
#include <string>

#include "haptics/device/simulated/replayed_hand.h"

namespace app {

/// Throws SessionError for what is no readable session, haptics::DeviceError for one without a movement.
std::unique_ptr<haptics::ReplayedHand> recordedHand(const std::string& session_path);

}  // namespace app
