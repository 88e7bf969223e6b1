// The doctor's checks, a source each: what is looked at (look…) apart from what is said of it, so that every answer can
// be had on any machine. Those that measure or ask a driver say how long they take; the others read a few files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/doctor/finding.h"
#include "app/doctor/machine.h"
#include "haptics/device/thread_priority.h"

namespace app {

/// What draws. Some ten ms, without a window.
struct GraphicsFacts {
  std::string version, card;
  bool is_software = false;
};
std::optional<GraphicsFacts> probeGraphics();
Finding checkGraphics(const std::optional<GraphicsFacts>& facts);

/// What can be seen on. Opens an invisible window.
struct ScreenFacts {
  struct Screen {
    std::string name;
    int width_px = 0, height_px = 0;
    double refresh_Hz = 0.0;
  };
  std::vector<Screen> screens;  ///< none: no display
  bool has_quad_buffer = false;
};
ScreenFacts probeScreens();
Finding checkScreens(const ScreenFacts& facts);
Finding checkStereo(const ScreenFacts& facts);

Finding checkSound(const Machine& machine);
Finding checkPedal(const Machine& machine);
Finding checkPermissions(const Machine& machine);
Finding checkModemManager(const Machine& machine);

/// Why OpenHaptics can not be used, empty when it can.
Finding checkVendorLibrary(const Machine& machine, const std::string& why_unavailable);

/// `resolution_ns` of the clock the servo sleeps by.
double clockResolution_ns();
Finding checkClock(const Machine& machine, double resolution_ns);

/// How late a thread of the servo's kind wakes, 500 times a millisecond: half a second.
struct WakeUps {
  double median_us = 0.0, p99_us = 0.0, worst_us = 0.0;
};
WakeUps measureWakeUps(int servo_priority = haptics::kServoPriority);
Finding checkWakeUps(const WakeUps& measured);

/// Both prescribe all that a servo of this priority needs: their lines go into one file.
Finding checkPriorityLimit(const Machine& machine, int servo_priority = haptics::kServoPriority);
Finding checkMemoryLimit(const Machine& machine, int servo_priority = haptics::kServoPriority);
Finding checkProcessors(const Machine& machine);

/// Where recordings go: writes 16 MB and takes them away again.
struct DiskFacts {
  double free_MB = 0.0, written_MB_per_s = 0.0;
  bool is_writable = false;
};
DiskFacts probeDisk(const std::filesystem::path& folder);
Finding checkDisk(const std::filesystem::path& folder, const DiskFacts& facts);

/// All of it, in the order it is shown.
std::vector<Finding> examine(const Machine& machine, int servo_priority);

}  // namespace app
