#include "app/evaluation/voice/voice_recorder.h"

#include "app/evaluation/voice/voice_files.h"
#include "app/evaluation/voice/voice_track.h"
#include "assets/load_error.h"
#include "calibration/calibration_error.h"
#include "tests/mutants.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

constexpr std::int64_t kFirst_ns = 7'000'000'000'000;

/// What a sample of a test's sound is; 16 bits keep it exactly.
float sampleOf(std::uint64_t n) {
  return static_cast<float>(static_cast<std::int64_t>(n * 7919 % 20011) - 10005) / 32768.0F;
}

std::int64_t timeOf(std::uint64_t frames) { return kFirst_ns + static_cast<std::int64_t>(frames * 1'000'000 / 48); }

/// Blocks of 120 samples in time, from a sample on.
HeardBlock blockAt(std::uint64_t first, std::int64_t late_ns = 0) {
  HeardBlock block;
  block.count = 120;
  for (std::uint32_t n = 0; n < block.count; ++n) block.samples[n] = sampleOf(first + n);
  block.t_ns = timeOf(first + block.count) + late_ns;
  return block;
}

struct Recording {
  explicit Recording(const std::string& path)
      : folder(path),
        recorder({[this](std::uint64_t number, std::span<const float> samples) { folder.store(number, samples); },
                  [this](const ClockRow& row) { folder.add(row); }},
                 folder.takePast()) {}
  VoiceFolder folder;
  VoiceRecorder recorder;
};

