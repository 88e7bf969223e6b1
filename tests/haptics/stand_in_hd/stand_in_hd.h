// Control of the stand-in for the vendor's library: its script, and what it recorded. Found by dlsym("standIn"). Values
// may be changed while it runs; texts are read after it has stopped. mm, N, ms.
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <vector>

namespace stand_in {

/// The script. Ticks are counted from the start of the scheduler.
struct Script {
  std::atomic<const char*> model{"PHANTOM Omni"};
  std::atomic<unsigned> init_error{0};    ///< error code of the initialisation
  std::atomic<int> calibration_style{2};  ///< bits
  std::atomic<bool> calibrated{true};
  std::atomic<bool> docked{false}, docked_value{true};
  std::atomic<bool> held{true};
  std::atomic<int> buttons{0}, input_dof{6}, update_rate_Hz{1000};
  std::atomic<double> max_force_N{3.3}, heat{0.1};
  std::array<std::atomic<double>, 3> hand_mm{0.0, -65.5, -88.1};  ///< target of the hand, approached at 0.3 mm a tick
  std::array<std::atomic<double>, 16> turn{};                     ///< rotation of the transform
  std::array<std::atomic<double>, 3> joints_rad{}, gimbal_rad{};
  std::array<std::atomic<unsigned>, 4> unknown_properties{};  ///< answered with an error
  std::atomic<bool> garbage{false};                           ///< positions are NaN

  std::atomic<unsigned> error_code{0};  ///< raised in the next frame, `error_times`, then cleared
  std::atomic<int> error_times{1};
  std::atomic<bool> unplugged{false};  ///< every frame ends in 0x0302
  std::atomic<unsigned> refused_rate_Hz{0};
  std::atomic<unsigned> schedule_error{0};
  std::atomic<long> slow_at_tick{-1};
  std::atomic<int> slow_ms{0};
  std::atomic<bool> hangs{false};  ///< the scheduler does not call
};

/// The record.
struct Seen {
  std::atomic<long> ticks{0}, frames{0}, calibration_updates{0};
  std::atomic<bool> motors_on{false}, hanging{false};
  std::array<std::atomic<double>, 3> force_N{};      ///< of the last frame
  std::array<std::atomic<double>, 3> strongest_N{};  ///< of all frames, by length
  std::array<std::atomic<double>, 3> position_mm{};
  std::vector<std::string> events;      ///< calls in their order; frames only where the force begins and ends
  std::vector<std::string> violations;  ///< of the rules of the interface
};

struct StandIn {
  Script script;
  Seen seen;
  void (*reset)();  ///< to the initial state; only while nothing runs
  int (*open_devices)();
};

}  // namespace stand_in
