#include "app/evaluation/console/page_words.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/mutants.h"

namespace app {
namespace {

const std::string kPageNote =
    R"({"kind":"event","role":"evaluator","page":"a-1","session":"77","seq":3,"type":"note","t_ns":123456789012345,)"
    R"("rtt_ms":4.5,"data":{"kind":"behaviour","text":"looks up","severity":2,"task":"other"}})";

TEST(PageWords, TextsComeOutAsTheyWentInHoweverTheBytesAreCut) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::string> texts;
    std::string bytes;
    for (unsigned n = 0; n < 1 + random() % 5; ++n) {
      texts.push_back(std::string(1 + random() % 300, static_cast<char>('a' + n)));
      bytes += framed(texts.back());
    }
    FrameReader reader(1000);
    std::vector<std::string> found;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = std::min<std::size_t>(1 + random() % 50, bytes.size() - at);
      ASSERT_TRUE(reader.add({bytes.data() + at, size}));
      at += size;
      while (auto text = reader.next()) found.push_back(*text);
    }
    EXPECT_EQ(found, texts);
  }
}

TEST(PageWords, ATextThatIsTooLongOrEmptyIsNonsense) {
  for (const std::string& bytes : {framed(std::string(11, 'x')), framed(""), std::string("\xff\xff\xff\xff")}) {
    FrameReader reader(10);
    EXPECT_FALSE(reader.add({bytes.data(), bytes.size()}));
    const std::string good = framed("x");
    EXPECT_FALSE(reader.add({good.data(), good.size()}));
  }
}

TEST(PageWords, AnEventCarriesWhatItsTypeHasAndNoMore) {
  const auto word = pageWordFrom(kPageNote);
  ASSERT_TRUE(word);
  const auto& said = std::get<PageEvent>(*word);
  EXPECT_EQ(said.page, "a-1");
  EXPECT_EQ(said.session, "77");
  EXPECT_EQ(said.number, 3u);
  EXPECT_EQ(said.round_trip_ms, 4.5);
  EXPECT_EQ(said.event.source, "evaluator");
  EXPECT_EQ(said.event.t_ns, 123456789012345);
  EXPECT_EQ(said.event.textOr("text"), "looks up");
  EXPECT_EQ(said.event.number("severity"), 2.0);
  EXPECT_EQ(said.event.text("task"), nullptr);
}

TEST(PageWords, WhatIsNoMessageIsTold) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kPageNote;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_FALSE(pageWordFrom(with("\"seq\":3", "\"seq\":0")));
  EXPECT_FALSE(pageWordFrom(with("\"seq\":3", "\"seq\":-3")));
  EXPECT_FALSE(pageWordFrom(with("\"seq\":3", "\"seq\":1e30")));
  EXPECT_FALSE(pageWordFrom(with("a-1", "a/1")));
  EXPECT_FALSE(pageWordFrom(with("evaluator", "system")));
  EXPECT_FALSE(pageWordFrom(with("note", "session.stop")));
  EXPECT_FALSE(pageWordFrom(with("123456789012345", "1e300")));
  EXPECT_FALSE(pageWordFrom(with("\"looks up\"", "[1]")));
  EXPECT_FALSE(pageWordFrom(with("looks up", std::string(5000, 'x'))));
  EXPECT_FALSE(pageWordFrom(std::string(100'000, '[')));
  EXPECT_FALSE(pageWordFrom("{}"));
  EXPECT_FALSE(pageWordFrom(R"({"kind":"alive","pages":-1})"));
  EXPECT_TRUE(pageWordFrom(R"({"kind":"alive","pages":2})"));
}

TEST(PageWords, ADebriefIsSteeredByFiveWordsWithinTheirBounds) {
  const auto steered = [](const std::string& what, const std::string& value) {
    const auto word = pageWordFrom(R"({"kind":"steer","what":")" + what + R"(","value":)" + value + "}");
    return word ? std::optional(std::get<PageSteers>(*word)) : std::nullopt;
  };
  EXPECT_EQ(steered("seek", "12.5")->value, 12.5);
  EXPECT_EQ(steered("seek", "12.5")->what, DebriefSteer::seek);
  EXPECT_EQ(steered("scrub", "0")->what, DebriefSteer::scrub);
  EXPECT_EQ(steered("play", "null")->what, DebriefSteer::play);
  EXPECT_EQ(steered("pause", "[7]")->value, 0.0);
  EXPECT_EQ(steered("speed", "0.25")->value, 0.25);
  for (const auto& [what, value] : {std::pair("seek", "-0.1"), std::pair("seek", "null"), std::pair("seek", "\"3\""),
                                    std::pair("seek", "1e300"), std::pair("scrub", "200000"), std::pair("speed", "0"),
                                    std::pair("speed", "4.1"), std::pair("fly", "1"), std::pair("", "1")})
    EXPECT_FALSE(steered(what, value)) << what << " " << value;
  EXPECT_FALSE(pageWordFrom(R"({"kind":"steer","what":4,"value":1})"));
  EXPECT_FALSE(pageWordFrom(R"({"kind":"steer"})"));
}

TEST(PageWordsMutants, DamagedMessagesAreReadOrRefused) {
  std::size_t understood = 0;
  mutants::forEachMutant({kPageNote, framed(kPageNote)}, 5000,
                         [&](const std::string& text, std::size_t, std::uint64_t) {
                           if (const auto word = pageWordFrom(text); word && std::holds_alternative<PageEvent>(*word)) {
                             const auto& said = std::get<PageEvent>(*word);
                             ++understood;
                             EXPECT_TRUE(isPageId(said.page));
                             EXPECT_GT(said.number, 0u);
                             EXPECT_LE(said.event.data.size(), 3u);
                           }
                           FrameReader reader(kMostUp);
                           reader.add({text.data(), text.size()});
                           while (const auto one = reader.next()) pageWordFrom(*one);
                         });
  EXPECT_GT(understood, 0u);
}

}  // namespace
}  // namespace app