TEST(VoiceRecorder, WhatIsHeardIsFoundByItsTime) {
  const tests::ScratchFolder scratch;
  {
    Recording recording(scratch.file("voice"));
    for (std::uint64_t n = 0; n < 5 * 48'000; n += 120) recording.recorder.add(blockAt(n));
    recording.recorder.finish();
  }
  EXPECT_EQ(segmentsIn(scratch.file("voice")), (std::vector<std::uint64_t>{0, 1, 2}));
  auto track = VoiceTrack::of(scratch.file("."), 1000.0);
  ASSERT_TRUE(track);
  EXPECT_EQ(track->frames(), 5 * 48'000);
  EXPECT_EQ(track->frameAt(timeOf(100'000)), 100'000);
  std::vector<float> heard(400);
  // Over the border of two segments, before the first and behind the last sample.
  for (const std::int64_t first : {95'800LL, -100LL, 239'800LL, 1'000'000LL}) {
    track->read(first, heard);
    for (std::size_t n = 0; n < heard.size(); ++n) {
      const std::int64_t frame = first + static_cast<std::int64_t>(n);
      const bool is_there = frame >= 0 && frame < 5 * 48'000;
      ASSERT_FLOAT_EQ(heard[n], is_there ? sampleOf(static_cast<std::uint64_t>(frame)) : 0.0F) << frame;
    }
  }
}

TEST(VoiceRecorder, SamplesLostHereAreSilenceOfTheirLength) {
  const tests::ScratchFolder scratch;
  {
    Recording recording(scratch.file("voice"));
    for (std::uint64_t n = 0; n < 48'000; n += 120) recording.recorder.add(blockAt(n));
    HeardBlock block = blockAt(48'000 + 4'800);
    block.lost = 4'800;
    recording.recorder.add(block);
    for (std::uint64_t n = 52'920; n < 3 * 48'000; n += 120) recording.recorder.add(blockAt(n));
    recording.recorder.finish();
    EXPECT_EQ(recording.recorder.gaps(), 1u);
  }
  auto track = VoiceTrack::of(scratch.file("."), 1000.0);
  ASSERT_TRUE(track);
  EXPECT_EQ(track->frames(), 3 * 48'000);
  std::vector<float> heard(48'000);
  track->read(30'000, heard);
  for (std::size_t n = 0; n < heard.size(); ++n) {
    const std::uint64_t frame = 30'000 + n;
    const bool is_gap = frame >= 48'000 && frame < 52'800;
    ASSERT_FLOAT_EQ(heard[n], is_gap ? 0.0F : sampleOf(frame)) << frame;
  }
}

TEST(VoiceRecorder, HowMuchTheCardLostIsSeenByTheNextHalfSecond) {
  const tests::ScratchFolder scratch;
  Recording recording(scratch.file("voice"));
  for (std::uint64_t n = 0; n < 48'000; n += 120) recording.recorder.add(blockAt(n));
  // 7,200 are lost, and the first after them come late, too.
  for (std::uint64_t n = 55'200; n < 4 * 48'000; n += 120) {
    HeardBlock block = blockAt(n, n < 70'000 ? 15'000'000 : 0);
    block.overrun = n == 55'200;
    recording.recorder.add(block);
  }
  recording.recorder.finish();
  EXPECT_EQ(recording.recorder.gaps(), 1u);
  EXPECT_NEAR(static_cast<double>(recording.recorder.frames()), 4.0 * 48'000.0, 1.0);
}

TEST(VoiceRecorder, AKillAtAnyMomentLosesLessThanTwoSecondsAndItGoesOn) {
  std::mt19937 random(5);
  for (int kill = 0; kill < 12; ++kill) {
    const tests::ScratchFolder scratch;
    const std::uint64_t killed = std::uniform_int_distribution<std::uint64_t>(1'000, 7'000)(random) * 48;
    const std::uint64_t again = killed + std::uniform_int_distribution<std::uint64_t>(10, 300)(random) * 4'800;
    std::uint64_t heard = 0;
    {
      Recording recording(scratch.file("voice"));
      for (; heard < killed; heard += 120) recording.recorder.add(blockAt(heard));
    }
    {
      // A row that was cut off in writing.
      std::ofstream(scratch.file("voice/clock.csv"), std::ios::app) << "9999";
      Recording recording(scratch.file("voice"));
      EXPECT_GT(recording.recorder.frames() + 2 * 48'000, heard) << kill;
      for (std::uint64_t n = again; n < again + 3 * 48'000; n += 120) recording.recorder.add(blockAt(n));
      recording.recorder.finish();
      EXPECT_EQ(recording.recorder.gaps(), 1u) << kill;
    }
    auto track = VoiceTrack::of(scratch.file("."), 1000.0);
    ASSERT_TRUE(track);
    EXPECT_NEAR(static_cast<double>(track->frames()), static_cast<double>(again + 3 * 48'000), 48.0) << kill;
    // What stands after the kill is found by its time, too.
    const std::int64_t frame = track->frameAt(timeOf(again + 48'000));
    std::vector<float> sound(1);
    bool is_there = false;
    for (std::int64_t n = frame - 2; n <= frame + 2; ++n) {
      track->read(n, sound);
      is_there = is_there || sound[0] == sampleOf(again + 48'000);
    }
    EXPECT_TRUE(is_there) << kill;
  }
}

TEST(VoiceRecorder, ADiskThatRefusesIsTold) {
  const tests::ScratchFolder scratch;
  EXPECT_THROW(VoiceFolder(scratch.file("none/voice")), calibration::CalibrationError);
}

TEST(VoiceTrack, TicksAreFoundByTheRowsThatCameEarliest) {
  const tests::ScratchFolder scratch;
  {
    Recording recording(scratch.file("voice"));
    for (std::uint64_t n = 0; n < 48'000; n += 120) recording.recorder.add(blockAt(n));
    recording.recorder.finish();
    // Frames of 16 ms tell ticks of 1 ms between 0 and 15 ms late; the first tick began 4 s before the sound.
    std::ofstream ticks(scratch.file("voice/ticks.csv"));
    ticks << kClockHeader;
    for (std::uint64_t tick = 7; tick < 60'000; tick += 200)
      ticks << clockLine(
          {tick + 1, kFirst_ns - 4'000'000'000 + static_cast<std::int64_t>(tick + 1 + tick * 7 % 16) * 1'000'000, 0});
  }
  const auto track = VoiceTrack::of(scratch.file("."), 1000.0);
  ASSERT_TRUE(track);
  for (const double tick : {500.0, 4'000.0, 31'234.0}) {
    const auto t_ns = track->timeOfTick(tick);
    ASSERT_TRUE(t_ns);
    EXPECT_NEAR(static_cast<double>(*t_ns - kFirst_ns) * 1e-6, tick - 4'000.0, 2.0);
  }
  EXPECT_FALSE(VoiceTrack::of(scratch.file("none"), 1000.0));
}

TEST(VoiceTrackMutants, DamagedSegmentsAreSilenceAndDamagedClocksAreRefused) {
  const tests::ScratchFolder scratch;
  {
    Recording recording(scratch.file("voice"));
    for (std::uint64_t n = 0; n < 48'000; n += 120) recording.recorder.add(blockAt(n));
    recording.recorder.finish();
  }
  std::ostringstream good;
  good << std::ifstream(scratch.file("voice/000000.flac")).rdbuf();
  std::vector<float> sound(100);
  mutants::forEachMutant({good.str()}, 2000, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    std::ofstream(scratch.file("voice/000000.flac"), std::ios::trunc) << mutant;
    auto track = VoiceTrack::of(scratch.file("."), 1000.0);
    ASSERT_TRUE(track);
    track->read(0, sound);
    for (const float sample : sound) ASSERT_LE(std::abs(sample), 1.0F);
  });
  std::ofstream(scratch.file("voice/clock.csv"), std::ios::trunc) << "nothing";
  EXPECT_THROW(VoiceTrack::of(scratch.file("."), 1000.0), assets::LoadError);
}

}  // namespace
}  // namespace app
