#include "tests/haptics/usb/simulated_falcon.h"

#include <algorithm>
#include <cmath>

#include "tests/haptics/usb/falcon_inverse.h"

namespace simulated_usb {
namespace {

/// What holds the grip: 1 N moves it 20 mm/s.
constexpr double kHand_Ns_per_mm = 0.05;

/// 1280 counts for a turn of the shaft, 14.25 mm against the 110 mm of a leg's drum; 0 at 35 degrees.
std::array<std::int16_t, 3> countsOf(const haptics::FalconLegs& legs_rad) {
  constexpr double kPi = 3.14159265358979323846, kCountsPerRad = 1280.0 / (2.0 * kPi) * 110.0 / 14.25;
  std::array<std::int16_t, 3> counts{};
  for (int leg = 0; leg < 3; ++leg)
    counts[static_cast<std::size_t>(leg)] =
        static_cast<std::int16_t>(std::lround((legs_rad[leg] - 35.0 / 180.0 * kPi) * kCountsPerRad));
  return counts;
}

}  // namespace

Description SimulatedFalcon::description() {
  Description d;
  d.vendor = 0x0403;
  d.product = 0xCB48;
  d.interface_class = 0xFF;
  d.endpoints = {{0x81, 2, 64}, {0x02, 2, 64}};
  d.maker = "FTDI";
  d.name = "FALCON HAPTIC";
  d.serial = "FH000001";
  return d;
}

std::optional<Bytes> SimulatedFalcon::onControl(const Setup& setup, std::span<const std::uint8_t>, double) {
  if (setup.type != 0x40 || setup.index != 0) return {};
  switch (setup.request) {
    case 0:
      if (setup.value == 1) said_.clear();
      return Bytes{};
    case 1:
      // DTR going up puts a unit without a program back to its greeting.
      if (setup.value == 0x0101 && !dtr_ && !runs) {
        program.clear();
        knocked_ = false;
        line_.clear();
      }
      if ((setup.value & 0x0100) != 0) dtr_ = (setup.value & 1) != 0;
      return Bytes{};
    case 2:
    case 4:
      return Bytes{};
    case 3:
      baud_ = setup.value;
      line_.clear();
      return Bytes{};
    case 9:
      latency_ms_ = setup.value;
      return Bytes{};
    default:
      return {};
  }
}

void SimulatedFalcon::onOut(std::uint8_t endpoint, std::span<const std::uint8_t> bytes, double t_s) {
  if (endpoint != 0x02) return;
  for (std::uint8_t byte : bytes) {
    if (!runs) {
      boot(byte);
    } else if (baud_ == 2) {
      if (byte == '<') line_.clear();
      line_ += static_cast<char>(byte);
      if (byte == '>') execute(line_, t_s);
    }
  }
  if (!runs && baud_ == 0x15 && program.size() >= program_bytes) runs = true;
}

void SimulatedFalcon::boot(std::uint8_t byte) {
  if (baud_ == 0x4138 && dtr_) {
    line_ += static_cast<char>(byte);
    if (!line_.ends_with("\x0A\x43\x0D")) return;
    line_.clear();
    if (answers_greeting)
      for (int answer : {0x00, 0x0A, 0x44, 0x2C, 0x0D}) said_.push_back(static_cast<std::uint8_t>(answer));
  } else if (baud_ == 0x15 && !knocked_) {
    if (byte != 0x41) return;
    knocked_ = true;
    ++loads_begun;
    said_.push_back(0x41);
  } else if (baud_ == 0x15) {
    const bool wrong = loads_begun <= echo_mistakes && program.size() == 700;
    said_.push_back(wrong ? static_cast<std::uint8_t>(byte + 1) : byte);
    program.push_back(byte);
  }
}

void SimulatedFalcon::execute(const std::string& packet, double t_s) {
  const bool framed = packet.size() == 16 && packet.front() == '<';
  const bool spelled =
      framed && std::all_of(packet.begin() + 1, packet.end() - 1, [](char c) { return c >= 'A' && c <= 'P'; });
  if (!spelled) {
    ++refused;
    return;
  }
  move(t_s);
  packets.push_back(packet);
  for (std::size_t motor = 0; motor < 3; ++motor) {
    int word = 0;
    for (std::size_t nibble = 4; nibble-- > 0;) word = word * 16 + (packet[1 + 4 * motor + nibble] - 'A');
    words[motor] = word >= 0x8000 ? word - 0x10000 : word;
    largest_word = std::max(largest_word, std::abs(words[motor]));
  }
  flags = static_cast<unsigned>(packet[13] - 'A');
  if (answers_packets) report();
}

void SimulatedFalcon::move(double t_s) {
  const double dt_s = std::clamp(t_s - last_move_s_, 0.0, 0.02);
  last_move_s_ = t_s;
  const calibration::Point<calibration::Device> grip{grip_mm};
  const auto legs = haptics::falconLegsAt_rad(grip);
  if (!legs) return;
  const glm::dvec3 torque_Nmm = -glm::dvec3(words[0], words[1], words[2]) / true_words_per_Nmm;
  const glm::dmat3 jacobian = haptics::falconJacobian_mm(*legs, grip);
  if (std::abs(glm::determinant(jacobian)) < 1.0) return;
  const glm::dvec3 force_N = glm::inverse(glm::transpose(jacobian)) * torque_Nmm;
  grip_mm = glm::clamp(grip_mm + force_N / kHand_Ns_per_mm * dt_s, {-30.0, -30.0, 95.0}, {30.0, 30.0, 150.0});
}

void SimulatedFalcon::report() {
  if (garbage) {
    for (char c : std::string("<AAAABBBBQQ>>noise<<")) said_.push_back(static_cast<std::uint8_t>(c));
    return;
  }
  const std::array<std::int16_t, 3> encoders = countsOf(*haptics::falconLegsAt_rad({grip_mm}));
  said_.push_back('<');
  for (std::int16_t encoder : encoders)
    for (int shift = 0; shift < 16; shift += 4)
      said_.push_back(static_cast<std::uint8_t>('A' + ((encoder & 0xFFFF) >> shift & 15)));
  said_.push_back(static_cast<std::uint8_t>('A' + (buttons | homed << 4)));
  said_.push_back('A');
  said_.push_back('>');
}

std::optional<Bytes> SimulatedFalcon::onIn(std::uint8_t, double t_s) {
  // Modem bytes alone once per latency, else as much as a packet takes.
  if (said_.empty() && t_s - last_status_s_ < 1e-3 * latency_ms_) return {};
  last_status_s_ = t_s;
  Bytes packet{0x01, 0x60};
  while (!said_.empty() && packet.size() < 64) {
    packet.push_back(said_.front());
    said_.pop_front();
  }
  return packet;
}

}  // namespace simulated_usb
