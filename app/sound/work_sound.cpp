#include "app/sound/work_sound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFibre_Nmm = 2.0, kStiffness_N_per_mm = 500.0;
constexpr double kFastest_rad_per_s = 1e5;  ///< more, or no number, is damage: silence

/// The colour of a cut: the harder, the higher.
double cutFrequency_Hz(std::uint8_t label) {
  switch (static_cast<assets::Tissue>(label)) {
    case assets::Tissue::enamel:
      return 4600.0;
    case assets::Tissue::dentine:
    case assets::Tissue::other_teeth:
      return 3000.0;
    case assets::Tissue::cortical:
    case assets::Tissue::caries_firm:
      return 2200.0;
    case assets::Tissue::trabecular:
      return 1100.0;
    default:
      return 700.0;
  }
}

/// Of a click, from 30 mJ, the break of a usual bridge: 0.5.
double clickLevel(double energy_Nmm) { return 0.5 * std::sqrt(energy_Nmm / 30.0); }

struct AlarmTone {
  double first_Hz, second_Hz, times_per_s;
};
/// Of SoundAlarm: told apart by pitch and by beat.
constexpr std::array<AlarmTone, 4> kAlarms{
    {{0.0, 0.0, 1.0}, {1175.0, 880.0, 5.0}, {988.0, 988.0, 4.0}, {740.0, 740.0, 2.5}}};

struct ApexBeat {
  double pitch_Hz, times_per_s;  ///< 0: steady
};
/// Of ApexTone.
constexpr std::array<ApexBeat, 5> kApexBeats{
    {{1400.0, 0.0}, {1400.0, 1.5}, {1400.0, 3.0}, {1400.0, 6.0}, {1900.0, 0.0}}};

}  // namespace

ApexTone apexTone(double left_mm, bool is_apex) noexcept {
  constexpr double kNear_mm = 2.0, kClose_mm = 1.0, kConstriction_mm = 0.55;
  return is_apex                       ? ApexTone::apex
         : left_mm <= kConstriction_mm ? ApexTone::constriction
         : left_mm <= kClose_mm        ? ApexTone::close
         : left_mm <= kNear_mm         ? ApexTone::near
                                       : ApexTone::none;
}

SoundWarning soundWarning(const haptics::Clearances& clearances) noexcept {
  constexpr std::array kAlarmOf{SoundAlarm::canal, SoundAlarm::lingual, SoundAlarm::second_molar, SoundAlarm::lingual};
  SoundWarning found;
  for (std::size_t n = 0; n < clearances.size(); ++n) {
    if (!clearances[n]) continue;
    const assets::RiskLevel level = assets::riskLevel(n, *clearances[n]);
    if (level == assets::RiskLevel::red) return {kAlarmOf[n], true};
    if (level == assets::RiskLevel::amber && found.alarm == SoundAlarm::none) found.alarm = kAlarmOf[n];
  }
  return found;
}

SoundControl SoundScore::of(const haptics::Tick& tick, const haptics::Command& in_force) noexcept {
  constexpr double kLoud_mm3_per_s = 10.0, kRub_N = 4.0, kRub = 0.25, kStalled = 0.4;
  SoundControl control;
  const double recorded = std::abs(tick.spindle_rad_per_s);
  const double speed = recorded <= kFastest_rad_per_s ? recorded : 0.0;
  control.spindle_Hz = speed / kTurn;
  const bool touches = tick.overlap_mm3 > 0.0;
  if (touches && tick.drilling && tick.dt_s > 0.0) {
    const double removed = std::sqrt(std::max(0.0, tick.removed_mm3) / tick.dt_s / kLoud_mm3_per_s);
    const double rub = kRub * glm::length(tick.law_force_P_N.xyz) / kRub_N;
    control.cut = std::min(1.0, std::max(removed, std::min(kRub, rub)));
  }
  control.cut_Hz = cutFrequency_Hz(tick.contact_tissue);
  control.water = tick.drilling && in_force.irrigating ? 1.0 : 0.0;
  const double wanted = haptics::radPerSecond(std::abs(in_force.spindle.commanded_rpm));
  control.stall = tick.drilling && touches && speed < kStalled * wanted ? 1.0 : 0.0;
  if (tick.broken.piece != 0)
    control.crack_Nmm = tick.broken.force_N * tick.broken.force_N / (2.0 * kStiffness_N_per_mm);
  if (tick.torn_total_Nmm > torn_Nmm_) waiting_Nmm_ += tick.torn_total_Nmm - torn_Nmm_;
  torn_Nmm_ = tick.torn_total_Nmm;
  control.fibres = static_cast<int>(std::min(8.0, waiting_Nmm_ / kFibre_Nmm));
  waiting_Nmm_ = control.fibres < 8 ? waiting_Nmm_ - kFibre_Nmm * control.fibres : 0.0;
  if (touches && tick.contact_tissue == static_cast<std::uint8_t>(assets::Tissue::mandibular_canal))
    control.warning = {SoundAlarm::canal, true};
  return control;
}

WorkSound::WorkSound(double rate_Hz) : rate_Hz_(rate_Hz), glide_(1.0 - std::exp(-1.0 / (0.003 * rate_Hz))) {}

/// White, -1 to 1.
double WorkSound::noise() noexcept {
  random_ = random_ * 1664525u + 1013904223u;
  return static_cast<double>(random_ >> 8) * (2.0 / 16777216.0) - 1.0;
}

