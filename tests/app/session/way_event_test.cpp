#include "app/session/way_event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mutants.h"

namespace app {
namespace {

WayOfPiece held(const std::string& piece = "crown") {
  return {
      piece, KeptIn::held, false, "", {{"distobuccal bone", 3.1, {1.0, -2.5, 3.0}}, {"tooth 47", 0.2, {4.0, 5.0, 6.0}}},
      3.3,   812};
}
WayOfPiece free(const std::string& piece = "crown") { return {piece, KeptIn::free, false, "up and back", {}, 0.0, 20}; }

TEST(WayEvent, ReadsBackWhatWasWritten) {
  WayRecord way{true, {held(), free("root")}};
  way.pieces[1].waits = true;
  EXPECT_EQ(wayFrom(wayText(way)), way);
  EXPECT_EQ(wayFrom(wayText({})), WayRecord{});
}

TEST(WayEvent, OtherWordsAreNone) {
  for (const char* const text : {"", "it is free", "{}", "[]", R"({"asked":true})", R"({"asked":true,"pieces":[1]})"})
    EXPECT_FALSE(wayFrom(text)) << text;
  const std::string good = wayText({true, {held()}});
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  };
  ASSERT_TRUE(wayFrom(good));
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"3.1,", "-3.1,"},
                                                                                 {"3.1,", "\"3\","},
                                                                                 {"3.1,", ""},
                                                                                 {"-2.5", "null"},
                                                                                 {"\"blocked\"", "\"stuck\""},
                                                                                 {"\"asked\":true", "\"asked\":1"},
                                                                                 {"\"poses\":812", "\"poses\":-1"},
                                                                                 {"\"mm3\":3.3", "\"mm3\":-3.3"},
                                                                                 {"\"lift\"", "\"drop\""}})
    EXPECT_FALSE(wayFrom(spoilt(from, to))) << to;
}

TEST(WayEventMutants, AreReadOrRefused) {
  mutants::forEachMutant({wayText({true, {held(), free("root")}})}, 500,
                         [](const std::string& text, std::size_t, std::uint64_t) {
                           if (const auto way = wayFrom(text)) {
                             EXPECT_LE(way->pieces.size(), kMostWays);
                             EXPECT_EQ(wayInWords(*way).empty(), way->pieces.empty());
                           }
                         });
}

TEST(WayEvent, SaysWhatHoldsTheNextPieceAndWhatComesAfterIt) {
  EXPECT_EQ(wayInWords({}), "");
  EXPECT_EQ(wayInWords({false, {held()}}), "distobuccal bone holds the crown: 3.1 mm³");
  EXPECT_EQ(wayInWords({false, {held(), held("root")}}),
            "distobuccal bone holds the crown: 3.1 mm³; the root after it");
  EXPECT_EQ(wayInWords({false, {free()}}), "the crown is free: lift it up and back");
  EXPECT_EQ(wayInWords({false, {free(), free("root")}}), "the crown is free: lift it up and back; the root after it");
  EXPECT_EQ(wayInWords({false, {free(), held("root")}}),
            "the crown is free: lift it up and back; then distobuccal bone holds the root: 3.1 mm³");
  WayOfPiece tight = free();
  tight.answer = KeptIn::tightly;
  EXPECT_EQ(wayInWords({false, {tight}}), "the crown comes out tightly: lift it up and back");
  WayOfPiece none = free("tooth");
  none.answer = KeptIn::not_found;
  none.poses = 4000;
  EXPECT_EQ(wayInWords({false, {none}}), "no way found for the tooth in 4000 poses");
}

TEST(WayEvent, TellsAllOfItWhereItIsOnManySides) {
  WayOfPiece piece = held("tooth");
  piece.kept_by = {{"distal bone", 30.0, {}}, {"buccal bone", 25.0, {}}, {"mesial bone", 24.0, {}}};
  piece.kept_by_mm3 = 79.0;
  EXPECT_EQ(wayInWords({false, {piece}}), "distal bone holds the tooth: 30.0 mm³, buccal bone 25.0 mm³, 79.0 in all");
}

TEST(WayEvent, TheNextKeptIsTheFirstThatDoesNotComeOut) {
  EXPECT_EQ(nextKept({false, {free(), free("root")}}), nullptr);
  const WayRecord way{false, {free(), held("root")}};
  ASSERT_NE(nextKept(way), nullptr);
  EXPECT_EQ(nextKept(way)->piece, "root");
}

}  // namespace
}  // namespace app
