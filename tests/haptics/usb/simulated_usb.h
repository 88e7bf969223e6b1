// A USB bus in this process: the real libusb talks to a device model in C++ through umockdev, without kernel USB. The
// model answers packets when the host's transfers reach it, on umockdev's thread; the rig's lock is held then. Faults
// are switched on from the test. Needs umockdev-wrapper (the preloaded half); without it available() is false.
// One bus at a time. Proves protocol, states and safety; its timing (0.5 ms a round trip) proves nothing.
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

/// What is inside the box. Times are seconds since the bus was made.
class Device {
 public:
  virtual ~Device() = default;
  virtual void onOut(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, double t_s) = 0;
  /// What it says now to a host that listens; nothing: NAK, asked again soon.
  virtual std::optional<Bytes> onIn(std::uint8_t endpoint, double t_s) = 0;
  /// Now and then, as long as a host waits for anything.
  virtual void onTime(double) {}
  /// Data of an IN request (empty for OUT); nothing: STALL.
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
  int number = 2;          ///< on the bus, unlike any other's
};

/// What the line does wrong, until told otherwise.
struct Faults {
  bool in_silent = false;                      ///< IN is NAKed whatever the device says
  bool out_refused = false;                    ///< OUT is NAKed
  bool in_halted = false, out_halted = false;  ///< STALL; a clear-halt ends it unless `halts_stay`
  bool halts_stay = false;
  bool claim_refused = false;    ///< EBUSY
  bool handle_dead = false;      ///< every request ENOTTY
  bool errors = false;           ///< every transfer fails with EPROTO
  bool stuck = false;            ///< nothing is ever given back, cancelled or not
  bool detach_unserved = false;  ///< ENOTTY for taking the interface from a driver
};

class Bus {
 public:
  static bool available();

  Bus();
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// On the bus from now on; `device` must outlive the bus.
  void plug(const Description& description, Device& device);
  /// Out of the bus, its open handles fail as the kernel's do.
  void unplug(const std::string& port = "1");

  void set(const Faults& faults, const std::string& port = "1");
  /// For the models time stands, until it goes on from there.
  void holdTime();
  void letTimePass();

  /// The test's look at a model, while nothing else touches it.
  void locked(const std::function<void()>& look);

  int halts_cleared() const;
  int cancelled() const;
  /// How often a host has asked for what came back.
  int looks() const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace simulated_usb
