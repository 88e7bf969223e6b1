// The vendor's HDAPI library, found and loaded at run time; the build needs nothing of it. Loaded at most once in a
// process and never unloaded, because its driver fails the second time (reference/devices 2). Searched for: the path
// given, else MOLAR_OPENHAPTICS (a file or its folder, and then nowhere else), else libHD.so.3.5, .3.4, .3.0 and
// libHD.so on the linker's path and in $OH_SDK_BASE/lib/lin-x86_64. Any thread but the servo's. No device.
#pragma once

#include <string>

#include "haptics/device/openhaptics/hd_abi.h"

namespace haptics {

/// The functions that Molar calls: on the scheduler's thread while it runs, else on the owner's.
struct HdFunctions {
  hd::DeviceId (*init_device)(const char* configuration);
  void (*disable_device)(hd::DeviceId);
  void (*make_current_device)(hd::DeviceId);
  void (*begin_frame)(hd::DeviceId);
  void (*end_frame)(hd::DeviceId);
  void (*enable)(hd::Enum);
  void (*disable)(hd::Enum);
  void (*get_booleanv)(hd::Enum, hd::Boolean*);
  void (*get_integerv)(hd::Enum, int*);
  void (*get_doublev)(hd::Enum, double*);
  const char* (*get_string)(hd::Enum);
  void (*set_doublev)(hd::Enum, const double*);
  hd::ErrorInfo (*get_error)();
  hd::Enum (*check_calibration)();
  void (*update_calibration)(hd::Enum style);
  void (*set_scheduler_rate)(unsigned long rate_Hz);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  hd::ScheduleId (*schedule_asynchronous)(hd::Callback, void* data, unsigned short priority);
  void (*unschedule)(hd::ScheduleId);
};

class HdLibrary {
 public:
  /// Throws DeviceError: not there, another copy is loaded, a part of it is missing, functions are missing (all named).
  explicit HdLibrary(const std::string& path = {});

  /// Why it cannot be used, with the next step, in one line; empty when it can. Loads it.
  static std::string whyUnavailable(const std::string& path = {});

  const HdFunctions& functions() const { return functions_; }
  /// The file that was loaded.
  const std::string& path() const { return path_; }

  /// The process has one vendor's scheduler: false when it is in use.
  static bool claimScheduler();
  static void releaseScheduler();

 private:
  std::string path_;
  HdFunctions functions_{};
};

/// The linker's message for a file that it could not load, in plain words with the next step.
std::string loadFailureText(const std::string& file, const std::string& linker_text);

}  // namespace haptics
