#include "haptics/device/usb/falcon_loader.h"

#include <algorithm>

namespace haptics {
namespace {

// The bridge's vendor requests.
constexpr std::uint8_t kPurge = 0, kModem = 1, kFlow = 2, kBaud = 3, kData = 4, kLatency = 9;
constexpr FtdiRequest kPurgeIn{kPurge, 1}, kPurgeOut{kPurge, 2};
constexpr FtdiRequest kDtrLow{kModem, 0x0100}, kDtrHigh{kModem, 0x0101}, kRtsLow{kModem, 0x0200};

constexpr std::array kPrepare{kPurgeIn,
                              kPurgeOut,
                              FtdiRequest{kLatency, 16},
                              FtdiRequest{kBaud, 0x4138},
                              FtdiRequest{kData, 8},
                              FtdiRequest{kFlow, 0},
                              kRtsLow,
                              kDtrLow,
                              kDtrHigh};
constexpr std::array kSpeedUp{kDtrLow, FtdiRequest{kBaud, 0x15}};
constexpr std::array kRun{FtdiRequest{kLatency, 1}, FtdiRequest{kBaud, 2}, kPurgeIn, kPurgeOut};

constexpr std::array<std::uint8_t, 3> kGreeting{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kAnswer{0x0A, 0x44, 0x2C, 0x0D};
constexpr std::array<std::uint8_t, 1> kProbe{0x41};
constexpr std::size_t kPiece = 62;

std::string hex(std::uint8_t byte) {
  const char* digits = "0123456789ABCDEF";
  return {'0', 'x', digits[byte >> 4], digits[byte & 15]};
}

}  // namespace

std::span<const FtdiRequest> falconRunRequests() { return kRun; }

FalconLoader::Action FalconLoader::next() const {
  switch (stage_) {
    case Stage::prepare:
    case Stage::speed_up:
    case Stage::run:
      return Action::request;
    case Stage::greet:
    case Stage::probe:
    case Stage::stream:
      return Action::send;
    case Stage::await_greeting:
    case Stage::await_probe:
    case Stage::await_echo:
      return Action::listen;
    case Stage::over:
      return Action::done;
    case Stage::broken:
      break;
  }
  return Action::failed;
}

std::span<const FtdiRequest> FalconLoader::requests() const {
  if (stage_ == Stage::prepare) return kPrepare;
  if (stage_ == Stage::speed_up) return kSpeedUp;
  return kRun;
}

FtdiRequest FalconLoader::request() const { return requests()[step_]; }

std::span<const std::uint8_t> FalconLoader::piece() const {
  return program_.subspan(sent_, std::min(kPiece, program_.size() - sent_));
}

std::span<const std::uint8_t> FalconLoader::send() const {
  if (stage_ == Stage::greet) return kGreeting;
  if (stage_ == Stage::probe) return kProbe;
  return piece();
}

int FalconLoader::timeout_ms() const {
  // The bridge delivers what it has every 16 ms; 62 bytes at 140 kbaud take 5 ms.
  return stage_ == Stage::await_greeting ? 50 : 1000;
}

void FalconLoader::done() {
  switch (stage_) {
    case Stage::prepare:
    case Stage::speed_up:
    case Stage::run:
      if (++step_ < requests().size()) return;
      step_ = 0;
      stage_ = stage_ == Stage::prepare ? Stage::greet : stage_ == Stage::speed_up ? Stage::probe : Stage::over;
      return;
    case Stage::greet:
      --greetings_left_;
      matched_ = 0;
      answer_wrong_ = false;
      stage_ = Stage::await_greeting;
      return;
    case Stage::probe:
      stage_ = Stage::await_probe;
      return;
    case Stage::stream:
      sent_ += piece().size();
      stage_ = Stage::await_echo;
      return;
    default:
      return;
  }
}

void FalconLoader::received(std::span<const std::uint8_t> payload) {
  for (std::uint8_t byte : payload) take(byte);
}

void FalconLoader::take(std::uint8_t byte) {
  if (stage_ == Stage::await_greeting) {
    // A zero may come before the answer; anything else fails this attempt.
    if (matched_ == 0 && byte == 0) return;
    answer_wrong_ = answer_wrong_ || byte != kAnswer[matched_];
    if (!answer_wrong_ && ++matched_ == kAnswer.size()) stage_ = Stage::speed_up;
  } else if (stage_ == Stage::await_probe) {
    if (byte != kProbe[0]) return fail("it answered " + hex(byte) + " where 0x41 was due");
    stage_ = Stage::stream;
    if (program_.empty()) fail("the program is empty");
  } else if (stage_ == Stage::await_echo) {
    if (byte != program_[echoed_])
      return fail("byte " + std::to_string(echoed_) + " of " + std::to_string(program_.size()) + " came back as " +
                  hex(byte) + " instead of " + hex(program_[echoed_]));
    if (++echoed_ == sent_) stage_ = sent_ == program_.size() ? Stage::run : Stage::stream;
  }
}

void FalconLoader::timedOut() {
  if (stage_ == Stage::await_greeting) {
    if (greetings_left_ > 0)
      stage_ = Stage::greet;
    else
      fail("it does not answer the greeting");
  } else if (stage_ == Stage::await_probe) {
    fail("it does not answer at 140 kbaud");
  } else if (stage_ == Stage::await_echo) {
    fail("it fell silent after " + std::to_string(echoed_) + " of " + std::to_string(program_.size()) + " bytes");
  }
}

void FalconLoader::fail(std::string trouble) {
  trouble_ = std::move(trouble);
  stage_ = Stage::broken;
}

}  // namespace haptics
