// Waiting at the bench for what a device does by itself: to be armed, to push as asked, to have let go. Looks a hundred
// times a second of the device's time, gives up after ten seconds. Main thread.
#pragma once

#include "app/device/check/check_steps.h"

namespace app {

/// Pushes and waits until what is let through is what was asked for, or all that the device gives.
bool pushUntilSteady(CheckBench& bench, const glm::dvec3& force_D_N);
void letGo(CheckBench& bench);

/// The state once the handle has come to rest, three seconds later at most.
ConstantForceLoop::Seen lookAtRest(CheckBench& bench);

/// "+0.50, 0.00, 0.00 N"
std::string newtons(const glm::dvec3& force_N);

}  // namespace app
