// The machine behind the stand-in: a mass moved by forces, in a hand on a spring; an error stack; a scheduler with its
// own thread; and the rules of the interface, each breach of which is recorded. mm, N, s.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "haptics/device/openhaptics/hd_abi.h"
#include "tests/haptics/stand_in_hd/stand_in_hd.h"

namespace stand_in {

namespace hd = haptics::hd;

class Machine {
 public:
  Machine() { reset(); }
  static Machine& only();

  StandIn& door() { return door_; }
  void reset();
  int openDevices() const { return open_ ? 1 : 0; }

  // The calls, each after `enter` has checked its time and thread.
  void enter(const char* call, bool needs_frame = false);
  void note(const std::string& event);
  void breach(const std::string& what);
  void raise(unsigned code);
  hd::ErrorInfo takeError();

  hd::DeviceId init(const char* name);
  void disableDevice(hd::DeviceId id);
  void beginFrame(hd::DeviceId id);
  void endFrame(hd::DeviceId id);
  void switchMotors(hd::Enum what, bool on);
  void setForce(const double* force_N);
  hd::Enum calibration();
  void updateCalibration(hd::Enum style);
  bool isUnknown(hd::Enum property);
  double velocity(int axis) const { return velocity_mm_per_s_[static_cast<std::size_t>(axis)]; }

  void setRate(unsigned long rate_Hz);
  hd::ScheduleId schedule(hd::Callback callback, void* data, unsigned short priority);
  void unschedule(hd::ScheduleId id);
  void startScheduler();
  void stopScheduler();

 private:
  void run();
  void move();

  StandIn door_;
  std::mutex texts_;
  bool open_ = false, in_frame_ = false, pushing_ = false;
  int frames_this_tick_ = 0;
  std::atomic<bool> running_{false};
  std::vector<unsigned> errors_;
  hd::Callback callback_ = nullptr;
  void* data_ = nullptr;
  unsigned long rate_Hz_ = 1000;
  std::array<double, 3> force_N_{}, velocity_mm_per_s_{}, hand_mm_{};
  std::thread thread_;
};

}  // namespace stand_in