double WorkSound::tone() noexcept {
  constexpr std::array kOvertones{0.5, 0.28, 0.14, 0.08};
  constexpr double kLoudest = 0.16, kFull_Hz = 667.0;
  // A bearing is not a tuning fork.
  jitter_ += 0.002 * (noise() - jitter_);
  spindle_phase_ += now_.spindle_Hz * (1.0 + 0.05 * jitter_) / rate_Hz_;
  spindle_phase_ -= std::floor(spindle_phase_);
  double sum = 0.0;
  for (std::size_t k = 0; k < kOvertones.size(); ++k)
    sum += kOvertones[k] * std::sin(kTurn * spindle_phase_ * static_cast<double>(k + 1));
  growl_phase_ += 95.0 / rate_Hz_;
  growl_phase_ -= std::floor(growl_phase_);
  return kLoudest * std::min(1.0, now_.spindle_Hz / kFull_Hz) * sum + 0.15 * now_.stall * (2.0 * growl_phase_ - 1.0);
}

/// Noise through a band as wide as its frequency.
double WorkSound::cut(double white) noexcept {
  constexpr double kLoudest = 0.5, kDamping = 0.9;
  const double f = 2.0 * std::sin(std::numbers::pi * std::min(0.2, now_.cut_Hz / rate_Hz_));
  low_ += f * band_;
  band_ += f * (white - low_ - kDamping * band_);
  const double swell = 1.0 + 0.5 * std::sin(kTurn * spindle_phase_);
  return kLoudest * now_.cut * swell * band_;
}

double WorkSound::clicks() noexcept {
  click_ *= std::exp(-1.0 / (0.008 / 3.0 * rate_Hz_));
  thud_ *= std::exp(-1.0 / (0.03 / 3.0 * rate_Hz_));
  click_phase_ += 3000.0 / rate_Hz_;
  thud_phase_ += 300.0 / rate_Hz_;
  return click_ * std::sin(kTurn * click_phase_) + 0.6 * thud_ * std::sin(kTurn * thud_phase_);
}

/// Beats of a tone, with soft edges.
double WorkSound::alarm() noexcept {
  constexpr double kLoudest = 0.25;
  const AlarmTone& sounds = kAlarms[static_cast<std::size_t>(now_.warning.alarm)];
  const double beat = std::fmod(alarm_s_ * sounds.times_per_s * (now_.warning.is_red ? 1.0 : 0.4), 2.0);
  const bool on = now_.warning.alarm != SoundAlarm::none && std::fmod(beat, 1.0) < 0.6;
  alarm_s_ = now_.warning.alarm == SoundAlarm::none ? 0.0 : alarm_s_ + 1.0 / rate_Hz_;
  alarm_level_ += glide_ * ((on ? 1.0 : 0.0) - alarm_level_);
  alarm_phase_ += (beat < 1.0 ? sounds.first_Hz : sounds.second_Hz) / rate_Hz_;
  alarm_phase_ -= std::floor(alarm_phase_);
  return kLoudest * alarm_level_ * std::sin(kTurn * alarm_phase_);
}

/// The same of an apex locator, softer and higher.
double WorkSound::apex() noexcept {
  constexpr double kLoudest = 0.1;
  const ApexBeat& sounds = kApexBeats[static_cast<std::size_t>(now_.warning.apex)];
  const bool is_steady = sounds.times_per_s == 0.0;
  const bool on =
      now_.warning.apex != ApexTone::none && (is_steady || std::fmod(apex_s_ * sounds.times_per_s, 1.0) < 0.5);
  apex_s_ = now_.warning.apex == ApexTone::none ? 0.0 : apex_s_ + 1.0 / rate_Hz_;
  apex_level_ += glide_ * ((on ? 1.0 : 0.0) - apex_level_);
  apex_phase_ += sounds.pitch_Hz / rate_Hz_;
  apex_phase_ -= std::floor(apex_phase_);
  return kLoudest * apex_level_ * std::sin(kTurn * apex_phase_);
}

void WorkSound::render(const SoundControl& control, std::span<float> samples) noexcept {
  if (control.crack_Nmm > 0.0) {
    click_ = std::max(click_, std::min(0.8, clickLevel(control.crack_Nmm)));
    thud_ = std::max(thud_, click_);
    click_phase_ = thud_phase_ = 0.0;
  }
  if (control.fibres > 0) {
    const double level = std::min(0.2, 0.1 * clickLevel(30.0) * std::sqrt(static_cast<double>(control.fibres)));
    if (level > click_) click_ = level, click_phase_ = 0.0;
  }
  now_.warning = control.warning;
  for (float& sample : samples) {
    const auto glide = [&](double SoundControl::*part) { now_.*part += glide_ * (control.*part - now_.*part); };
    for (const auto part : {&SoundControl::spindle_Hz, &SoundControl::cut, &SoundControl::cut_Hz, &SoundControl::water,
                            &SoundControl::stall})
      glide(part);
    const double white = noise();
    water_low_ += 0.25 * (white - water_low_);
    const double sum = tone() + cut(white) + 0.03 * now_.water * (white - water_low_) + clicks() + alarm() + apex();
    sample = static_cast<float>(std::clamp(sum, -1.0, 1.0));
  }
}

}  // namespace app
