#include "app/doctor/checks.h"
#include "haptics/device/openhaptics/hd_library.h"

namespace app {

std::vector<Finding> examine(const Machine& machine, int servo_priority) {
  // Punctuality first, while nothing of ours works in the background.
  const Finding wake_up = checkWakeUps(measureWakeUps(servo_priority));
  const ScreenFacts screens = probeScreens();
  return {
      checkGraphics(probeGraphics()),
      checkScreens(screens),
      checkStereo(screens),
      checkSound(machine),
      checkPedal(machine),
      checkPermissions(machine),
      checkModemManager(machine),
      checkVendorLibrary(machine, haptics::HdLibrary::whyUnavailable()),
      checkClock(machine, clockResolution_ns()),
      wake_up,
      checkPriorityLimit(machine, servo_priority),
      checkMemoryLimit(machine, servo_priority),
      checkProcessors(machine),
      checkDisk(machine.sessions, probeDisk(machine.sessions)),
  };
}

}  // namespace app
