// What the work sounds like, from ticks: the handpiece at the speed of its spindle, which falls under load, a growl
// when it stalls; the cut by tissue, louder the more is removed; water; a bridge of tooth that cracks, fibres that
// tear; and a tone where a structure is touched. Levels and colours are our default; nobody has compared them with a
// handpiece. Pure: the same ticks give the same samples, whatever the pieces in which they are asked for. Constant work
// a sample (0.25 µs, written as FLAC); no allocation, no lock.
//   tone        the spindle's frequency and three overtones: 40,000 rpm are 667 Hz
//   cut         noise about a frequency by hardness, swelling with each turn of the bur
//   crack, fibre  reference/extraction 6: a click of 3 kHz that decays in 8 ms over a thud of 300 Hz, by the energy
//               F^2 / (2 * 500 N/mm); each 2 mJ torn a click 20 dB softer than that of 30 mJ
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/clearance.h"

namespace app {

enum class SoundAlarm : std::uint8_t { none, canal, lingual, second_molar };

/// Of an apex locator: beats that come faster as the foramen nears, at it a steady tone.
enum class ApexTone : std::uint8_t { none, near, close, constriction, apex };
/// `left_mm`: as it tells, to the foramen.
ApexTone apexTone(double left_mm, bool is_apex) noexcept;

/// Of the structure that is nearest within its bands.
struct SoundWarning {
  SoundAlarm alarm = SoundAlarm::none;
  bool is_red = false;  ///< else amber: slower beats
  ApexTone apex = ApexTone::none;
};
SoundWarning soundWarning(const haptics::Clearances& clearances) noexcept;

/// What is heard from one moment on.
struct SoundControl {
  double spindle_Hz = 0.0;
  double cut = 0.0;        ///< loudness, 0 to 1
  double cut_Hz = 1500.0;  ///< its colour
  double water = 0.0;      ///< 0 or 1
  double stall = 0.0;      ///< 0 or 1
  double crack_Nmm = 0.0;  ///< begins here; 0: none
  int fibres = 0;          ///< begin here
  SoundWarning warning;
};

/// From ticks in order.
class SoundScore {
 public:
  SoundControl of(const haptics::Tick& tick, const haptics::Command& in_force) noexcept;

 private:
  double torn_Nmm_ = 0.0, waiting_Nmm_ = 0.0;
};

class WorkSound {
 public:
  explicit WorkSound(double rate_Hz);

  /// Continues with `control`, which holds from the first of these samples on. -1..1.
  void render(const SoundControl& control, std::span<float> samples) noexcept;
  double rate_Hz() const { return rate_Hz_; }

 private:
  double noise() noexcept;
  double tone() noexcept;
  double cut(double white) noexcept;
  double clicks() noexcept;
  double alarm() noexcept;
  double apex() noexcept;

  double rate_Hz_, glide_;
  SoundControl now_;  ///< gliding to what is wanted
  std::uint32_t random_ = 22222;
  double spindle_phase_ = 0.0, growl_phase_ = 0.0, jitter_ = 0.0;  ///< in turns
  double band_ = 0.0, low_ = 0.0, water_low_ = 0.0;
  double click_ = 0.0, thud_ = 0.0, click_phase_ = 0.0, thud_phase_ = 0.0;  ///< levels that decay
  double alarm_s_ = 0.0, alarm_level_ = 0.0, alarm_phase_ = 0.0;
  double apex_s_ = 0.0, apex_level_ = 0.0, apex_phase_ = 0.0;
};

}  // namespace app
