#include "app/procedure/ways_out.h"

#include <gtest/gtest.h>

#include "assets/tissue.h"
#include "tests/haptics/tooth_phantom.h"

namespace app {
namespace {

using haptics::phantom::fill;
using haptics::phantom::ToothPhantom;

constexpr double kVoxel_mm = 0.25;

/// A block of bone of 20 x 20 x 12 mm at the bottom of the scan, a well in it, and two stacked pieces of 5 x 5 x 4 mm.
struct Scan {
  ToothPhantom bone{{80, 80, 110}, kVoxel_mm}, tooth = bone;
  std::vector<std::uint8_t> label, number;

  Scan() {
    fill(bone, {0, 0, 0}, {80, 80, 48});
    fill(bone, {28, 28, 12}, {52, 52, 110}, 0);
    fill(tooth, {30, 30, 12}, {50, 50, 28});
    fill(tooth, {30, 30, 30}, {50, 50, 46});
  }
  std::vector<PieceWay> ways(const WayUp& up = {}) {
    label.assign(bone.solid.size(), static_cast<std::uint8_t>(assets::Tissue::cortical));
    const haptics::Components pieces(tooth.grid, tooth.solid);
    return waysOut({bone.grid, bone.solid, label, number}, pieces, pieces.pieces().size(), up);
  }
};

WayUp withArch() { return {{0, 0, 1}, ArchFrame{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}; }

TEST(WaysOut, TheUpperPieceComesBeforeTheLower) {
  Scan scan;
  const std::vector<PieceWay> ways = scan.ways();
  ASSERT_EQ(ways.size(), 2u);
  EXPECT_EQ(ways[0].way.answer, haptics::WayOutAnswer::free);
  EXPECT_EQ(ways[1].way.answer, haptics::WayOutAnswer::free);
  EXPECT_TRUE(ways[0].after.empty());
  ASSERT_EQ(ways[1].after, std::vector<std::size_t>{ways[0].piece});
  const haptics::Components pieces(scan.tooth.grid, scan.tooth.solid);
  EXPECT_GT(pieces.pieces()[ways[0].piece].centroid_mm.z, pieces.pieces()[ways[1].piece].centroid_mm.z);
  EXPECT_NE(wordsOf(ways[1]).find("once piece "), std::string::npos);
}

TEST(WaysOut, ALidOfBoneIsNamedByItsPlace) {
  Scan scan;
  fill(scan.bone, {40, 28, 48}, {52, 52, 56});  // over the half to the cheek, thick; it leaves no room beside it
  const std::vector<PieceWay> ways = scan.ways(withArch());
  ASSERT_EQ(ways.size(), 2u);
  const PieceWay& upper = ways[0].way.in_the_way_mm3 < ways[1].way.in_the_way_mm3 ? ways[0] : ways[1];
  ASSERT_EQ(upper.way.answer, haptics::WayOutAnswer::blocked);
  double all_mm3 = 0.0, to_the_cheek_mm3 = 0.0;
  for (const InTheWay& one : upper.in_the_way) {
    EXPECT_TRUE(one.words.ends_with(" bone")) << one.words;
    all_mm3 += one.volume_mm3;
    if (one.words.find("buccal") != std::string::npos || one.words.starts_with("overlying"))
      to_the_cheek_mm3 += one.volume_mm3;
  }
  ASSERT_EQ(upper.in_the_way_mm3_by_label.size(), 1u);
  EXPECT_NEAR(upper.in_the_way_mm3_by_label.at("cortical"), all_mm3, 1e-9);
  EXPECT_NEAR(all_mm3, upper.way.in_the_way_mm3, 1e-9);
  EXPECT_GT(to_the_cheek_mm3, 0.8 * all_mm3);
  EXPECT_NE(wordsOf(upper).find("mm³"), std::string::npos);
}

TEST(WaysOut, ATakenAwayLidLeavesItFree) {
  Scan scan;
  fill(scan.bone, {28, 28, 48}, {52, 52, 52});
  const std::vector<PieceWay> ways = scan.ways();
  EXPECT_FALSE(ways[0].way.in_the_way.empty());
  fill(scan.bone, {28, 28, 48}, {52, 52, 52}, 0);
  EXPECT_EQ(scan.ways()[0].way.answer, haptics::WayOutAnswer::free);
}

TEST(WaysOut, AToothInTheWayIsCalledByItsNumber) {
  Scan scan;
  fill(scan.bone, {28, 28, 48}, {52, 52, 60});
  scan.number.assign(scan.bone.solid.size(), 0);
  assets::forVoxels({28, 28, 48}, {52, 52, 60}, [&](glm::ivec3 ijk) { scan.number[scan.bone.grid.index(ijk)] = 47; });
  bool is_named = false;
  for (const PieceWay& one : scan.ways(withArch()))
    for (const InTheWay& what : one.in_the_way)
      is_named = is_named || (what.words == "tooth 47" && one.in_the_way_mm3_by_label.contains("tooth_47"));
  EXPECT_TRUE(is_named);
}

}  // namespace
}  // namespace app
