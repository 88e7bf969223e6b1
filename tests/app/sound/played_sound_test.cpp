#include "app/sound/played_sound.h"

#include <cmath>
#include <numeric>
#include <vector>

namespace app {
namespace {

constexpr std::int64_t kPlayed_ns = 3'000'000'000'000;

double waveAt(double t_s) { return 0.5 * std::sin(2.0 * 3.14159265358979 * 440.0 * t_s); }

TEST(PlayedSound, IsReadByItsTimeAtAnotherRate) {
  constexpr double kCard_Hz = 44'100.0;
  PlayedSound played;
  PlayedSoundReader reader(played.descriptor(), 48'000.0);
  ASSERT_TRUE(reader.isThere());
  std::vector<float> piece(441), read(480);
  double worst = 0.0;
  for (int n = 0; n < 400; ++n) {
    for (std::size_t k = 0; k < piece.size(); ++k)
      piece[k] = static_cast<float>(waveAt((static_cast<double>(n) * 441.0 + static_cast<double>(k)) / kCard_Hz));
    played.add(piece, kCard_Hz, kPlayed_ns + n * 10'000'000LL);
    if (n < 30) continue;
    // What was handed over 0.2 s ago.
    const std::int64_t from_ns = kPlayed_ns + (n - 20) * 10'000'000LL;
    reader.read(from_ns, read);
    for (std::size_t k = 0; k < read.size(); ++k)
      worst = std::max(worst,
                       std::abs(read[k] - waveAt(static_cast<double>(n - 20) * 0.01 + static_cast<double>(k) / 48e3)));
  }
  EXPECT_LT(worst, 0.01);
}

TEST(PlayedSound, IsSilenceWhereNothingWasPlayed) {
  PlayedSound played;
  PlayedSoundReader reader(played.descriptor(), 48'000.0);
  std::vector<float> read(480, 1.0F);
  reader.read(kPlayed_ns, read);
  EXPECT_FLOAT_EQ(std::accumulate(read.begin(), read.end(), 0.0F), 0.0F);
  const std::vector<float> piece(480, 0.5F);
  played.add(piece, 48'000.0, kPlayed_ns);
  // Long after, and long before.
  for (const std::int64_t at_ns : {kPlayed_ns + 5'000'000'000, kPlayed_ns - 5'000'000'000}) {
    reader.read(at_ns, read);
    for (const float sample : read) ASSERT_FLOAT_EQ(sample, 0.0F);
  }
}

TEST(PlayedSound, WithoutADescriptorThereIsSilence) {
  PlayedSoundReader reader(-1, 48'000.0);
  EXPECT_FALSE(reader.isThere());
  std::vector<float> read(10, 1.0F);
  reader.read(kPlayed_ns, read);
  EXPECT_FLOAT_EQ(read[3], 0.0F);
}

}  // namespace
}  // namespace app
