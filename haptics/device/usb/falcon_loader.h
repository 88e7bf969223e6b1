// The conversation that brings the Falcon's program into it after every power-up, as a state machine over bytes: it
// says what to do next and is told what happened, and knows no USB and no clock. Greeting at 9600 baud, then 140 kbaud,
// one letter, the program in pieces of at most 62 bytes of which every byte must come back as it went, then 1.5 Mbaud.
// One thread; no allocation until it fails. Source: libnifalcon/libnifalcon, FalconCommLibUSB.cpp, FalconFirmware.cpp
// (facts; reference/devices 3.2). The program is Novint's: it is the user's file, never part of Molar.
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
  enum class Ask { request, send, listen, done, failed };

  /// `program` must stay while it runs.
  explicit FalconLoader(std::span<const std::uint8_t> program, int greetings = 100)
      : program_(program), greetings_left_(greetings) {}

  Ask ask() const;
  FtdiRequest request() const;                 ///< while it asks for a request
  std::span<const std::uint8_t> send() const;  ///< while it asks to send
  int patience_ms() const;                     ///< how long to listen before silence()

  void done();                                             ///< the request was taken, the bytes were sent
  void heard(std::span<const std::uint8_t> payload);       ///< without modem bytes
  void silence();                                          ///< nothing more came within the patience
  double share() const;                                    ///< of the program that has come back, 0..1
  const std::string& trouble() const { return trouble_; }  ///< what failed

 private:
  enum class Stage {
    prepare,
    greet,
    await_greeting,
    speed_up,
    knock,
    await_knock,
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
  bool answer_spoilt_ = false;
  std::size_t sent_ = 0, echoed_ = 0;
  std::string trouble_;
};

/// What brings a Falcon whose program runs to the speed of its run packets.
std::span<const FtdiRequest> falconRunRequests();

}  // namespace haptics
