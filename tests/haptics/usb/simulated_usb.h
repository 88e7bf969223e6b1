// A USB bus in this process: the real libusb talks to a device model in C++ through umockdev, without kernel USB. The
// model answers when the host's transfers reach it, on umockdev's thread, with the bus locked. Tests switch faults on.
// Needs umockdev-wrapper (the preloaded half); without it available() is false. One bus at a time. It tests protocol,
// states and safety; its timing (0.5 ms a round trip) is not that of a real bus.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace simulated_usb {

using Bytes = std::vector<std::uint8_t>;

struct Setup {
  std::uint8_t type = 0, request = 0;
  std::uint16_t value = 0, index = 0;
};

/// The model of a device. Times are seconds since the bus was made.
class Device {
 public:
  virtual ~Device() = default;
  virtual void onOut(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, double t_s) = 0;
  /// Data of an IN transfer now; none: NAK, repeated soon.
  virtual std::optional<Bytes> onIn(std::uint8_t endpoint, double t_s) = 0;
  /// Called repeatedly while a host waits.
  virtual void onTime(double) {}
  /// Data of an IN request (empty for OUT); none: STALL.
  virtual std::optional<Bytes> onControl(const Setup&, std::span<const std::uint8_t>, double) { return {}; }
};

struct Endpoint {
  std::uint8_t address = 0x81;
  std::uint8_t type = 3;  ///< as in bmAttributes: 2 bulk, 3 interrupt
  std::uint16_t packet_bytes = 64;
};

struct Description {
  std::uint16_t vendor = 0, product = 0;
  std::uint8_t device_class = 0, interface_class = 3;
  std::vector<Endpoint> endpoints = {{0x81, 3, 64}, {0x01, 3, 64}};
  std::string maker, name, serial;
  std::string port = "1";  ///< on bus 1: its path is "1-<port>"
  int number = 2;          ///< unique on the bus
};

/// Faults of the line, until changed.
struct Faults {
  bool in_silent = false;                      ///< IN is always NAKed
  bool out_refused = false;                    ///< OUT is NAKed
  bool in_halted = false, out_halted = false;  ///< STALL; a clear-halt ends it unless `halts_stay`
  bool halts_stay = false;
  bool claim_refused = false;    ///< EBUSY
  bool handle_dead = false;      ///< every request ENOTTY
  bool errors = false;           ///< every transfer fails with EPROTO
  bool stuck = false;            ///< no transfer ever completes, cancelled or not
  bool detach_unserved = false;  ///< ENOTTY for detaching a driver
};

class Bus {
 public:
  static bool available();

  Bus();
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Plugs it in; `device` must outlive the bus.
  void plug(const Description& description, Device& device);
  /// Unplugs it; its open handles fail as the kernel's do.
  void unplug(const std::string& port = "1");

  void set(const Faults& faults, const std::string& port = "1");
  /// Stops the models' time, or lets it continue.
  void holdTime();
  void letTimePass();

  /// Runs a function of the test with the models locked.
  void locked(const std::function<void()>& look);

  int halts_cleared() const;
  int cancelled() const;
  /// How often a host has reaped transfers.
  int looks() const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace simulated_usb
