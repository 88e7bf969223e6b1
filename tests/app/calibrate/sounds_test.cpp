#include "app/calibrate/sounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace app {
namespace {

constexpr double kRate_Hz = 48'000.0;

class SoundsTest : public testing::Test {
 protected:
  SoundsTest() { std::filesystem::create_directories(folder_); }
  ~SoundsTest() override {
    unsetenv("ALSA_CONFIG_PATH");
    std::filesystem::remove_all(folder_);
  }
  /// The sound library then knows these devices alone.
  void haveCards(const std::string& words) {
    std::ofstream(folder_ / "cards") << words;
    setenv("ALSA_CONFIG_PATH", (folder_ / "cards").c_str(), 1);
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("sounds" + std::to_string(getpid()));
};

TEST(SoundSamples, BeginAndEndInSilenceAndAreShortAndNotLoud) {
  for (const WizardSound sound : {WizardSound::ok, WizardSound::reject, WizardSound::next, WizardSound::done}) {
    const std::vector<float> samples = soundSamples(sound, kRate_Hz);
    ASSERT_FALSE(samples.empty());
    EXPECT_EQ(samples.front(), 0.0F);
    EXPECT_EQ(samples.back(), 0.0F);
    EXPECT_LT(static_cast<double>(samples.size()) / kRate_Hz, 0.7);
    double largest = 0.0, jump = 0.0;
    for (std::size_t n = 1; n < samples.size(); ++n) {
      largest = std::max(largest, std::abs(static_cast<double>(samples[n])));
      jump = std::max(jump, std::abs(static_cast<double>(samples[n] - samples[n - 1])));
    }
    EXPECT_GT(largest, 0.1);
    EXPECT_LT(largest, 0.4);
    EXPECT_LT(jump, 0.05);  // no click
  }
}

TEST(SoundSamples, RejectIsTheLowestAndDoneTheLongest) {
  const auto crossings_per_s = [](WizardSound sound) {
    const std::vector<float> samples = soundSamples(sound, kRate_Hz);
    int n = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) n += (samples[i - 1] < 0.0F) != (samples[i] < 0.0F);
    return n * kRate_Hz / static_cast<double>(samples.size());
  };
  const auto length = [](WizardSound sound) { return soundSamples(sound, kRate_Hz).size(); };
  for (const WizardSound sound : {WizardSound::ok, WizardSound::next, WizardSound::done})
    EXPECT_GT(crossings_per_s(sound), crossings_per_s(WizardSound::reject));
  for (const WizardSound sound : {WizardSound::ok, WizardSound::next, WizardSound::reject})
    EXPECT_GT(length(WizardSound::done), length(sound));
}

TEST_F(SoundsTest, WithoutASoundCardOneLineIsSaidAndNothingElse) {
  haveCards("pcm.!default { type hw card 99 }\npcm.other { type hw card 98 }\n");
  std::vector<std::string> told;
  testing::internal::CaptureStderr();
  {
    Sounds sounds([&](const std::string& line) { told.push_back(line); });
    EXPECT_FALSE(sounds.isAvailable());
    for (int n = 0; n < 100; ++n) sounds.play(WizardSound::ok);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("sound"), std::string::npos) << told[0];
}

/// Reads on, faster than it is written, until so many bytes were loud or far more silence than there is room for.
std::ptrdiff_t loudBytes(const std::filesystem::path& file, std::ptrdiff_t enough) {
  constexpr std::size_t kMost = 4'000'000'000;
  std::ifstream in(file, std::ios::binary);
  std::vector<char> bytes(1'000'000);
  std::ptrdiff_t loud = 0;
  for (std::size_t read = 0; read < kMost && loud < enough;) {
    in.clear();
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    loud += std::count_if(bytes.begin(), bytes.begin() + in.gcount(), [](char c) { return c != 0; });
    read += static_cast<std::size_t>(in.gcount());
    if (in.gcount() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return loud;
}

TEST_F(SoundsTest, WhatIsPlayedReachesTheCard) {
  const std::filesystem::path heard = folder_ / "heard.raw";
  haveCards("pcm.!default { type file slave.pcm nowhere file \"" + heard.string() +
            "\" format raw }\npcm.nowhere { type null }\n");
  testing::internal::CaptureStderr();
  {
    Sounds sounds([](const std::string& line) { ADD_FAILURE() << line; });
    ASSERT_TRUE(sounds.isAvailable());
    for (int n = 0; n < 100; ++n) sounds.play(WizardSound::reject);  // what does not fit is dropped, and nothing waits
    EXPECT_GE(loudBytes(heard, 1000), 1000);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace app
