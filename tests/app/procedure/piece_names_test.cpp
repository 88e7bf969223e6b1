#include "app/procedure/piece_names.h"

#include <gtest/gtest.h>

namespace app {
namespace {

using Names = std::vector<std::string>;

/// A lower right third molar: distal is backwards, buccal to the right, up is up.
const ArchFrame kArch{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};

Names named(const std::vector<SeenPiece>& pieces, bool is_whole = false) {
  return pieceNames(pieces, {0, 0, 0}, is_whole, kArch);
}

TEST(PieceNames, AWholeToothIsTheTooth) {
  EXPECT_EQ(named({{1.0, {0, 0, 0}}}, true), Names{"tooth"});
  EXPECT_EQ(named({{1.0, {0, 0, 3}}}), Names{"crown"}) << "what is left of it is not";
}

TEST(PieceNames, TheCrownHasTheEnamelAndRootsHaveNone) {
  EXPECT_EQ(named({{0.95, {0, 0, 4}}, {0.05, {0, 0, -4}}}), (Names{"crown", "root"}));
  EXPECT_EQ(named({{0.98, {0, 0, 4}}, {0.0, {0, 3, -4}}, {0.02, {0, -2, -4}}}),
            (Names{"crown", "distal root", "mesial root"}));
}

TEST(PieceNames, HalvesAreNamedByTheirSide) {
  EXPECT_EQ(named({{0.55, {0, -3, 0}}, {0.45, {0, 3, 0}}}), (Names{"mesial half", "distal half"}));
  EXPECT_EQ(named({{0.45, {0, 3, 1}}}), Names{"distal half"}) << "the other is out";
  EXPECT_EQ(named({{0.5, {-3, 0, 0}}, {0.5, {3, 0, 0}}}), (Names{"buccal half", "lingual half"}));
}

TEST(PieceNames, NoTwoPiecesHaveTheSameName) {
  const Names names = named({{0.3, {0, 3, 0}}, {0.3, {0, 4, 0}}, {0.4, {0, -4, 0}}});
  EXPECT_NE(names[0], names[1]);
}

TEST(PieceNames, WithoutLabelsOrAnArchTheyAreNumberedOrNamedByPlace) {
  const std::vector<SeenPiece> pieces = {{{}, {0, 0, 4}}, {{}, {0, 0, -4}}};
  EXPECT_EQ(named(pieces), (Names{"upper part", "lower part"}));
  EXPECT_EQ(pieceNames(pieces, {0, 0, 0}, false, {}), (Names{"piece 1", "piece 2"}));
}

TEST(PieceNames, TheWayOutIsSaidInADentistsDirections) {
  EXPECT_EQ(liftInWords({0, 0, 5}, 0.0, kArch), "up");
  EXPECT_EQ(liftInWords({0, 3, 4}, 0.0, kArch), "up and back");
  EXPECT_EQ(liftInWords({0, -3, 4}, 0.0, kArch), "up and forward");
  EXPECT_EQ(liftInWords({-3, 1, 4}, 0.5, kArch), "up and to the cheek, turning it");
  EXPECT_EQ(liftInWords({3, 0, 4}, 0.0, kArch), "up and to the tongue");
  EXPECT_EQ(liftInWords({0, 0, 0}, 0.0, kArch), "");
}

}  // namespace
}  // namespace app
