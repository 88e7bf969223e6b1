#include <random>

#include "tests/app/commands/program.h"
#include "tests/app/half_space.h"

namespace app {
namespace {

struct Felt {
  double t_s, fx, fy, fz, tx, ty, tz, volume_mm3, depth_mm;
  glm::dvec3 force() const { return {fx, fy, fz}; }
};

std::vector<Felt> feltIn(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "t_s,fx_N,fy_N,fz_N,tx_Nmm,ty_Nmm,tz_Nmm,volume_mm3,depth_mm");
  std::vector<Felt> rows;
  while (std::getline(lines, line)) {
    Felt f{};
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &f.t_s, &f.fx, &f.fy, &f.fz, &f.tx,
                          &f.ty, &f.tz, &f.volume_mm3, &f.depth_mm),
              9);
    rows.push_back(f);
  }
  return rows;
}

/// Forces on a 2 mm bur at one depth, at random points of a face.
struct Felt16 {
  double depth_rms = 0.0;      ///< relative error
  double angle_rms_deg = 0.0;  ///< of the force against the face's normal
  double mean_force_N = 0.0;
};

class FeelCommand : public ProgramTest {
 protected:
  static constexpr int kPlaces = 16;

  std::vector<Felt16> press(double spacing_mm, const glm::dvec3& normal, double offset_mm,
                            const std::vector<double>& depths_mm) {
    writeHalfSpace(at("v.nrrd"), spacing_mm, normal, offset_mm, 6.4);
    std::mt19937 generator(17);
    std::uniform_real_distribution<double> uniform(-0.4, 0.4);
    std::vector<glm::dvec4> rows;
    for (const double depth_mm : depths_mm)
      for (int i = 0; i < kPlaces; ++i) {
        glm::dvec3 p{uniform(generator), uniform(generator), uniform(generator)};
        p += (offset_mm + 2.0 - depth_mm - glm::dot(p, normal)) * normal;
        rows.emplace_back(rows.size(), p);
      }
    write("p.csv", poseCsv(rows));
    const ProgramOutput said =
        molar("feel --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --law agus --poses " + at("p.csv") +
              " --out " + at("f.csv") + " --force");
    EXPECT_EQ(said.status, 0) << said.err;
    const auto felt = feltIn(read("f.csv"));
    EXPECT_EQ(felt.size(), rows.size());
    std::vector<Felt16> out(depths_mm.size());
    for (std::size_t r = 0; r < felt.size(); ++r) {
      Felt16& f = out[r / kPlaces];
      const double error = felt[r].depth_mm / depths_mm[r / kPlaces] - 1.0;
      const double sine = glm::length(glm::cross(glm::normalize(felt[r].force()), normal));
      f.depth_rms += error * error / kPlaces;
      f.angle_rms_deg += std::pow(glm::degrees(std::asin(sine)), 2) / kPlaces;
      f.mean_force_N += glm::length(felt[r].force()) / kPlaces;
    }
    for (Felt16& f : out) f.depth_rms = std::sqrt(f.depth_rms), f.angle_rms_deg = std::sqrt(f.angle_rms_deg);
    return out;
  }
};

TEST_F(FeelCommand, GivesDepthAndDirectionForAnyOrientation) {
  const std::vector<glm::dvec3> normals{{0, 0, 1},
                                        {1, 0, 0},
                                        glm::normalize(glm::dvec3(0.3, 0.5, 0.81)),
                                        glm::normalize(glm::dvec3(-1, 1, 1)),
                                        glm::normalize(glm::dvec3(0.02, -1, 0.03))};
  // On a layer's boundary, at its quarter, through its middle.
  for (const glm::dvec3& normal : normals)
    for (const double offset_mm : {0.0, 0.025, 0.05}) {
      SCOPED_TRACE(testing::Message() << "normal " << normal.x << " " << normal.y << " " << normal.z << " offset "
                                      << offset_mm);
      const auto felt = press(0.1, normal, offset_mm, {1.0, 0.2});
      EXPECT_LT(felt[0].depth_rms, 0.005);
      EXPECT_LT(felt[0].angle_rms_deg, 0.3);
      EXPECT_LT(felt[1].depth_rms, 0.01);
      // Two voxels deep, a face two degrees off the lattice shows its steps: 0.34 degrees.
      EXPECT_LT(felt[1].angle_rms_deg, glm::abs(normal.y) > 0.99 ? 0.4 : 0.3);
    }
}

TEST_F(FeelCommand, ForceIsIndependentOfVoxelSize) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 0.5, 0.81));
  const double fine_N = press(0.1, normal, 0.0, {1.0})[0].mean_force_N;
  const double coarse_N = press(0.2, normal, 0.0, {1.0})[0].mean_force_N;
  EXPECT_NEAR(fine_N, 0.8, 0.008);
  EXPECT_NEAR(coarse_N / fine_N, 1.0, 0.02);
}

TEST_F(FeelCommand, StiffnessIsSetByOption) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  write("p.csv", poseCsv({{0, 0, 0, 1}}));
  const std::string feel = "feel --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " + at("p.csv");
  ASSERT_EQ(molar(feel + " --out " + at("a.csv")).status, 0);
  ASSERT_EQ(molar(feel + " --set stiffness_N_per_mm=1.6 --out " + at("b.csv")).status, 0);
  EXPECT_NEAR(feltIn(read("b.csv"))[0].fz, 2.0 * feltIn(read("a.csv"))[0].fz, 1e-6);
}

TEST_F(FeelCommand, ServedForceKeepsTheLimits) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  std::vector<glm::dvec4> rows;
  for (int i = 0; i < 400; ++i) rows.emplace_back(0.001 * i, 0.0, 0.0, 2.2 - 0.02 * i);
  write("p.csv", poseCsv(rows));
  ASSERT_EQ(molar("feel --served --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " + at("p.csv") +
                  " --out " + at("f.csv"))
                .status,
            0);
  glm::dvec3 last{0.0};
  double largest = 0.0;
  for (const Felt& f : feltIn(read("f.csv"))) {
    EXPECT_LE(glm::length(f.force()), 3.3 + 1e-6);
    EXPECT_LE(glm::distance(f.force(), last), 0.3 + 1e-6) << f.t_s;
    last = f.force();
    largest = std::max(largest, glm::length(last));
  }
  EXPECT_NEAR(largest, 3.3, 0.01) << "deep in the bone the limit is reached";
  EXPECT_GT(last.z, 3.2) << "and the direction is still out of the bone";
}

}  // namespace
}  // namespace app
