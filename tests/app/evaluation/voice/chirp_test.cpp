#include "app/evaluation/voice/chirp.h"

namespace app {
namespace {

constexpr double kChirpRate_Hz = 48'000.0;

std::vector<float> noise(std::size_t count, float loud, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> bell(0.0F, loud);
  std::vector<float> made(count);
  for (float& sample : made) sample = bell(random);
  return made;
}

TEST(Chirp, IsFoundToTheSampleInNoiseAndWithAnEcho) {
  std::mt19937 random(1);
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const auto at = std::uniform_int_distribution<std::size_t>(0, 23'000)(random);
    std::vector<float> sound = noise(24'000, 0.01F, seed);
    const std::vector<float> chirp = chirpAt(kChirpRate_Hz);
    EXPECT_EQ(chirp.size(), 240u);
    for (std::size_t n = 0; n < chirp.size(); ++n) {
      sound[at + n] += 0.1F * chirp[n];
      if (at + n + 500 < sound.size()) sound[at + n + 500] += 0.05F * chirp[n];
    }
    const auto found = findChirp(sound, kChirpRate_Hz);
    ASSERT_TRUE(found) << seed;
    EXPECT_EQ(found->at, at) << seed;
  }
}

TEST(Chirp, IsNotFoundInNoiseOrSilence) {
  EXPECT_FALSE(findChirp(noise(24'000, 0.1F, 5), kChirpRate_Hz));
  EXPECT_FALSE(findChirp(std::vector<float>(24'000, 0.0F), kChirpRate_Hz));
  EXPECT_FALSE(findChirp(std::vector<float>(10, 0.5F), kChirpRate_Hz));
}

}  // namespace
}  // namespace app
