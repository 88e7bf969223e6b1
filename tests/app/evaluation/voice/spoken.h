// Vowels as a throat makes them, for tests that need somebody to speak and have no speech: pulses at 110 to 150 Hz
// through three resonances, four syllables a second, a breath now and then. And files of it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "app/sound/flac_piece.h"

namespace tests {

inline std::vector<float> spoken(std::size_t seconds, std::uint32_t seed = 1) {
  constexpr double kRate_Hz = 48'000.0, kTurn = 6.283185307179586;
  constexpr std::array<std::array<double, 3>, 4> kVowels{
      {{730.0, 1090.0, 2440.0}, {270.0, 2290.0, 3010.0}, {570.0, 840.0, 2410.0}, {530.0, 1840.0, 2480.0}}};
  std::mt19937 random(seed);
  std::vector<float> made(seconds * 48'000);
  std::array<std::array<double, 2>, 3> past{};
  double phase = 0.0;
  std::size_t vowel = 0;
  for (std::size_t n = 0; n < made.size(); ++n) {
    if (n % 12'000 == 0) vowel = random() % kVowels.size();
    const double t_s = static_cast<double>(n) / kRate_Hz;
    const bool breathes = std::fmod(t_s, 5.0) > 4.5;
    const double syllable = breathes ? 0.0 : std::max(0.0, std::sin(kTurn * 2.0 * std::fmod(t_s, 0.25)));
    phase += (130.0 + 20.0 * std::sin(kTurn * 0.7 * t_s)) / kRate_Hz;
    double sound = 0.0;
    if (phase >= 1.0) phase -= 1.0, sound = 1.0;
    for (std::size_t k = 0; k < past.size(); ++k) {
      const double radius = std::exp(-3.1416 * 80.0 / kRate_Hz);
      const double wave = sound * 0.3 + 2.0 * radius * std::cos(kTurn * kVowels[vowel][k] / kRate_Hz) * past[k][0] -
                          radius * radius * past[k][1];
      past[k] = {wave, past[k][0]};
      sound = wave;
      if (k + 1 == past.size()) made[n] = static_cast<float>(syllable * wave);
    }
  }
  float loudest = 1e-6F;
  for (const float sample : made) loudest = std::max(loudest, std::abs(sample));
  for (float& sample : made) sample *= 0.5F / loudest;
  return made;
}

inline void writeSound(const std::string& path, const std::vector<float>& sound) {
  std::ofstream(path, std::ios::binary) << app::flacOf(sound, 48'000);
}

}  // namespace tests
