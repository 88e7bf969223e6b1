#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class FileCommand : public ProgramTest {
 protected:
  nlohmann::json answer(const std::string& arguments) const {
    const ProgramOutput said = molar("file --json " + arguments);
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }
};

/// P L^2 / EI = 1 and 5: exact elliptic integrals.
TEST_F(FileCommand, BendsAUniformFileAsTheElastica) {
  const auto gentle = answer("--uniform 20 --length 25 --force-N 0.032");
  EXPECT_NEAR(gentle["tip"]["across_mm"].get<double>() / 25.0 / 0.301721, 1.0, 6e-4);
  const auto strong = answer("--uniform 20 --length 25 --force-N 0.16");
  EXPECT_NEAR(strong["tip"]["across_mm"].get<double>() / 25.0 / 0.713792, 1.0, 6e-4);
  EXPECT_NEAR(strong["on_hand"]["force_N"][0].get<double>(), 0.16, 1e-6);
  EXPECT_EQ(strong["nodes"].size(), 33u);
}

TEST_F(FileCommand, SaysWhereItTouchesABentCanal) {
  const auto canal = answer("--size 20 --length 21 --canal arc:5,45");
  EXPECT_TRUE(canal["settled"].get<bool>());
  EXPECT_NEAR(canal["tip"]["depth_mm"].get<double>(), 8.0 + 5.0 * 0.7854 + 2.0 - 0.5, 0.1);
  EXPECT_GT(canal["contacts"].size(), 2u);
  EXPECT_GT(canal["on_hand"]["force_N"][2].get<double>(), 0.1) << "the hand is pushed back";
  const auto stopped = answer("--size 25 --length 21 --force-N 0.5 --canal builtin:36:mesiobuccal");
  EXPECT_LT(stopped["tip"]["depth_mm"].get<double>(), canal["tip"]["depth_mm"].get<double>());
  const ProgramOutput table = molar("file --size 20 --length 21 --canal straight:0.3 --depth 8");
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_NE(table.out.find("walls bear"), std::string::npos) << table.out;
}

TEST_F(FileCommand, TurnsAndFilesInTheCanal) {
  const auto turned = answer("--size 20 --length 21 --canal arc:5,45 --turn 180");
  EXPECT_GT(turned["turned"]["torque_Nmm"].get<double>(), 0.1);
  EXPECT_LT(turned["turned"]["of_breaking"].get<double>(), 1.0);
  const auto filed = answer("--size 20 --length 21 --canal arc:5,45 --strokes 2");
  const double removed_mm3 = filed["worn"]["removed_mm3"].get<double>();
  EXPECT_GT(removed_mm3, 1e-3);
  EXPECT_NEAR(removed_mm3 / filed["worn"]["due_mm3"].get<double>(), 1.0, 0.01);
  const auto stopped = answer("--size 10 --length 21 --canal straight:0.5 --depth 12 --working-length 11.9");
  EXPECT_NEAR(stopped["tip"]["depth_mm"].get<double>(), 12.0, 0.2);
}

TEST_F(FileCommand, SaysThatABentTipPassesAndThatTooBentATipDoesNot) {
  const auto bent = answer("--size 15 --length 21 --canal arc:5,45 --prebend 15");
  EXPECT_TRUE(bent["entered"].get<bool>());
  const auto loose = answer("--prebend 30");
  EXPECT_GT(loose["tip"]["across_mm"].get<double>(), 0.5) << "without a load";
}

TEST_F(FileCommand, ComparesWithTheDampedChain) {
  const auto rest = answer("--size 25 --force-N 0.05"), damped = answer("--size 25 --force-N 0.05 --solver rk4");
  EXPECT_NEAR(rest["tip"]["across_mm"].get<double>(), damped["tip"]["across_mm"].get<double>(), 1e-6);
  EXPECT_GT(damped["inertia_Nmm_s2"].get<double>(), 0.0);
}

TEST_F(FileCommand, RefusesWhatThereIsNot) {
  expectRefusal("file --size 27", "140");
  expectRefusal("file --length 22", "25");
  expectRefusal("file --force-N nan", "-100 to 100");
  expectRefusal("file --force-N 1e300", "-100 to 100");
  expectRefusal("file --at 40", "1 to 32");
  expectRefusal("file --at handle", "tip");
  expectRefusal("file --depth 5", "--canal");
  expectRefusal("file --size 40 --canal straight:0.3", "wider than the orifice");
  expectRefusal("file --canal straight", "diameter");
  expectRefusal("file --canal straight:nan", "not a number");
  expectRefusal("file --canal arc:5", "angle");
  expectRefusal("file --canal builtin:36:palatal", "mesiobuccal");
  expectRefusal("file --canal builtin:11:single", "34");
  expectRefusal("file --canal builtin:36", "TOOTH:NAME");
  expectRefusal("file --canal tube:3", "straight:D");
  expectRefusal("file --size 15 --canal arc:5,45 --depth 80", "--depth");
  expectRefusal("file --size 15 --canal arc:5,45 --depth nan", "--depth");
  expectRefusal("file --size 15 --canal arc:5,45 --solver rk4", "walls");
}

}  // namespace
}  // namespace app
