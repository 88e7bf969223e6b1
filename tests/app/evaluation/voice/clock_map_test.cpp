#include "app/evaluation/voice/clock_map.h"

#include <numbers>

#include "app/evaluation/voice/voice_recorder.h"
#include "tests/mutants.h"

namespace app {
namespace {

constexpr double kRate_Hz = 48'000.0;

/// A sound card whose clock is off, whose callbacks are late, and which loses samples now and then.
class SimulatedCard {
 public:
  struct Callback {
    std::uint32_t frames = 0;
    std::int64_t t_ns = 0;
    bool overrun = false;
  };

  SimulatedCard(double off_ppm, std::uint32_t seed) : off_(off_ppm * 1e-6), random_(seed) {}

  /// When a sample is at the microphone: an oscillator that is off, and wanders by 2 ppm in ten minutes.
  double trueTime_ns(double sample) const {
    const double t_s = sample / kRate_Hz * (1.0 - off_);
    constexpr double kWander = 2e-6, kPeriod_s = 600.0;
    return kBegin_ns + 1e9 * (t_s + kWander * kPeriod_s / (2.0 * std::numbers::pi) *
                                        std::sin(2.0 * std::numbers::pi * t_s / kPeriod_s));
  }
  /// All callbacks of a time, in order; samples of `lost_s` (where from) are lost, 0.3 s each.
  std::vector<Callback> callbacks(double length_s, const std::vector<double>& lost_s) {
    std::vector<Callback> made;
    std::uniform_real_distribution<double> to_one(0.0, 1.0);
    constexpr std::uint32_t kFrames = 480;
    std::uint64_t sample = 0;
    std::size_t losses = 0;
    double not_before_ns = 0.0;
    bool overrun = false;
    while (static_cast<double>(sample) / kRate_Hz < length_s) {
      if (losses < lost_s.size() && static_cast<double>(sample) / kRate_Hz >= lost_s[losses]) {
        sample += static_cast<std::uint64_t>(kLost_s * kRate_Hz);
        ++losses;
        overrun = true;
      }
      taken.push_back(sample);
      sample += kFrames;
      // Up to 20 ms late, and in each half minute 200 ms.
      double late_ns = 20e6 * std::pow(to_one(random_), 2.0);
      if (to_one(random_) < 1.0 / 3000.0) late_ns = 200e6;
      const double at_ns = std::max(not_before_ns, trueTime_ns(static_cast<double>(sample)) + late_ns);
      not_before_ns = at_ns;
      made.push_back({kFrames, static_cast<std::int64_t>(at_ns), overrun});
      overrun = false;
    }
    return made;
  }

  static constexpr double kBegin_ns = 5.3e15, kLost_s = 0.3;
  std::vector<std::uint64_t> taken;  ///< first true sample of each callback

