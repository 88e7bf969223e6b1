// `molar rehearse --task preparation --cavity ready`: a cavity that is filled by poses, its measures, and what is
// refused.
#include <algorithm>
#include <utility>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "app/session/replay.h"
#include "app/session/session_moments.h"
#include "app/session/session_reader.h"
#include "assets/scan/image_file.h"
#include "tests/app/commands/program.h"

namespace app {
namespace {

/// A hand in the frame of a tooth, its instrument upright.
struct FillingHand {
  assets::ToothFrame frame;
  std::string rows = "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill,tool\n";
  double t_s = 0.0;
  glm::dvec3 at_mm{0.0, 0.0, 14.0};

  void row(const glm::dvec3& p_mm, bool works, const std::string& tool) {
    const glm::dvec3 p_P = frame.inP(p_mm);
    const glm::dquat turn(glm::dvec3(0.0, 0.0, 1.0), frame.axes_P[2]);
    rows += fmt::format("{:.4f},{:.5f},{:.5f},{:.5f},{:.7f},{:.7f},{:.7f},{:.7f},{:d},{}\n", t_s, p_P.x, p_P.y, p_P.z,
                        turn.w, turn.x, turn.y, turn.z, works ? 1 : 0, tool);
  }
  void go(const glm::dvec3& to_mm, double seconds, bool works = false, const std::string& tool = "") {
    constexpr int kRows = 20;
    for (int n = 1; n <= kRows; ++n) {
      t_s += seconds / kRows;
      row(glm::mix(at_mm, to_mm, static_cast<double>(n) / kRows), works, n == 1 ? tool : "");
    }
    at_mm = to_mm;
  }
};

class FillingCommand : public ProgramTest {
 protected:
  ProgramOutput fill(const std::string& hand, const std::string& more) const {
    return molar("rehearse --task preparation --tooth 45 --ideal class-1 --cavity ready --headless --pace fast " +
                 more + " --device poses:" + hand);
  }
  nlohmann::json measuresOf(const std::string& session) const {
    return nlohmann::json::parse(molar("metrics " + at(session) + " --json").out).at("preparation");
  }
};

TEST_F(FillingCommand, TellsWhatAFillingHasComeToAndReplaysItBitForBit) {
  FillingHand away;
  away.frame.axes_P = glm::dmat3(1.0);
  away.go({0.0, 0.0, 200.0}, 0.2);
  ASSERT_EQ(fill(write("far.csv", away.rows), "--record " + at("far.molar")).status, 0);
  const nlohmann::json ready = measuresOf("far.molar");
  // Cut to its ideal, against the tooth as it was.
  EXPECT_NEAR(ready.at("P1_under_mm3").get<double>(), 0.0, 0.05);
  EXPECT_NEAR(ready.at("P1_over_mm3").get<double>(), 0.0, 0.05);
  EXPECT_GT(ready.at("P9_depth_mm").get<double>(), 1.0);
  EXPECT_FALSE(ready.contains("filling"));

  FillingHand hand;
  hand.frame = SessionReader(at("far.molar")).about().setup.prepared->frame;
  hand.go({0.0, 0.0, 9.0}, 0.3, false, "composite");
  for (const double height_mm : {3.0, 3.5, 4.0})  // the floor holds it off
    for (const double x_mm : {-1.2, 1.2}) hand.go({x_mm, 0.0, height_mm}, 0.35, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  hand.go({0.0, 0.0, 4.5}, 0.4, false, "plugger");
  hand.go({0.8, 0.0, 4.5}, 0.4, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  hand.go({0.0, 0.0, 10.5}, 0.3, false, "curing-lamp");
  hand.go({0.0, 0.0, 10.4}, 11.5, true);
  hand.go({0.0, 0.0, 14.0}, 0.3);
  hand.go({0.0, 0.0, 9.0}, 0.3, false, "composite");
  hand.go({0.3, 0.0, 4.0}, 0.4, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  const ProgramOutput said = fill(write("hand.csv", hand.rows), "--record " + at("s.molar"));
  ASSERT_EQ(said.status, 0) << said.err;
  const ProgramOutput replayed = molar("replay " + at("s.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  EXPECT_NE(replayed.out.find("bit-identical"), std::string::npos) << replayed.out << replayed.err;

  const nlohmann::json of = measuresOf("s.molar").at("filling");
  EXPECT_GT(of.at("F1_laid_mm3").get<double>(), 2.0);
  EXPECT_GT(of.at("F2_filled_share").get<double>(), 0.2);
  EXPECT_LE(of.at("F2_filled_share").get<double>(), 1.0);
  EXPECT_GT(of.at("F7_cured_share").get<double>(), 0.4);
  EXPECT_LT(of.at("F7_cured_share").get<double>(), 1.0);
  ASSERT_EQ(of.at("F6_increments").size(), 2U);
  EXPECT_GT(of.at("F1_materials_mm3").at("composite").get<double>(), 0.5);
  EXPECT_GT(of.at("F1_materials_mm3").at("composite_soft").get<double>(), 0.1);
  const ProgramOutput reported = molar("report " + at("s.molar") + " --out " + at("s.html"));
  ASSERT_EQ(reported.status, 0) << reported.err;
  EXPECT_NE(read("s.html").find("F2 share of the cavity filled"), std::string::npos);
}

/// Composite that is laid, lit for six seconds and left.
void layAndLeave(FillingHand& hand) {
  hand.go({0.0, 0.0, 9.0}, 0.3, false, "composite");
  for (const double x_mm : {-1.2, 1.2}) hand.go({x_mm, 0.0, 3.5}, 0.35, true);
  hand.go({0.0, 0.0, 14.0}, 0.4);
  hand.go({0.0, 0.0, 10.5}, 0.3, false, "curing-lamp");
  hand.go({0.0, 0.0, 10.4}, 6.0, true);
  hand.go({0.0, 0.0, 14.0}, 0.3);
}

TEST_F(FillingCommand, AFilledSessionIsGoneOnWith) {
  FillingHand hand;
  hand.frame.axes_P = glm::dmat3(1.0);
  hand.go({0.0, 0.0, 200.0}, 0.2);
  ASSERT_EQ(fill(write("far.csv", hand.rows), "--record " + at("far.molar")).status, 0);
  hand = {};
  hand.frame = SessionReader(at("far.molar")).about().setup.prepared->frame;
  layAndLeave(hand);
  ASSERT_EQ(fill(write("first.csv", hand.rows), "--record " + at("first.molar")).status, 0);
  const nlohmann::json first = measuresOf("first.molar");
  EXPECT_EQ(first.at("filling").at("F7_cured_share").get<double>(), 0.0);

  FillingHand more;
  more.frame = hand.frame;
  // The light that it had counts; then something is carved away and laid again.
  more.go({0.0, 0.0, 10.5}, 0.3, false, "curing-lamp");
  more.go({0.0, 0.0, 10.4}, 5.5, true);
  more.go({0.0, 0.0, 14.0}, 0.3);
  more.go({1.2, 0.0, 5.0}, 0.4, false, "carver");
  more.go({-1.2, 0.0, 4.0}, 1.0, true);
  more.go({0.0, 0.0, 14.0}, 0.3);
  more.go({0.0, 0.0, 6.0}, 0.4, false, "composite");
  more.go({0.3, 0.0, 4.0}, 0.4, true);
  more.go({0.0, 0.0, 14.0}, 0.3);
  const ProgramOutput said = molar("rehearse --headless --pace fast --continue " + at("first.molar") + " --record " +
                                   at("next.molar") + " --device poses:" + write("next.csv", more.rows));
  ASSERT_EQ(said.status, 0) << said.err;
  const ProgramOutput replayed = molar("replay " + at("next.molar") + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
  EXPECT_NE(replayed.out.find("bit-identical"), std::string::npos) << replayed.out << replayed.err;

  // It began as the first one ended, and undo does not go behind that.
  SessionReader former(at("first.molar")), session(at("next.molar"));
  const StoredStart start = session.start();
  const auto left = former.finalFilling(former.start());
  ASSERT_TRUE(start.laid && left);
  EXPECT_TRUE(start.laid->laid == left->laid && start.laid->tissue == left->tissue);
  EXPECT_TRUE(start.laid->increment == left->increment && start.laid->light == left->light);
  EXPECT_FALSE(start.laid->light.empty());
  ASSERT_EQ(start.laid->age_s.size(), 1U);
  EXPECT_GT(start.laid->age_s[0], 6.0);
  EXPECT_EQ(former.finalBone(former.start())->digest, start.setup.former->bone_digest);
  haptics::Tick last;
  bool is_first = true;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    if (std::exchange(is_first, false)) {
      EXPECT_EQ(block.ticks.front().bone_digest, start.setup.former->bone_digest);
      EXPECT_EQ(block.ticks.front().strokes, 0);
    }
    last = block.ticks.back();
  }
  // What is told agrees with what was there, live and at any moment.
  const nlohmann::json of = measuresOf("next.molar").at("filling");
  EXPECT_NEAR(of.at("F1_laid_mm3").get<double>(), last.filling.total_mm3, 1e-9);
  EXPECT_NEAR(of.at("F1_materials_mm3").at("composite").get<double>(), last.filling.cured_mm3, 1e-9);
  EXPECT_GT(of.at("F7_cured_share").get<double>(), 0.3);
  EXPECT_EQ(of.at("F2_cavity_mm3"), first.at("filling").at("F2_cavity_mm3")) << "of the tooth as it was";
  EXPECT_EQ(of.at("F6_increments").size(), 2U);
  SessionMoments moments(at("next.molar"));
  while (moments.index(5.0)) continue;
  EXPECT_FALSE(moments.difference());
  for (const double t_s : {3.0, 0.1, 8.5}) {
    moments.goTo(t_s);
    EXPECT_EQ(moments.bodies().digest(), replayTo(session, t_s).bodies.digest()) << t_s;
  }
  // In volumes: as solid as the tooth, and of its material.
  ASSERT_EQ(molar("replay " + at("next.molar") + " --volume " + at("v.nrrd") + " --labels " + at("l.nrrd")).status, 0);
  ASSERT_EQ(molar("replay " + at("far.molar") + " --volume " + at("before.nrrd")).status, 0);
  const assets::ByteImage solid = assets::readSolid(at("v.nrrd")), label = assets::readLabels(at("l.nrrd")),
                          before = assets::readSolid(at("before.nrrd"));
  const auto laid = session.finalFilling(start);
  double steps = 0.0;
  for (std::size_t v = 0; v < solid.values.size(); ++v) {
    steps += solid.values[v] - before.values[v];
    if (laid->laid[v] == 0 || laid->laid[v] > 200) {
      ASSERT_EQ(label.values[v], laid->laid[v] == 0 ? start.label[v] : laid->tissue[v]);
    }
  }
  EXPECT_NEAR(steps / 255.0 * start.grid.voxelVolume_mm3(), last.filling.total_mm3, 1e-6);
  const ProgramOutput bites = molar("replay " + at("next.molar") + " --bites");
  EXPECT_EQ(bites.status, 0) << bites.err;
  // And from there on.
  const ProgramOutput third = molar("rehearse --headless --pace fast --continue " + at("next.molar") + " --record " +
                                    at("third.molar") + " --device poses:" + at("far.csv"));
  ASSERT_EQ(third.status, 0) << third.err;
  EXPECT_EQ(measuresOf("third.molar"), measuresOf("next.molar")) << "nothing was done";
}

TEST_F(FillingCommand, RefusesInOneLine) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const ProgramOutput said =
        molar("rehearse --headless --device poses:none.csv --task preparation --tooth 45 " + arguments);
    EXPECT_EQ(said.status, 2) << arguments;
    EXPECT_NE(said.err.find(words), std::string::npos) << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  };
  refused("--cavity ready", "no cavity by rule");
  refused("--cavity filled", "filled");
  refused("--cavity ready --continue " + at("none.molar"), "--cavity");
}

}  // namespace
}  // namespace app
