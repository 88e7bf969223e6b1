// The vendor's HDAPI library, found and loaded while the program runs; nothing of it is needed to build. Loaded at most
// once in a process and never unloaded, for its driver fails the second time (reference/devices 2). Looked for by the
// path given, else by MOLAR_OPENHAPTICS (either a file or its folder, and then nowhere else), else as libHD.so.3.5,
// .3.4, .3.0 and libHD.so where the system's linker looks and in $OH_SDK_BASE/lib/lin-x86_64. Any thread but the
// servo's. Knows no device.
#pragma once

#include <string>

#include "haptics/device/openhaptics/hd_abi.h"

namespace haptics {

/// Every function that Molar calls. All of one device are for one thread: the scheduler's while it runs, else its
/// owner's.
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

  /// Why it can not be used, with the next step, in one line; empty when it can. Loads it.
  static std::string whyUnavailable(const std::string& path = {});

  const HdFunctions& functions() const { return functions_; }
  /// The file that was loaded.
  const std::string& path() const { return path_; }

  /// The vendor's scheduler is one for the whole process: false when somebody has it already.
  static bool claimScheduler();
  static void releaseScheduler();

 private:
  std::string path_;
  HdFunctions functions_{};
};

/// What the system's linker said of a file that it could not load, in plain words with the next step.
std::string loadFailureText(const std::string& file, const std::string& linker_text);

}  // namespace haptics
