#include "app/evaluation/voice/voice_words.h"

#include <cstring>

#include "tests/mutants.h"

namespace app {
namespace {

std::optional<VoiceWord> sent(const VoiceWord& word, std::size_t bytes = sizeof(VoiceWord)) {
  std::array<std::byte, sizeof(VoiceWord) + 8> datagram{};
  std::memcpy(datagram.data(), &word, sizeof word);
  return voiceWordFrom(std::span(datagram).first(bytes));
}

TEST(VoiceWord, ArrivesAsItWasSent) {
  const auto word = sent({.kind = VoiceWord::Kind::level, .t_ns = -3, .number = 7, .value = -31.5});
  ASSERT_TRUE(word);
  EXPECT_EQ(word->t_ns, -3);
  EXPECT_EQ(word->number, 7u);
  EXPECT_DOUBLE_EQ(word->value, -31.5);
}

TEST(VoiceWord, WhatCannotBeIsNone) {
  EXPECT_FALSE(sent({}, sizeof(VoiceWord) - 1));
  EXPECT_FALSE(sent({}, sizeof(VoiceWord) + 1));
  EXPECT_FALSE(sent({.mark = 1}));
  EXPECT_FALSE(sent({.kind = static_cast<VoiceWord::Kind>(0)}));
  EXPECT_FALSE(sent({.kind = static_cast<VoiceWord::Kind>(99)}));
  EXPECT_FALSE(sent({.value = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(sent({.kind = VoiceWord::Kind::trouble, .number = 3}));
  EXPECT_FALSE(sent({.kind = VoiceWord::Kind::figure, .number = static_cast<std::uint64_t>(VoiceFigure::count)}));
  for (const auto trouble : {VoiceTrouble::no_microphone, VoiceTrouble::disk, VoiceTrouble::sound})
    EXPECT_FALSE(textOf(trouble).empty());
}

TEST(VoiceWordMutants, AreNoneOrWordsThatCanBe) {
  const VoiceWord good{.kind = VoiceWord::Kind::level, .t_ns = 5'000'000'000, .number = 1200, .value = -31.5};
  const std::string bytes(reinterpret_cast<const char*>(&good), sizeof good);
  mutants::forEachMutant({bytes}, 5000, [&](const std::string& mutant, std::size_t, std::uint64_t) {
    const auto word = voiceWordFrom(std::as_bytes(std::span(mutant.data(), mutant.size())));
    if (!word) return;
    EXPECT_TRUE(std::isfinite(word->value));
    EXPECT_TRUE(word->kind >= VoiceWord::Kind::began && word->kind <= VoiceWord::Kind::end);
    EXPECT_TRUE(word->kind != VoiceWord::Kind::figure || word->number < static_cast<std::uint64_t>(VoiceFigure::count));
  });
}

}  // namespace
}  // namespace app
