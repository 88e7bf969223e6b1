// A Novint Falcon behind the simulated bus: the FTDI bridge, a boot loader that waits for its program, then run
// packets, three motors on the real legs and a grip in a viscous hand. Written from the published facts, independently
// of the driver; scale and sign are set here. Everything under the bus's lock.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "haptics/device/usb/falcon_kinematics.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace simulated_usb {

class SimulatedFalcon : public Device {
 public:
  static Description description();

  void onOut(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, double t_s) override;
  std::optional<Bytes> onIn(std::uint8_t endpoint, double t_s) override;
  std::optional<Bytes> onControl(const Setup& setup, std::span<const std::uint8_t> data, double t_s) override;

  // Behaviour.
  std::size_t program_bytes = 2048;  ///< size at which it starts to run
  bool runs = false;                 ///< the program is loaded
  bool answers_greeting = true, answers_packets = true, garbage = false;
  int echo_mistakes = 0;  ///< loads with one wrong byte
  unsigned homed = 7;
  double true_words_per_Nmm = 10.0;  ///< the motors turn against the sign of their words
  unsigned buttons = 0;
  glm::dvec3 grip_mm{0.0, 0.0, 125.0};

  // Record.
  Bytes program;
  std::array<int, 3> words{};
  unsigned flags = 0;
  std::vector<std::string> packets;  ///< every run packet
  int largest_word = 0, refused = 0, loads_begun = 0;

 private:
  void boot(std::uint8_t byte);
  void execute(const std::string& packet, double t_s);
  void move(double t_s);
  void report();

  std::uint16_t baud_ = 0, latency_ms_ = 16;
  bool dtr_ = false, knocked_ = false;
  std::string line_;
  std::deque<std::uint8_t> said_;
  double last_status_s_ = 0.0, last_move_s_ = 0.0;
};

}  // namespace simulated_usb