 private:
  double off_;
  std::mt19937 random_;
};

/// Half an hour through recorder and map: the clicks of every 10 s, by their place in the recording.
double worstClick_ms(double off_ppm, std::uint32_t seed, double length_s) {
  std::map<std::uint64_t, std::vector<float>> segments;
  VoiceRecorder recorder({[&](std::uint64_t number, std::span<const float> samples) {
                            segments[number].assign(samples.begin(), samples.end());
                          },
                          [](const ClockRow&) {}});
  SimulatedCard card(off_ppm, seed);
  const auto callbacks = card.callbacks(length_s, {0.3 * length_s + 3.7, 0.7 * length_s + 1.1});
  // A click is one loud sample, so the recording tells where it is.
  std::vector<double> clicks_ns;
  double next_click = 10.0 * kRate_Hz;
  for (std::size_t n = 0; n < callbacks.size(); ++n) {
    for (std::uint32_t at = 0; at < callbacks[n].frames; at += HeardBlock::kMost) {
      HeardBlock block;
      block.count = std::min<std::uint32_t>(HeardBlock::kMost, callbacks[n].frames - at);
      block.overrun = at == 0 && callbacks[n].overrun;
      block.t_ns = at + block.count == callbacks[n].frames ? callbacks[n].t_ns : 0;
      for (std::uint32_t k = 0; k < block.count; ++k) {
        const auto sample = static_cast<double>(card.taken[n] + at + k);
        if (sample < next_click) continue;
        block.samples[k] = 0.9F;
        clicks_ns.push_back(card.trueTime_ns(sample));
        next_click += 10.0 * kRate_Hz;
      }
      recorder.add(block);
    }
  }
  recorder.finish();
  EXPECT_EQ(recorder.gaps(), 2u);
  EXPECT_NEAR(static_cast<double>(recorder.frames()) / kRate_Hz, length_s, 0.05);
  const ClockMap map = recorder.map();
  EXPECT_NEAR(map.drift_ppm(), -off_ppm, 5.0);
  double worst_ms = 0.0;
  std::size_t click = 0;
  for (const auto& [segment, samples] : segments) {
    for (std::size_t n = 0; n < samples.size(); ++n) {
      if (samples[n] < 0.5F) continue;
      if (click == clicks_ns.size()) return 1e9;
      const auto frame = static_cast<double>(segment * kSegmentFrames + n);
      const double off_ms = (static_cast<double>(map.t_ns(frame)) - clicks_ns[click]) * 1e-6;
      worst_ms = std::max(worst_ms, std::abs(off_ms));
      EXPECT_NEAR(map.frame(map.t_ns(frame)), frame, 0.1);
      ++click;
    }
  }
  EXPECT_EQ(click, clicks_ns.size());
  return worst_ms;
}

TEST(ClockMap, FindsEachClickWithinFiveMillisecondsInHalfAnHour) {
  for (const double off_ppm : {-300.0, 300.0}) EXPECT_LE(worstClick_ms(off_ppm, 7, 1800.0), 5.0) << off_ppm;
}

TEST(ClockMap, FindsThemWithAnySeed) {
  std::mt19937 random(3);
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const double off_ppm = std::uniform_real_distribution<double>(-300.0, 300.0)(random);
    EXPECT_LE(worstClick_ms(off_ppm, seed, 240.0), 5.0) << seed << ' ' << off_ppm;
  }
}

TEST(ClockMap, JoinsTheLeastOfEachTenSecondsByLines) {
  // 48 samples are 1 ms. Three windows; the least come 1, 2 and 4 ms after the first sample's time.
  std::vector<ClockRow> rows;
  for (std::uint64_t s = 0; s < 30; ++s) {
    const std::int64_t least_ms = s == 5 ? 1 : s == 15 ? 2 : s == 25 ? 4 : 50;
    rows.push_back(
        {s * 48'000, 1'000'000'000'000 + static_cast<std::int64_t>(s) * 1'000'000'000 + least_ms * 1'000'000, 0});
  }
  const ClockMap map(rows, 48'000.0);
  EXPECT_EQ(map.t_ns(5 * 48'000.0), 1'005'001'000'000);
  EXPECT_EQ(map.t_ns(10 * 48'000.0), 1'010'001'500'000);
  EXPECT_EQ(map.t_ns(20 * 48'000.0), 1'020'003'000'000);
  // The first and the last line go on: -0.1 ms a second before 5 s, +0.2 ms behind 25 s.
  EXPECT_EQ(map.t_ns(0.0), 1'000'000'500'000);
  EXPECT_EQ(map.t_ns(30 * 48'000.0), 1'030'005'000'000);
  EXPECT_DOUBLE_EQ(map.drift_ppm(), 150.0);
  EXPECT_NEAR(map.frame(1'020'003'000'000), 20 * 48'000.0, 1e-3);
}

TEST(ClockMap, AGapBeginsAnotherStretch) {
  const std::vector<ClockRow> rows{{48'000, 1'000'000'000, 0},
                                   {96'000, 2'000'000'000, 0},
                                   {96'000, 3'700'000'000, 4'800},
                                   {148'800, 3'700'000'000, 0}};
  const ClockMap map(rows, 48'000.0);
  EXPECT_EQ(map.t_ns(96'000.0), 2'000'000'000);
  // 3.7 s less one second of samples that came with it.
  EXPECT_EQ(map.t_ns(100'800.0), 2'700'000'000);
  EXPECT_NEAR(map.frame(2'700'000'000), 100'800.0, 1e-3);
  EXPECT_NEAR(map.frame(1'500'000'000), 72'000.0, 1e-3);
}

TEST(ClockMap, AWindowThatHasOnlyBegunDoesNotStandForItself) {
  std::vector<ClockRow> rows;
  for (std::uint64_t s = 0; s <= 20; ++s) rows.push_back({s * 48'000, static_cast<std::int64_t>(s) * 1'000'000'000, 0});
  // Late by 200 ms, and the last one before a gap; and the last one of all.
  rows.back().t_ns += 200'000'000;
  EXPECT_NEAR(static_cast<double>(ClockMap(rows, 48'000.0).t_ns(20 * 48'000.0)), 20e9, 1e3);
  rows.push_back({20 * 48'000, 21'000'000'000, 480});
  rows.push_back({21 * 48'000, 21'000'000'000, 0});
  EXPECT_NEAR(static_cast<double>(ClockMap(rows, 48'000.0).t_ns(20 * 48'000.0 - 1.0)), 20e9 - 1e9 / 48'000.0, 1e3);
}

TEST(ClockMap, WithoutRowsItKnowsNothing) {
  const ClockMap map({}, 48'000.0);
  EXPECT_FALSE(map.isKnown());
  EXPECT_EQ(map.t_ns(48'000.0), 1'000'000'000);
  EXPECT_DOUBLE_EQ(map.frame(1'000'000'000), 48'000.0);
  EXPECT_DOUBLE_EQ(map.drift_ppm(), 0.0);
}

TEST(ClockRows, AreReadAsTheyWereWritten) {
  const std::vector<ClockRow> rows{{0, -5, 0}, {480, 10'000'000, 0}, {480, 12'000'000, 96'000}};
  std::string text(kClockHeader);
  for (const ClockRow& row : rows) text += clockLine(row);
  EXPECT_EQ(clockRowsFrom(text), rows);
  // What a kill has cut off is left out.
  EXPECT_EQ(clockRowsFrom(text + "960,1300"), rows);
  EXPECT_FALSE(clockRowsFrom("frame,t_ns\n"));
  EXPECT_FALSE(clockRowsFrom(text + "1,2\n"));
  EXPECT_FALSE(clockRowsFrom(text + "0,13000000,0\n"));
  EXPECT_FALSE(clockRowsFrom(text + "99999999999999999,13000000,0\n"));
}

TEST(ClockRowsMutants, AreRefusedOrMakeAMapOfFiniteTimes) {
  std::string good(kClockHeader);
  for (std::uint64_t n = 1; n < 40; ++n)
    good += clockLine({n * 48'000, static_cast<std::int64_t>(n) * 1'000'000'007, n % 9 == 8 ? 480u : 0u});
  int taken = 0;
  mutants::forEachMutant({good}, 3000, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    const auto rows = clockRowsFrom(mutant);
    if (!rows) return;
    ++taken;
    const ClockMap map(*rows, 48'000.0);
    EXPECT_TRUE(std::isfinite(map.frame(map.t_ns(1e6))));
    EXPECT_TRUE(std::isfinite(map.drift_ppm()));
  });
  EXPECT_GT(taken, 0);
}

}  // namespace
}  // namespace app
