// The doctor's checks. Measuring (probe…) is separate from evaluating (check…), so that tests reach every finding. A
// check that measures or queries a driver states its duration; the others read a few files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/doctor/findings_text.h"
#include "app/doctor/machine.h"
#include "haptics/device/thread_priority.h"

namespace app {

/// OpenGL. Some ten ms, without a window.
struct GraphicsFacts {
  std::string version, card;
  bool is_software = false;
};
std::optional<GraphicsFacts> probeGraphics();
Finding checkGraphics(const std::optional<GraphicsFacts>& facts);

/// Monitors. Opens an invisible window.
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

/// `why_unavailable`: of OpenHaptics; empty when it can be used.
Finding checkVendorLibrary(const Machine& machine, const std::string& why_unavailable);

/// `resolution_ns` of the clock the servo sleeps by.
double clockResolution_ns();
Finding checkClock(const Machine& machine, double resolution_ns);

/// Wake-up latency of a thread like the servo's, 500 times at 1 kHz: half a second.
struct WakeUps {
  double median_us = 0.0, p99_us = 0.0, worst_us = 0.0;
};
WakeUps measureWakeUps(int servo_priority = haptics::kServoPriority);
Finding checkWakeUps(const WakeUps& measured);

/// Both print all lines that a servo of this priority needs, for one file.
Finding checkPriorityLimit(const Machine& machine, int servo_priority = haptics::kServoPriority);
Finding checkMemoryLimit(const Machine& machine, int servo_priority = haptics::kServoPriority);
Finding checkProcessors(const Machine& machine);

/// The folder of recordings: writes 16 MB and removes them.
struct DiskFacts {
  double free_MB = 0.0, written_MB_per_s = 0.0;
  bool is_writable = false;
};
DiskFacts probeDisk(const std::filesystem::path& folder);
Finding checkDisk(const std::filesystem::path& folder, const DiskFacts& facts);

/// All of it, in the order it is shown.
std::vector<Finding> examine(const Machine& machine, int servo_priority);

}  // namespace app
