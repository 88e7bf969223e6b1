#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"
#include "tests/app/half_space.h"

namespace app {
namespace {

class CarveCommand : public ProgramTest {
 protected:
  /// Removed mm³ with poses at `rate_Hz` from `from` to `to` in `seconds`.
  double removed_mm3(double spacing_mm, double rate_Hz, const glm::dvec3& from, const glm::dvec3& to, double seconds,
                     double rate_per_s) {
    writeHalfSpace(at("v.nrrd"), spacing_mm, {0, 0, 1}, 0.0);
    std::vector<glm::dvec4> rows;
    const int n = static_cast<int>(std::lround(seconds * rate_Hz));
    for (int i = 0; i <= n; ++i) rows.emplace_back(i / rate_Hz, glm::mix(from, to, static_cast<double>(i) / n));
    write("p.csv", poseCsv(rows));
    const ProgramOutput said = molar(
        "carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --erosion time --poses " + at("p.csv") +
        " --set removal_rate_per_s=" + std::to_string(rate_per_s) + " --out " + at("c.nrrd") + " --force");
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out).at("removed_mm3").get<double>();
  }
};

constexpr double kPi = std::numbers::pi;

TEST_F(CarveCommand, DwellingRemovesTheCapOnly) {
  const double cap_mm3 = kPi * (2.0 - 1.0 / 3.0);
  for (const double spacing_mm : {0.1, 0.2})
    EXPECT_NEAR(removed_mm3(spacing_mm, 1000, {0.03, 0.02, 1.0}, {0.03, 0.02, 1.0}, 1.0, 20.0) / cap_mm3, 1.0, 0.02);
}

TEST_F(CarveCommand, SweepingRemovesTheSweptVolume) {
  const double h = 1.5, R = 2.0;
  const double section = R * R * std::acos(1 - h / R) - (R - h) * std::sqrt(2 * R * h - h * h);
  const double swept_mm3 = kPi * h * h * (R - h / 3.0) + 3.0 * section;
  EXPECT_NEAR(removed_mm3(0.2, 1000, {-1.5, 0, 0.5}, {1.5, 0, 0.5}, 3.0, 20.0) / swept_mm3, 1.0, 0.02);
}

TEST_F(CarveCommand, RemovalRateIsIndependentOfVoxelsAndTicks) {
  const double h = 0.8, cap_mm3 = kPi * h * h * (2.0 - h / 3.0), linear_mm3 = cap_mm3 * 4.0 * 0.05;
  for (const double spacing_mm : {0.1, 0.2})
    for (const double rate_Hz : {500.0, 1000.0, 2000.0})
      EXPECT_NEAR(removed_mm3(spacing_mm, rate_Hz, {0.03, 0.02, 1.2}, {0.03, 0.02, 1.2}, 0.05, 4.0) / linear_mm3, 1.0,
                  0.02)
          << spacing_mm << " mm, " << rate_Hz << " Hz";
}

TEST_F(CarveCommand, WritesTheRemainingSolid) {
  const double removed = removed_mm3(0.2, 1000, {0, 0, 1}, {0, 0, 1}, 0.5, 4.0);
  const auto before = assets::readSolid(at("v.nrrd")), after = assets::readSolid(at("c.nrrd"));
  ASSERT_EQ(before.grid, after.grid);
  double difference_mm3 = 0.0;
  for (std::size_t v = 0; v < before.values.size(); ++v) {
    ASSERT_LE(after.values[v], before.values[v]);
    difference_mm3 += (before.values[v] - after.values[v]) / 255.0 * before.grid.voxelVolume_mm3();
  }
  EXPECT_NEAR(difference_mm3, removed, 1e-9);
  EXPECT_GT(removed, 1.0);
}

TEST_F(CarveCommand, RemovesNothingWithThePedalUp) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  write("p.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n0,0,0,1,1,0,0,0,0\n1,0,0,1,1,0,0,0,0\n");
  const ProgramOutput said = molar("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " +
                                   at("p.csv") + " --out " + at("c.nrrd"));
  EXPECT_EQ(nlohmann::json::parse(said.out).at("removed_mm3").get<double>(), 0.0);
}

/// The result of dwelling one second 0.4 mm deep under the side of a 2 mm bur, spindle along +x.
class CarveByLaw : public CarveCommand {
 protected:
  nlohmann::json answer(const std::string& options, const std::string& poses = kDwell) {
    writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
    write("p.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n" + poses);
    const ProgramOutput said = molar("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " +
                                     at("p.csv") + " --out " + at("c.nrrd") + " --force " + options);
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out);
  }
  double taken_mm3(const std::string& options, const std::string& poses = kDwell) {
    return answer(options, poses).at("removed_mm3").get<double>();
  }

  static constexpr const char* kDwell =
      "0,0.03,0.02,1.6,0.70710678,0,0.70710678,0,1\n0.4,0.03,0.02,1.6,0.70710678,0,0.70710678,0,1\n";
  static constexpr double k40krpm = 40000.0 * 2.0 * kPi / 60.0;
};

