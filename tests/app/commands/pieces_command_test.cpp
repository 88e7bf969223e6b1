#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/session/replay.h"
#include "assets/ct_volume.h"
#include "assets/scan/image_file.h"
#include "assets/scan/tooth_division.h"
#include "tests/app/commands/program.h"
#include "tests/haptics/tooth_phantom.h"

namespace app {
namespace {

using haptics::phantom::bridged;
using haptics::phantom::fill;
using haptics::phantom::ToothPhantom;

class PiecesCommand : public ProgramTest {
 protected:
  /// Options for a volume of this solid in which `is_tooth` has label 5.
  std::string volume(const ToothPhantom& solid, const ToothPhantom& is_tooth) const {
    std::vector<std::uint8_t> label(is_tooth.solid.size());
    std::ranges::transform(is_tooth.solid, label.begin(),
                           [](std::uint8_t byte) { return static_cast<std::uint8_t>(byte >= 128 ? 5 : 0); });
    const auto store = [&](const std::string& name, const std::vector<std::uint8_t>& values) {
      calibration::OutputFile out = assets::nrrdOutput(at(name), true);
      assets::writeSolid(solid.grid, values, out);
    };
    store("s.nrrd", solid.solid);
    store("l.nrrd", label);
    return "pieces --volume " + at("s.nrrd") + " --field solid --labels " + at("l.nrrd") + " ";
  }
  nlohmann::json answer(const std::string& arguments) const {
    const ProgramOutput said = molar(arguments + "--json");
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }
};

TEST_F(PiecesCommand, ABridgeHasItsAreaWidthThicknessAndNormal) {
  const ToothPhantom whole = bridged(0.3, 0.0, 1.5, 6.0, false), now = bridged(0.3, 0.0, 1.5, 6.0, true);
  for (const ToothPhantom& labelled : {whole, now}) {  // labels of the tooth as scanned, and of what is left
    const nlohmann::json said = answer(volume(now, labelled));
    ASSERT_EQ(said.at("pieces").size(), 1u);
    ASSERT_EQ(said.at("bridges").size(), 1u);
    const nlohmann::json& bridge = said.at("bridges")[0];
    EXPECT_NEAR(bridge.at("area_mm2").get<double>(), 9.0, 0.45);
    EXPECT_NEAR(bridge.at("width_mm").get<double>(), 6.0, 0.3);
    EXPECT_NEAR(bridge.at("thickness_mm").get<double>(), 1.5, 0.3);
    EXPECT_NEAR(std::abs(bridge.at("normal_P")[2].get<double>()), 1.0, 1e-3);
    EXPECT_NE(bridge.at("between")[0], bridge.at("between")[1]);
  }
}

TEST_F(PiecesCommand, FivePartsAreFivePiecesByVolume) {
  ToothPhantom whole({120, 20, 20}, 0.2);
  fill(whole, {1, 1, 1}, {119, 19, 19});
  ToothPhantom now = whole;
  for (int n = 1; n < 5; ++n) fill(now, {n * 22, 0, 0}, {n * 22 + 4, 20, 20}, 0);
  const nlohmann::json said = answer(volume(now, whole));
  ASSERT_EQ(said.at("pieces").size(), 5u);
  EXPECT_EQ(said.at("bridges").size(), 0u);
  EXPECT_NEAR(said.at("pieces")[0].at("volume_mm3").get<double>(), 27 * 18 * 18 * 0.008, 1e-6);
  const ProgramOutput words = molar(volume(now, whole));
  EXPECT_EQ(words.status, 0);
  EXPECT_NE(words.out.find("volume mm³"), std::string::npos) << words.out;
}

TEST_F(PiecesCommand, WritesEachPieceAsASurface) {
  ToothPhantom whole({60, 20, 20}, 0.2);
  fill(whole, {1, 1, 1}, {59, 19, 19});
  ToothPhantom now = whole;
  fill(now, {26, 0, 0}, {30, 20, 20}, 0);
  const std::string pieces = volume(now, whole), folder = at("pieces");
  const nlohmann::json said = answer(pieces + "--out " + folder + " ");
  ASSERT_EQ(said.at("pieces").size(), 2u);
  EXPECT_EQ(said.at("pieces")[0].at("place"), "in place");
  ASSERT_EQ(said.at("files").size(), 2u);
  for (const auto& file : said.at("files")) {
    // Two triangles of 50 bytes a face of a voxel and more, behind 84 bytes.
    const auto size = std::filesystem::file_size(file.get<std::string>());
    EXPECT_GT(size, 84u + 50u * 1000u);
    EXPECT_EQ((size - 84u) % 50u, 0u);
  }
  EXPECT_EQ(molar(pieces + "--out " + folder).status, 2) << "nothing is replaced";
  EXPECT_EQ(molar(pieces + "--out " + folder + " --force").status, 0);
  EXPECT_EQ(molar(pieces + "--out " + at("both.glb")).status, 0);
  EXPECT_GT(std::filesystem::file_size(at("both.glb")), 1000u);
  expectRefusal(pieces + "--out " + at("pieces.obj"), "--out");
  expectRefusal(pieces + "--exit 0,0,1 --out " + at("other.stl"), "--exit");
  expectRefusal(pieces + "--force", "--force");
}

/// A tooth of 5 x 5 x 5 mm in a well of bone, with or without a lid of 1 mm.
TEST_F(PiecesCommand, SaysWhetherAPieceCanComeOutAndWhatIsInTheWay) {
  ToothPhantom tooth({60, 60, 90}, 0.25), solid = tooth;
  fill(tooth, {20, 20, 10}, {40, 40, 30});
  fill(solid, {0, 0, 0}, {60, 60, 32});
  fill(solid, {18, 18, 8}, {42, 42, 32}, 0);
  fill(solid, {20, 20, 10}, {40, 40, 30});
  const nlohmann::json open = answer(volume(solid, tooth)).at("free");
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].at("answer"), "free");
  EXPECT_EQ(open[0].at("piece"), 0);
  EXPECT_NEAR(open[0].at("path_mm").get<double>(), 12.0, 0.8);
  EXPECT_TRUE(open[0].at("blocked_mm3_by_label").empty());

