#include "app/debrief/voice_along.h"

#include "app/evaluation/voice/voice_files.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr std::int64_t kClock_ns = 9'000'000'000'000;
constexpr double kTick_s = 0.001;

/// Each sample is its own number in a ramp of four seconds; tick 0 is two seconds after sample 0.
VoiceTrack rampIn(const tests::ScratchFolder& scratch) {
  VoiceFolder folder(scratch.file("voice"));
  std::vector<float> samples(kSegmentFrames);
  for (std::uint64_t segment = 0; segment < 6; ++segment) {
    for (std::size_t n = 0; n < samples.size(); ++n)
      samples[n] = static_cast<float>((segment * kSegmentFrames + n) / 32 % 32'768) / 32'768.0F;
    folder.store(segment, samples);
  }
  for (std::uint64_t s = 1; s < 12; ++s)
    folder.add({s * 48'000, kClock_ns + static_cast<std::int64_t>(s) * 1'000'000'000, 0});
  std::ofstream ticks(scratch.file("voice/ticks.csv"));
  ticks << kClockHeader;
  for (std::uint64_t s = 1; s < 10; ++s)
    ticks << clockLine({s * 1000, kClock_ns + static_cast<std::int64_t>(s + 2) * 1'000'000'000, 0});
  ticks.close();
  return *VoiceTrack::of(scratch.file("."), 1.0 / kTick_s);
}

double sampleAt(double position_s) { return std::floor((position_s + 2.0) * 48'000.0 / 32.0) / 32'768.0; }

TEST(VoiceAlong, WhatIsHeardIsWhatWasSaidAtTheTickThatIsShown) {
  for (const double rate_Hz : {48'000.0, 44'100.0}) {
    const tests::ScratchFolder scratch;
    VoiceAlong along(rampIn(scratch), kTick_s, rate_Hz);
    std::vector<float> waiting;
    std::mt19937 random(4);
    double position_s = 0.5;
    int beginnings = 0;
    for (int frame = 0; frame < 300; ++frame) {
      if (frame == 150) position_s = 1.0;  // a jump
      const VoiceAlong::Piece piece = along.next(position_s, true, waiting.size());
      if (piece.begins) waiting.clear(), ++beginnings;
      waiting.insert(waiting.end(), piece.samples.begin(), piece.samples.end());
      ASSERT_GE(static_cast<double>(waiting.size()), 0.2 * rate_Hz);
      ASSERT_NEAR(waiting[0], sampleAt(position_s), 0.04 * 48'000.0 / 32.0 / 32'768.0) << frame;
      // Frames of 10 to 30 ms, a card that is off by 0.1 %.
      const double passed_s = std::uniform_real_distribution<double>(0.010, 0.030)(random);
      position_s += passed_s;
      waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(passed_s * rate_Hz * 1.001));
    }
    EXPECT_EQ(beginnings, 2);
  }
}

TEST(VoiceAlong, AHandThatDragsHearsAGrainOfEachPosition) {
  const tests::ScratchFolder scratch;
  VoiceAlong along(rampIn(scratch), kTick_s, 48'000.0);
  along.next(1.0, true, 0);
  const VoiceAlong::Piece grain = along.grain(2.0);
  EXPECT_TRUE(grain.begins);
  ASSERT_EQ(grain.samples.size(), 3'840u);
  EXPECT_EQ(grain.samples.front(), 0.0F);
  EXPECT_EQ(grain.samples.back(), 0.0F);
  // Its first sample is of the moment; faded in over 5 ms.
  EXPECT_NEAR(grain.samples[240], sampleAt(2.005), 1e-4);
  const VoiceAlong::Piece rests = along.grain(2.0);
  EXPECT_FALSE(rests.begins);
  EXPECT_TRUE(rests.samples.empty());
  EXPECT_EQ(along.grain(2.1).samples.size(), 3'840u);
  // It goes on from where the hand has let go.
  EXPECT_NEAR(along.next(2.1, true, 0).samples[0], sampleAt(2.1), 1e-4);
}

TEST(VoiceAlong, IsSilentWhereItStandsAndBeginsAnew) {
  const tests::ScratchFolder scratch;
  VoiceAlong along(rampIn(scratch), kTick_s, 48'000.0);
  EXPECT_FALSE(along.next(1.0, false, 0).begins);
  EXPECT_TRUE(along.next(1.0, true, 0).begins);
  // What waits is not played any more.
  const VoiceAlong::Piece stops = along.next(1.02, false, 9'000);
  EXPECT_TRUE(stops.begins);
  EXPECT_TRUE(stops.samples.empty());
  const VoiceAlong::Piece again = along.next(3.0, true, 0);
  EXPECT_TRUE(again.begins);
  ASSERT_EQ(again.samples.size(), 12'000u);
  EXPECT_NEAR(again.samples[0], sampleAt(3.0), 1e-4);
}

}  // namespace
}  // namespace app
