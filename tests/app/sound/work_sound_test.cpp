#include "app/sound/work_sound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kRate_Hz = 48'000.0;

std::vector<float> heard(const SoundControl& control, double seconds, double after_s = 0.1) {
  WorkSound sound(kRate_Hz);
  std::vector<float> before(static_cast<std::size_t>(after_s * kRate_Hz)),
      samples(static_cast<std::size_t>(seconds * kRate_Hz));
  if (!before.empty()) sound.render(control, before);
  SoundControl goes_on = control;
  if (!before.empty()) goes_on.crack_Nmm = 0.0, goes_on.fibres = 0;
  sound.render(goes_on, samples);
  return samples;
}

double powerAt(const std::vector<float>& samples, double f_Hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double u = (static_cast<double>(n) + 0.5) / static_cast<double>(samples.size());
    const double window = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * u);
    sum += static_cast<double>(samples[n]) * window *
           std::polar(1.0, -2.0 * std::numbers::pi * f_Hz * static_cast<double>(n) / kRate_Hz);
  }
  return std::norm(sum / static_cast<double>(samples.size()));
}

double loudness(const std::vector<float>& samples) {
  double sum = 0.0;
  for (const float sample : samples) sum += static_cast<double>(sample) * static_cast<double>(sample);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

double strongest_Hz(const std::vector<float>& samples, double from_Hz, double to_Hz, double step_Hz) {
  double best_Hz = from_Hz, best = -1.0;
  for (double f_Hz = from_Hz; f_Hz <= to_Hz; f_Hz += step_Hz)
    if (const double power = powerAt(samples, f_Hz); power > best) best = power, best_Hz = f_Hz;
  return best_Hz;
}

/// Where half of the power lies below.
double centre_Hz(const std::vector<float>& samples) {
  double sum = 0.0, weighted = 0.0;
  for (double f_Hz = 100.0; f_Hz < 12'000.0; f_Hz += 50.0) {
    const double power = powerAt(samples, f_Hz);
    sum += power;
    weighted += power * f_Hz;
  }
  return weighted / sum;
}

TEST(WorkSound, TheHandpieceSoundsAtTheSpeedOfItsSpindle) {
  for (const double rpm : {10'000.0, 25'000.0, 40'000.0}) {
    SoundControl control;
    control.spindle_Hz = rpm / 60.0;
    EXPECT_NEAR(strongest_Hz(heard(control, 0.5), 80.0, 900.0, 2.0), rpm / 60.0, 0.01 * rpm / 60.0) << rpm;
  }
}

TEST(WorkSound, APitchFallsUnderLoadAndAStallGrowls) {
  SoundControl control;
  control.spindle_Hz = 667.0;
  const double free = powerAt(heard(control, 0.5), 95.0);
  control.spindle_Hz = 200.0;
  control.stall = 1.0;
  const std::vector<float> stalled = heard(control, 0.5);
  EXPECT_NEAR(strongest_Hz(stalled, 80.0, 120.0, 1.0), 95.0, 2.0);
  EXPECT_GT(powerAt(stalled, 95.0), 100.0 * free);
}

TEST(WorkSound, HarderTissueSoundsHigherAndMoreRemovalLouder) {
  SoundControl control;
  control.cut = 0.5;
  double last_Hz = 0.0;
  for (const double colour_Hz : {1100.0, 2200.0, 3000.0, 4600.0}) {
    control.cut_Hz = colour_Hz;
    const double found_Hz = centre_Hz(heard(control, 0.2));
    EXPECT_GT(found_Hz, last_Hz) << colour_Hz;
    last_Hz = found_Hz;
  }
  const double soft = loudness(heard(control, 0.2));
  control.cut = 1.0;
  EXPECT_NEAR(loudness(heard(control, 0.2)) / soft, 2.0, 0.05);
}

TEST(WorkSound, AtRestThereIsSilence) { EXPECT_EQ(loudness(heard({}, 0.2)), 0.0); }

TEST(WorkSound, ACrackIsAClickOfThreeKilohertzThatIsGoneAfterTenMilliseconds) {
  SoundControl control;
  control.crack_Nmm = 30.0;
  const std::vector<float> samples = heard(control, 0.1, 0.0);
  const std::vector<float> begin(samples.begin(), samples.begin() + 240), end(samples.end() - 1200, samples.end());
  EXPECT_GT(loudness(begin), 0.15);
  EXPECT_LT(loudness(end), 1e-3);
  EXPECT_NEAR(strongest_Hz(samples, 1000.0, 6000.0, 50.0), 3000.0, 150.0);
  SoundControl weak;
  weak.crack_Nmm = 3.0;
  EXPECT_NEAR(20.0 * std::log10(loudness(begin) / loudness({heard(weak, 0.005, 0.0)})), 10.0, 0.5)
      << "10 dB for ten times the energy";
}

TEST(WorkSound, AFibreIsTwentyDecibelsSofterThanACrack) {
  SoundControl crack, fibre;
  crack.crack_Nmm = 30.0;
  fibre.fibres = 1;
  const auto click = [](const SoundControl& control) { return std::sqrt(powerAt(heard(control, 0.02, 0.0), 3000.0)); };
  EXPECT_NEAR(20.0 * std::log10(click(crack) / click(fibre)), 20.0, 0.5);
}

TEST(WorkSound, AlarmsDifferByStructure) {
  std::vector<double> found_Hz;
  for (const SoundAlarm alarm : {SoundAlarm::canal, SoundAlarm::lingual, SoundAlarm::second_molar}) {
    SoundControl control;
    control.warning = {alarm, true};
    found_Hz.push_back(strongest_Hz(heard(control, 0.1, 0.01), 600.0, 1300.0, 5.0));
  }
  EXPECT_NEAR(found_Hz[0], 1175.0, 10.0);
  EXPECT_NEAR(found_Hz[1], 988.0, 10.0);
  EXPECT_NEAR(found_Hz[2], 740.0, 10.0);
}

TEST(WorkSound, TheSamplesAreTheSameInWhateverPiecesTheyAreAskedFor) {
  SoundControl control;
  control.spindle_Hz = 500.0;
  control.cut = 0.7;
  control.water = 1.0;
  control.warning = {SoundAlarm::canal, true};
  WorkSound whole(kRate_Hz), pieces(kRate_Hz);
  std::vector<float> a(9600), b(9600);
  whole.render(control, a);
  std::mt19937 random(1);
  for (std::size_t at = 0; at < b.size();) {
    const std::size_t count = std::min<std::size_t>(b.size() - at, 1 + random() % 300);
    pieces.render(control, std::span(b).subspan(at, count));
    at += count;
  }
  EXPECT_EQ(a, b);
}

TEST(WorkSound, IsBoundedWhateverTheControls) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  WorkSound sound(kRate_Hz);
  std::vector<float> samples(200);
  for (int n = 0; n < 3000; ++n) {
    SoundControl control{2000.0 * any(random),
                         any(random),
                         12'000.0 * any(random),
                         1.0,
                         1.0,
                         1000.0 * any(random),
                         static_cast<int>(random() % 9),
                         {static_cast<SoundAlarm>(random() % 4), random() % 2 == 0}};
    sound.render(control, samples);
    for (const float sample : samples) ASSERT_LE(std::abs(sample), 1.0F);
  }
}

TEST(WorkSound, AnAmberAlarmBeatsSlowerThanARedOne) {
  const auto beats = [](bool is_red) {
    SoundControl control;
    control.warning = {SoundAlarm::second_molar, is_red};
    const std::vector<float> samples = heard(control, 4.0, 0.0);
    int begun = 0;
    bool was_loud = false;
    for (std::size_t at = 0; at + 480 <= samples.size(); at += 480) {
      const bool is_loud = loudness({samples.begin() + static_cast<std::ptrdiff_t>(at),
                                     samples.begin() + static_cast<std::ptrdiff_t>(at) + 480}) > 0.05;
      begun += is_loud && !was_loud;
      was_loud = is_loud;
    }
    return begun;
  };
  EXPECT_EQ(beats(true), 10);
  EXPECT_EQ(beats(false), 4);
}

TEST(SoundScore, TheNearestStructureWithinItsBandsIsHeard) {
  EXPECT_EQ(soundWarning({}).alarm, SoundAlarm::none);
  EXPECT_EQ(soundWarning({5.0, 5.0, 5.0, 5.0}).alarm, SoundAlarm::none);
  EXPECT_EQ(soundWarning({1.5, {}, {}, {}}).alarm, SoundAlarm::canal);
  EXPECT_FALSE(soundWarning({1.5, {}, {}, {}}).is_red);
  const SoundWarning red = soundWarning({1.5, 5.0, -0.1, {}});
  EXPECT_EQ(red.alarm, SoundAlarm::second_molar) << "red before amber";
  EXPECT_TRUE(red.is_red);
}

TEST(SoundScore, ReadsTheTick) {
  SoundScore score;
  haptics::Command command;
  haptics::Tick tick;
  tick.dt_s = 1e-3;
  tick.spindle_rad_per_s = haptics::radPerSecond(-40'000.0);
  EXPECT_NEAR(score.of(tick, command).spindle_Hz, 666.7, 0.1);
  EXPECT_EQ(score.of(tick, command).cut, 0.0);
  tick.drilling = true;
  tick.overlap_mm3 = 0.1;
  tick.removed_mm3 = 0.0025;
  tick.contact_tissue = static_cast<std::uint8_t>(assets::Tissue::enamel);
  EXPECT_NEAR(score.of(tick, command).cut, 0.5, 1e-9) << "a quarter of the loudest rate";
  EXPECT_EQ(score.of(tick, command).cut_Hz, 4600.0);
  EXPECT_EQ(score.of(tick, command).water, 1.0);
  EXPECT_EQ(score.of(tick, command).stall, 0.0);
  command.irrigating = false;
  EXPECT_EQ(score.of(tick, command).water, 0.0);
  tick.spindle_rad_per_s *= 0.2;
  EXPECT_EQ(score.of(tick, command).stall, 1.0);
  tick.contact_tissue = static_cast<std::uint8_t>(assets::Tissue::mandibular_canal);
  EXPECT_EQ(score.of(tick, command).warning.alarm, SoundAlarm::canal);
}

TEST(SoundScore, ASpindleOfNoNumberIsSilentAndWhatFollowsIsHeard) {
  SoundScore score;
  WorkSound sound(48'000.0);
  std::vector<float> samples(4800);
  haptics::Tick tick;
  tick.dt_s = 1e-3;
  for (const double damage : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    tick.spindle_rad_per_s = damage;
    sound.render(score.of(tick, {}), samples);
    for (const float sample : samples) ASSERT_EQ(sample, 0.0F);
  }
  tick.spindle_rad_per_s = haptics::radPerSecond(40'000.0);
  sound.render(score.of(tick, {}), samples);
  EXPECT_GT(*std::ranges::max_element(samples), 0.05F);
}

TEST(SoundScore, AFibreForEachTwoMillijoulesAndACrackByItsForce) {
  SoundScore score;
  haptics::Tick tick;
  tick.dt_s = 1e-3;
  int fibres = 0;
  for (int n = 1; n <= 1000; ++n) {
    tick.torn_total_Nmm = 0.05 * n;
    fibres += score.of(tick, {}).fibres;
  }
  EXPECT_NEAR(fibres, 25, 1);
  tick.torn_total_Nmm = 0.0;
  EXPECT_EQ(score.of(tick, {}).fibres, 0) << "undone";
  tick.broken = {1, true, 9.0, 173.0, 0.0};
  EXPECT_NEAR(score.of(tick, {}).crack_Nmm, 30.0, 0.1);
}

TEST(WorkSound, AnApexLocatorBeatsFasterTheNearerAndIsSteadyAtTheApex) {
  EXPECT_EQ(apexTone(2.5, false), ApexTone::none);
  EXPECT_EQ(apexTone(1.5, false), ApexTone::near);
  EXPECT_EQ(apexTone(0.8, false), ApexTone::close);
  EXPECT_EQ(apexTone(0.5, false), ApexTone::constriction);
  EXPECT_EQ(apexTone(0.0, true), ApexTone::apex);
  // Beginnings of a beat in 4 s, by the loudness of hundredths of a second.
  const auto beats = [](ApexTone tone) {
    SoundControl control;
    control.warning.apex = tone;
    const std::vector<float> samples = heard(control, 4.0, 0.0);
    int count = 0;
    bool was_on = false;
    for (std::size_t n = 0; n + 480 <= samples.size(); n += 480) {
      const bool is_on = loudness({samples.begin() + static_cast<std::ptrdiff_t>(n),
                                   samples.begin() + static_cast<std::ptrdiff_t>(n + 480)}) > 0.02;
      count += is_on && !was_on;
      was_on = is_on;
    }
    return count;
  };
  EXPECT_EQ(beats(ApexTone::none), 0);
  EXPECT_EQ(beats(ApexTone::near), 6);
  EXPECT_EQ(beats(ApexTone::close), 12);
  EXPECT_EQ(beats(ApexTone::constriction), 24);
  EXPECT_EQ(beats(ApexTone::apex), 1);
  SoundControl at;
  at.warning.apex = ApexTone::apex;
  EXPECT_NEAR(strongest_Hz(heard(at, 1.0), 800.0, 2500.0, 10.0), 1900.0, 10.0);
}

}  // namespace
}  // namespace app