  fill(solid, {0, 0, 32}, {60, 60, 36});
  const nlohmann::json closed = answer(volume(solid, tooth)).at("free")[0];
  EXPECT_EQ(closed.at("answer"), "blocked");
  EXPECT_NEAR(closed.at("blocked_mm3_by_label").at("unlabelled").get<double>(), 25.0, 8.0);
  EXPECT_NE(molar(volume(solid, tooth)).out.find("hard tissue"), std::string::npos);

  const nlohmann::json below = answer(volume(solid, tooth) + "--exit 0,0,-1 ").at("free")[0];
  EXPECT_EQ(below.at("answer"), "blocked");
  expectRefusal(volume(solid, tooth) + "--exit 0,0,0", "--exit");
}

TEST_F(PiecesCommand, RefusesWhatHoldsNoTooth) {
  ToothPhantom block({20, 20, 20}, 0.2), none({20, 20, 20}, 0.2), one({20, 20, 20}, 0.2);
  fill(block, {2, 2, 2}, {18, 18, 18});
  fill(one, {9, 9, 9}, {10, 10, 10});
  expectRefusal(volume(block, none), "no third molar is labelled");
  expectRefusal(volume(block, block) + "--tooth 48", "--tooth 48");
  expectRefusal("pieces --volume " + at("s.nrrd") + " --field solid", "--labels");
  expectRefusal("pieces", "exactly one");
  expectRefusal("pieces " + at("nothing.molar"), "nothing.molar");
  const ProgramOutput tiny = molar(volume(block, one));
  EXPECT_EQ(tiny.status, 2);
  EXPECT_NE(tiny.err.find("0.008 mm³"), std::string::npos) << tiny.err;
}

TEST_F(PiecesCommand, TheUncutToothOfASessionIsOnePiece) {
  const std::string session = at("s.molar");
  const ProgramOutput ran = molar(
      "rehearse --headless --pace fast --device scripted --voxel 0.6 --size 96x64 --seconds 0.2 --record " + session);
  ASSERT_EQ(ran.status, 0) << ran.err;
  const nlohmann::json said = answer("pieces " + session + " ");
  ASSERT_EQ(said.at("pieces").size(), 1u);
  EXPECT_EQ(said.at("bridges").size(), 0u);
  const double volume_mm3 = said.at("pieces")[0].at("volume_mm3").get<double>() + said.at("cut_mm3").get<double>();
  EXPECT_GT(volume_mm3, 300.0);
  // As the servo has it, which divides the voxels that it shares with the bone; by its labels it is smaller.
  const StoredStart start = boneAtTime(session, std::nullopt).start;
  const assets::ToothDivision divided = assets::divideByTooth(start.grid, start.solid, start.label, start.is_tooth);
  const auto solid = [](std::uint8_t byte) { return byte >= assets::kHalfSolid; };
  const auto share = static_cast<double>(std::ranges::count_if(divided.tooth.solid, solid));
  double labelled = 0.0;
  for (std::size_t v = 0; v < start.solid.size(); ++v)
    labelled += start.is_tooth[v] != 0 && solid(start.solid[v]) ? 1.0 : 0.0;
  EXPECT_NEAR(volume_mm3, share * start.grid.voxelVolume_mm3(), 1e-6 * volume_mm3);
  EXPECT_GT(std::abs(labelled * start.grid.voxelVolume_mm3() - volume_mm3), 0.02 * volume_mm3);
}

}  // namespace
}  // namespace app
