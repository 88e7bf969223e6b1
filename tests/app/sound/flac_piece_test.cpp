#include "app/sound/flac_piece.h"

#include "app/sound/sound_reader.h"
#include "app/text/usage_error.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

TEST(FlacPiece, SixteenBitsAreKeptExactlyAndWhatIsLouderIsCutOff) {
  std::mt19937 random(2);
  std::vector<float> samples(96'000);
  for (float& sample : samples) sample = static_cast<float>(static_cast<int>(random() % 65'536) - 32'768) / 32'768.0F;
  samples[5] = 3.0F, samples[6] = -3.0F;
  const auto read = soundOfFlac(flacOf(samples, 48'000), 48'000, 96'000);
  ASSERT_TRUE(read);
  EXPECT_GT((*read)[5], 0.999F);
  EXPECT_FLOAT_EQ((*read)[6], -1.0F);
  samples[5] = (*read)[5], samples[6] = -1.0F;
  EXPECT_EQ(*read, samples);
}

TEST(FlacPiece, WhatIsNoneOfOursIsNone) {
  const std::string flac = flacOf(std::vector<float>(480, 0.1F), 48'000);
  EXPECT_TRUE(soundOfFlac(flac, 48'000, 480));
  EXPECT_FALSE(soundOfFlac(flac, 44'100, 480));
  EXPECT_FALSE(soundOfFlac(flac, 48'000, 479));
  EXPECT_FALSE(soundOfFlac("", 48'000, 480));
  EXPECT_FALSE(soundOfFlac("RIFF....WAVE", 48'000, 480));
}

TEST(SoundReader, ReadsAFileAndThenSilence) {
  const tests::ScratchFolder scratch;
  std::ofstream(scratch.file("a.flac")) << flacOf(std::vector<float>(100, 0.25F), 48'000);
  SoundReader reader(scratch.file("a.flac"), 48'000);
  std::vector<float> read(150);
  reader.read(read);
  EXPECT_FLOAT_EQ(read[99], 0.25F);
  EXPECT_FLOAT_EQ(read[100], 0.0F);
  reader.read(read);
  EXPECT_FLOAT_EQ(read[0], 0.0F);
  EXPECT_THROW(SoundReader(scratch.file("none.wav"), 48'000), UsageError);
  EXPECT_THROW(SoundReader(scratch.file("a.flac"), 44'100), UsageError);
}

}  // namespace
}  // namespace app
