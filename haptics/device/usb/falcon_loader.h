// Loads the Falcon's firmware after every power-up, as a state machine over bytes: next() says what the caller does,
// done(), received() and timedOut() report the result. It uses neither USB nor a clock. Greeting at 9600 baud, then 140
// kbaud, one letter, the program in pieces of at most 62 bytes that must all be echoed, then 1.5 Mbaud. One thread; no
// allocation until it fails. Source: libnifalcon/libnifalcon, FalconCommLibUSB.cpp, FalconFirmware.cpp (facts;
// reference/devices 3.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace haptics {

/// A request to the FTDI bridge: bmRequestType 0x40, wIndex 0, no data.
struct FtdiRequest {
  std::uint8_t request = 0;
  std::uint16_t value = 0;
};

class FalconLoader {
 public:
  enum class Action { request, send, listen, done, failed };

  /// `program` must outlive the loader.
  explicit FalconLoader(std::span<const std::uint8_t> program, int greetings = 100)
      : program_(program), greetings_left_(greetings) {}

  Action next() const;
  FtdiRequest request() const;                 ///< for Action::request
  std::span<const std::uint8_t> send() const;  ///< for Action::send
  int timeout_ms() const;                      ///< for Action::listen

  void done();                                             ///< the request was accepted, the bytes were sent
  void received(std::span<const std::uint8_t> payload);    ///< without modem bytes
  void timedOut();                                         ///< nothing more came within timeout_ms()
  const std::string& trouble() const { return trouble_; }  ///< why it failed

 private:
  enum class Stage {
    prepare,
    greet,
    await_greeting,
    speed_up,
    probe,
    await_probe,
    stream,
    await_echo,
    run,
    over,
    broken
  };

  std::span<const FtdiRequest> requests() const;
  std::span<const std::uint8_t> piece() const;
  void take(std::uint8_t byte);
  void fail(std::string trouble);

  std::span<const std::uint8_t> program_;
  int greetings_left_;
  Stage stage_ = Stage::prepare;
  std::size_t step_ = 0;     ///< within the requests of a stage
  std::size_t matched_ = 0;  ///< of the greeting's answer
  bool answer_wrong_ = false;
  std::size_t sent_ = 0, echoed_ = 0;
  std::string trouble_;
};

/// Set the bridge to the speed of run packets, for a Falcon whose program runs.
std::span<const FtdiRequest> falconRunRequests();

}  // namespace haptics
