#include <numbers>

#include <nlohmann/json.hpp>

#include "tests/app/half_space.h"
#include "tests/app/program.h"

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
    const Said said = molar(
        "carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --erosion time --poses " + at("p.csv") +
        " --set removal_rate_per_s=" + std::to_string(rate_per_s) + " --out " + at("c.nrrd") + " --force");
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out).at("removed_mm3").get<double>();
  }
};

constexpr double kPi = std::numbers::pi;

TEST_F(CarveCommand, DwellingTakesTheCapAndNoMore) {
  const double cap_mm3 = kPi * (2.0 - 1.0 / 3.0);
  for (const double spacing_mm : {0.1, 0.2})
    EXPECT_NEAR(removed_mm3(spacing_mm, 1000, {0.03, 0.02, 1.0}, {0.03, 0.02, 1.0}, 1.0, 20.0) / cap_mm3, 1.0, 0.02);
}

TEST_F(CarveCommand, SweepingTakesTheSweptVolume) {
  const double h = 1.5, R = 2.0;
  const double section = R * R * std::acos(1 - h / R) - (R - h) * std::sqrt(2 * R * h - h * h);
  const double swept_mm3 = kPi * h * h * (R - h / 3.0) + 3.0 * section;
  EXPECT_NEAR(removed_mm3(0.2, 1000, {-1.5, 0, 0.5}, {1.5, 0, 0.5}, 3.0, 20.0) / swept_mm3, 1.0, 0.02);
}

TEST_F(CarveCommand, TakesTheSameEverySecondWhateverVoxelsAndTicks) {
  const double h = 0.8, cap_mm3 = kPi * h * h * (2.0 - h / 3.0), linear_mm3 = cap_mm3 * 4.0 * 0.05;
  for (const double spacing_mm : {0.1, 0.2})
    for (const double rate_Hz : {500.0, 1000.0, 2000.0})
      EXPECT_NEAR(removed_mm3(spacing_mm, rate_Hz, {0.03, 0.02, 1.2}, {0.03, 0.02, 1.2}, 0.05, 4.0) / linear_mm3, 1.0,
                  0.02)
          << spacing_mm << " mm, " << rate_Hz << " Hz";
}

TEST_F(CarveCommand, WritesWhatIsLeft) {
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

TEST_F(CarveCommand, TakesNothingWithThePedalUp) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  write("p.csv", "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz,drill\n0,0,0,1,1,0,0,0,0\n1,0,0,1,1,0,0,0,0\n");
  const Said said = molar("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " + at("p.csv") +
                          " --out " + at("c.nrrd"));
  EXPECT_EQ(nlohmann::json::parse(said.out).at("removed_mm3").get<double>(), 0.0);
}

}  // namespace
}  // namespace app