TEST_F(CarveByLaw, DoseFollowsTheGivenForce) {
  // alpha mu F w R t; the arm is a little shorter than R at 0.4 mm.
  const double paid_mm3 = 0.2e-3 * 0.3 * 1.0 * k40krpm * 2.0 * 0.4;
  const double one = taken_mm3("--erosion dose --set removal_mm3_per_J=0.2 normal_force_N=1");
  EXPECT_NEAR(one / paid_mm3, 0.97, 0.03);
  EXPECT_NEAR(taken_mm3("--erosion dose --set removal_mm3_per_J=0.2 normal_force_N=2") / one, 2.0, 0.03);
  EXPECT_NEAR(taken_mm3("--erosion dose --set removal_mm3_per_J=0.2 normal_force_N=1 spindle_rpm=20000") / one, 0.5,
              0.02);
  EXPECT_NEAR(taken_mm3("--erosion dose --set removal_mm3_per_J=0.2 normal_force_N=1 worn=0.5") / one, 0.5, 0.02);
  EXPECT_NEAR(taken_mm3("--erosion dose --set removal_mm3_per_J=0.2 normal_force_N=1 friction=0.15") / one, 0.5, 0.02);
}

TEST_F(CarveByLaw, DoseFollowsTheForceLawWithoutAGivenForce) {
  // Little is cut, so k h = 2.5 * 0.4 = 1 N stays.
  const std::string slow = " removal_mm3_per_J=0.05";
  EXPECT_NEAR(taken_mm3("--erosion dose --set stiffness_N_per_mm=2.5" + slow) /
                  taken_mm3("--erosion dose --set normal_force_N=1" + slow),
              1.0, 0.05);
}

TEST_F(CarveByLaw, StallsUnderOverload) {
  // mu F R = 0.3 * 4 * 2 = 2.4 N mm.
  EXPECT_EQ(taken_mm3("--erosion dose --set normal_force_N=4 stall_torque_Nmm=2"), 0.0);
  EXPECT_GT(taken_mm3("--erosion dose --set normal_force_N=4 stall_torque_Nmm=20"), 0.5);
}

TEST_F(CarveByLaw, MachiningRemovesTheFeedVolume) {
  const double R = 2.0, h = 0.6, way_mm = 3.0;
  const double section = R * R * std::acos(1 - h / R) - (R - h) * std::sqrt(2 * R * h - h * h);
  const std::string along = "0,-1.5,0,1.4,1,0,0,0,1\n0.5,1.5,0,1.4,1,0,0,0,1\n";
  const nlohmann::json said = answer("--erosion machining", along);
  EXPECT_EQ(said.at("erosion"), "machining");
  EXPECT_NEAR(said.at("removed_mm3").get<double>() / (section * way_mm), 1.0, 0.05);
  EXPECT_NEAR(said.at("mm3_per_s").get<double>(), said.at("removed_mm3").get<double>() / 0.5, 1e-9);
  // The same feed with too weak a motor: what its power pays for, 0.2 of the way to the free speed left.
  const double watts = 0.02 * 0.2 * k40krpm * 1e-3;
  EXPECT_NEAR(
      taken_mm3("--erosion machining --set stall_torque_Nmm=0.02 bearing_torque_Nmm=0", along) / (watts / 0.1 * 0.5),
      1.0, 0.1);
  EXPECT_EQ(taken_mm3("--erosion machining"), 0.0);
}

TEST_F(CarveByLaw, TimeLawIsProportionalToTheSpeed) {
  const double full = taken_mm3("--set removal_rate_per_s=0.5");
  EXPECT_NEAR(taken_mm3("--set removal_rate_per_s=0.5 spindle_rpm=10000") / full, 0.25, 0.01);
  EXPECT_EQ(taken_mm3("--set removal_rate_per_s=0.5 spindle_rpm=0"), 0.0);
}

TEST_F(CarveByLaw, RefusesSettingsOfOtherLawsAndOutOfRange) {
  writeHalfSpace(at("v.nrrd"), 0.4, {0, 0, 1}, 0.0);
  write("p.csv", std::string("t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n") + kDwell);
  const auto refused = [&](const std::string& options) {
    const ProgramOutput said = molar("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " +
                                     at("p.csv") + " --out " + at("c.nrrd") + " --force " + options);
    EXPECT_EQ(said.status, 2) << options;
    return said.err;
  };
  EXPECT_NE(refused("--erosion dose --set removal_rate_per_s=4").find("removal_mm3_per_J"), std::string::npos);
  EXPECT_NE(refused("--erosion time --set normal_force_N=1").find("no such setting"), std::string::npos);
  EXPECT_NE(refused("--set spindle_rpm=9e9").find("rpm"), std::string::npos);
  EXPECT_NE(refused("--set worn=1.5").find("0 to 1"), std::string::npos);
  EXPECT_NE(refused("--erosion laser").find("machining"), std::string::npos);
}

}  // namespace
}  // namespace app
