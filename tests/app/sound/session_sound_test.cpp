#include "app/review/session_sound.h"

#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>

#include "app/session/session_error.h"
#include "app/session/session_writer.h"
#include "app/text/usage_error.h"
#include "tests/app/session/small_session.h"

namespace app {
namespace {

std::vector<float> samplesOf(const std::string& path) {
  SF_INFO info{};
  SNDFILE* const file = sf_open(path.c_str(), SFM_READ, &info);
  EXPECT_NE(file, nullptr);
  EXPECT_EQ(info.samplerate, kSoundRate_Hz);
  EXPECT_EQ(info.channels, 1);
  std::vector<float> samples(static_cast<std::size_t>(info.frames));
  EXPECT_EQ(sf_read_float(file, samples.data(), info.frames), info.frames);
  sf_close(file);
  return samples;
}

/// 2 s of which the spindle turns from 1.0 to 1.5 s.
std::string turningFor(const tests::ScratchFolder& folder) {
  const std::string path = folder.file("s.molar");
  SessionWriter writer(path, false, test::SmallBone().start());
  SessionBatch batch;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    haptics::Tick tick = test::imaginedTick(n);
    tick.drilling = false;
    tick.overlap_mm3 = 0.0;
    tick.torn_total_Nmm = 0.0;
    tick.broken = {};
    tick.spindle_rad_per_s = n >= 1000 && n < 1500 ? 4000.0 : 0.0;
    batch.ticks.push_back(tick);
  }
  writer.write(batch);
  writer.seal(0);
  return path;
}

TEST(SessionSound, IsInStepWithTheTicksToFiveMilliseconds) {
  const tests::ScratchFolder folder;
  const std::string to = folder.file("s.flac");
  EXPECT_NEAR(writeSessionSound(turningFor(folder), to), 2.0, 1e-9);
  const std::vector<float> samples = samplesOf(to);
  ASSERT_EQ(samples.size(), 2U * kSoundRate_Hz);
  std::size_t first = 0, last = 0;
  for (std::size_t n = 0; n < samples.size(); ++n)
    if (std::abs(samples[n]) > 0.02F) last = n, first = first == 0 ? n : first;
  EXPECT_NEAR(static_cast<double>(first) / kSoundRate_Hz, 1.0, 0.005);
  EXPECT_NEAR(static_cast<double>(last) / kSoundRate_Hz, 1.5, 0.015) << "it fades";
}

TEST(SessionSound, IsTheSameEachTime) {
  const tests::ScratchFolder folder;
  const std::string session = turningFor(folder);
  writeSessionSound(session, folder.file("a.flac"));
  writeSessionSound(session, folder.file("b.flac"));
  EXPECT_EQ(samplesOf(folder.file("a.flac")), samplesOf(folder.file("b.flac")));
}

TEST(SessionSound, OfASessionWithoutTicksIsRefused) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("s.molar");
  {
    SessionWriter writer(path, false, test::SmallBone().start());
    writer.seal(0);
  }
  EXPECT_THROW(writeSessionSound(path, folder.file("s.flac")), SessionError);
}

TEST(SessionSound, AFolderThatIsNotThereIsToldInOneLine) {
  const tests::ScratchFolder folder;
  EXPECT_THROW(writeSessionSound(turningFor(folder), folder.file("nowhere/s.flac")), UsageError);
}

}  // namespace
}  // namespace app
