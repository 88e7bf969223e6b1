#include "assets/synthetic/jaw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "assets/load_error.h"
#include "assets/synthetic/scanner.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

constexpr double kTestSpacing_mm = 0.5;

/// One jaw of each kind, made once and shared.
const Patient& standardJaw() {
  static const Patient kPatient = syntheticJaw({.spacing_mm = kTestSpacing_mm});
  return kPatient;
}

struct TissueCount {
  std::array<double, kTissueCount> volume_mm3{};
  std::array<double, kTissueCount> mean_hu{};
};

TissueCount countTissues(const CtVolume& ct) {
  TissueCount count;
  std::array<double, kTissueCount> voxels{};
  for (std::size_t n = 0; n < ct.label.size(); ++n) {
    voxels[ct.label[n]] += 1.0;
    count.mean_hu[ct.label[n]] += ct.hounsfield[n];
  }
  for (std::size_t t = 0; t < voxels.size(); ++t) {
    count.mean_hu[t] /= std::max(voxels[t], 1.0);
    count.volume_mm3[t] = voxels[t] * ct.grid.voxelVolume_mm3();
  }
  return count;
}

double volumeOf(const TissueCount& count, Tissue tissue) { return count.volume_mm3[static_cast<std::size_t>(tissue)]; }

template <class Visit>
void forEachVoxel(const CtVolume& ct, Visit visit) {
  std::size_t n = 0;
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i, ++n) visit(glm::ivec3(i, j, k), n);
}

bool isThirdMolar(std::uint8_t label) {
  const auto tissue = static_cast<Tissue>(label);
  return tissue == Tissue::enamel || tissue == Tissue::dentine || tissue == Tissue::pulp;
}

/// Long axis of the third molar: principal axis of its voxels by power iteration, towards its enamel.
glm::dvec3 longAxisOfThirdMolar(const CtVolume& ct) {
  glm::dvec3 mean(0.0), enamel(0.0);
  double count = 0.0, enamel_count = 0.0;
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    if (!isThirdMolar(ct.label[n])) return;
    mean += glm::dvec3(ijk);
    count += 1.0;
    if (ct.label[n] != static_cast<std::uint8_t>(Tissue::enamel)) return;
    enamel += glm::dvec3(ijk);
    enamel_count += 1.0;
  });
  mean /= count;
  enamel /= enamel_count;
  glm::dmat3 covariance(0.0);
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    if (isThirdMolar(ct.label[n])) covariance += glm::outerProduct(glm::dvec3(ijk) - mean, glm::dvec3(ijk) - mean);
  });
  glm::dvec3 axis = glm::normalize(enamel - mean);
  for (int step = 0; step < 200; ++step) axis = glm::normalize(covariance * axis);
  return glm::dot(axis, enamel - mean) > 0.0 ? axis : -axis;
}

/// Angle in the sagittal plane of the arch at the third molar, crown to mesial positive; the second molar is
/// upright.
double measuredWinterAngle_deg(const Patient& patient) {
  const glm::dvec3 axis = longAxisOfThirdMolar(patient.ct);
  const double outward = patient.site->fdi == 48 ? -1.0 : 1.0;
  const glm::dvec3 mesial = glm::normalize(glm::dvec3(-0.26 * outward, -1.0, 0.0));
  return calibration::degreesFromRad(std::atan2(glm::dot(axis, mesial), axis.z));
}

double thirdMolarToCanal_mm(const Patient& patient) {
  double least_mm = 1e9;
  const CtVolume& ct = patient.ct;
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    if (!isThirdMolar(ct.label[n])) return;
    for (const glm::dvec3& p : patient.mandibular_canal_P_mm)
      least_mm = std::min(least_mm, glm::distance(p, ct.grid.centre_P_mm(ijk)) - patient.mandibular_canal_radius_mm);
  });
  return least_mm;
}

TEST(SyntheticJaw, HoldsEveryTissueInPlausibleAmounts) {
  const TissueCount count = countTissues(standardJaw().ct);
  // A real third molar: enamel 272, dentine 446, pulp 103 mm3.
  EXPECT_NEAR(volumeOf(count, Tissue::enamel), 272.0, 60.0);
  EXPECT_NEAR(volumeOf(count, Tissue::dentine), 446.0, 80.0);
  EXPECT_NEAR(volumeOf(count, Tissue::pulp), 103.0, 35.0);
  EXPECT_NEAR(volumeOf(count, Tissue::mandibular_canal), 400.0, 120.0);
  EXPECT_NEAR(volumeOf(count, Tissue::other_teeth), 2700.0, 500.0);
  EXPECT_GT(volumeOf(count, Tissue::ligament), 200.0);
  EXPECT_GT(volumeOf(count, Tissue::cortical), 5000.0);
  EXPECT_GT(volumeOf(count, Tissue::trabecular), 5000.0);
  EXPECT_GT(volumeOf(count, Tissue::gingiva), 2000.0);
}

TEST(SyntheticJaw, ShowsEachTissueInItsGreyValue) {
  // Deep voxels only: the point spread mixes the rims.
  const CtVolume& ct = standardJaw().ct;
  std::map<Tissue, std::pair<double, double>> sum;
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        glm::ivec3 beside = ijk;
        beside[axis] += side;
        if (!ct.grid.contains(beside) || ct.label[ct.grid.index(beside)] != ct.label[n]) return;
      }
    auto& [total, voxels] = sum[static_cast<Tissue>(ct.label[n])];
    total += ct.hounsfield[n];
    voxels += 1.0;
  });
  for (const Tissue tissue : {Tissue::unlabelled, Tissue::cortical, Tissue::enamel, Tissue::dentine,
                              Tissue::mandibular_canal, Tissue::gingiva, Tissue::trabecular}) {
    const auto [total, voxels] = sum[tissue];
    ASSERT_GT(voxels, 20.0);
    const TissueProperties& expected = properties(static_cast<std::uint8_t>(tissue));
    EXPECT_NEAR(total / voxels, expected.hounsfield, 60.0) << expected.name;
  }
}

TEST(SyntheticJaw, RotatesTheThirdMolarByTheWinterAngle) {
  EXPECT_NEAR(measuredWinterAngle_deg(standardJaw()), 45.0, 5.0);
  for (const double angle_deg : {0.0, 25.0, 70.0, 90.0, -30.0}) {
    const Patient patient =
        syntheticJaw({.winter_angle_deg = angle_deg, .mandibular_canal_distance_mm = 1.0, .spacing_mm = 0.7});
    EXPECT_NEAR(measuredWinterAngle_deg(patient), angle_deg, 5.0);
  }
}

TEST(SyntheticJaw, PutsTheCrownAtItsDepth) {
  for (const double depth_mm : {1.0, 5.0}) {
    const Patient patient =
        syntheticJaw({.depth_mm = depth_mm, .mandibular_canal_distance_mm = 1.0, .spacing_mm = 0.5});
    double top_mm = -1e9;
    forEachVoxel(patient.ct, [&](glm::ivec3 ijk, std::size_t n) {
      if (isThirdMolar(patient.ct.label[n])) top_mm = std::max(top_mm, patient.ct.grid.centre_P_mm(ijk).z);
    });
    EXPECT_NEAR(top_mm, -depth_mm, 0.5);
  }
}

TEST(SyntheticJaw, KeepsTheRequestedDistanceToTheMandibularCanal) {
  for (const double distance_mm : {0.5, 2.0, 3.5}) {
    const Patient patient = syntheticJaw({.mandibular_canal_distance_mm = distance_mm, .spacing_mm = 0.4});
    EXPECT_NEAR(thirdMolarToCanal_mm(patient), distance_mm, 0.4);
  }
}

TEST(SyntheticJaw, RunsTheCanalLineInsideTheMandibularCanal) {
  const Patient& patient = standardJaw();
  EXPECT_GT(patient.mandibular_canal_P_mm.size(), 100u);
  for (const glm::dvec3& p : patient.mandibular_canal_P_mm) {
    const glm::ivec3 ijk(glm::round(patient.ct.grid.indexFromPoint(p)));
    ASSERT_TRUE(patient.ct.grid.contains(ijk));
    EXPECT_EQ(static_cast<Tissue>(patient.ct.label[patient.ct.grid.index(ijk)]), Tissue::mandibular_canal)
        << p.x << ' ' << p.y;
  }
}

TEST(SyntheticJaw, LeavesAirAroundTheBone) {
  const CtVolume& ct = standardJaw().ct;
  glm::ivec3 low = ct.grid.size, high(0);
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    if (ct.label[n] == 0) return;
    low = glm::min(low, ijk);
    high = glm::max(high, ijk);
  });
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(low[axis] * kTestSpacing_mm, 3.0) << axis;
    EXPECT_GE((ct.grid.size[axis] - 1 - high[axis]) * kTestSpacing_mm, 3.0) << axis;
  }
}

TEST(SyntheticJaw, CoversTheBoneWithMucosaUpToTheEndsOfTheSegment) {
  const CtVolume& ct = standardJaw().ct;
  constexpr double kMucosaBegins_mm = -12.0;
  int bare = 0, covered = 0;
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    if (ct.label[n] != static_cast<std::uint8_t>(Tissue::cortical)) return;
    if (ct.grid.centre_P_mm(ijk).z < kMucosaBegins_mm) return;
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        glm::ivec3 beside = ijk;
        beside[axis] += step;
        const std::uint8_t label = ct.label[ct.grid.index(beside)];
        bare += label == static_cast<std::uint8_t>(Tissue::unlabelled) ? 1 : 0;
        covered += label == static_cast<std::uint8_t>(Tissue::gingiva) ? 1 : 0;
      }
  });
  EXPECT_EQ(bare, 0);
  EXPECT_GT(covered, 1000);
}

TEST(SyntheticJaw, MirrorsTheLeftSideExactly) {
  const Patient left = syntheticJaw({.right_side = false, .spacing_mm = 0.6});
  const Patient right = syntheticJaw({.right_side = true, .spacing_mm = 0.6});
  const VolumeGrid& grid = left.ct.grid;
  std::size_t different = 0;
  forEachVoxel(left.ct, [&](glm::ivec3 ijk, std::size_t n) {
    const std::size_t mirror = grid.index({grid.size.x - 1 - ijk.x, ijk.y, ijk.z});
    if (left.ct.label[n] != right.ct.label[mirror] || left.ct.hounsfield[n] != right.ct.hounsfield[mirror]) ++different;
  });
  EXPECT_EQ(different, 0u);
  EXPECT_EQ(left.site->fdi, 38);
  EXPECT_EQ(right.site->fdi, 48);
  EXPECT_GT(left.site->centre_P_mm.x, 0.0);
  EXPECT_NEAR(left.site->centre_P_mm.x, -right.site->centre_P_mm.x, 1e-9);
  EXPECT_NEAR(left.mandibular_canal_P_mm[50].x, -right.mandibular_canal_P_mm[50].x, 1e-12);
}

TEST(SyntheticJaw, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Patient first = syntheticJaw({.spacing_mm = 0.8, .seed = 5});
  const Patient again = syntheticJaw({.spacing_mm = 0.8, .seed = 5});
  const Patient other = syntheticJaw({.spacing_mm = 0.8, .seed = 6});
  EXPECT_EQ(first.ct.hounsfield, again.ct.hounsfield);
  EXPECT_EQ(first.ct.label, again.ct.label);
  EXPECT_EQ(first.ct.solid, again.ct.solid);
  EXPECT_NE(first.ct.hounsfield, other.ct.hounsfield);
}

TEST(SyntheticJaw, HasTheSameVolumesAtEveryVoxelSize) {
  const TissueCount fine = countTissues(syntheticJaw({.spacing_mm = 0.35}).ct);
  const TissueCount coarse = countTissues(syntheticJaw({.spacing_mm = 0.5}).ct);
  for (const Tissue tissue : {Tissue::cortical, Tissue::trabecular, Tissue::other_teeth, Tissue::enamel,
                              Tissue::dentine, Tissue::pulp, Tissue::mandibular_canal, Tissue::gingiva})
    EXPECT_NEAR(volumeOf(coarse, tissue) / volumeOf(fine, tissue), 1.0, tissue == Tissue::gingiva ? 0.04 : 0.03)
        << properties(static_cast<std::uint8_t>(tissue)).name;
}

TEST(SyntheticJaw, HasItsSiteAtTheThirdMolar) {
  const Patient& patient = standardJaw();
  ASSERT_TRUE(patient.site);
  const glm::dvec3 axis = longAxisOfThirdMolar(patient.ct);
  EXPECT_GT(glm::dot(axis, patient.site->axis_P), std::cos(calibration::radFromDegrees(8.0)));
  const glm::ivec3 ijk(glm::round(patient.ct.grid.indexFromPoint(patient.site->centre_P_mm)));
  EXPECT_TRUE(isThirdMolar(patient.ct.label[patient.ct.grid.index(ijk)]));
}

TEST(SyntheticJaw, NumbersEveryToothOfItsSide) {
  const Patient& patient = standardJaw();
  const CtVolume& ct = patient.ct;
  const int quadrant = patient.site->fdi - 8;
  std::array<double, 9> volume_mm3{};
  std::array<glm::dvec3, 9> sum{};
  forEachVoxel(ct, [&](glm::ivec3 ijk, std::size_t n) {
    const bool is_tooth = isThirdMolar(ct.label[n]) || static_cast<Tissue>(ct.label[n]) == Tissue::other_teeth;
    ASSERT_EQ(ct.tooth[n] != 0, is_tooth) << "a number for every voxel of a tooth, none elsewhere";
    if (!is_tooth) return;
    ASSERT_EQ(ct.tooth[n] == patient.site->fdi, isThirdMolar(ct.label[n]));
    const auto place = static_cast<std::size_t>(ct.tooth[n] - quadrant);
    ASSERT_LT(place, volume_mm3.size());
    volume_mm3[place] += ct.grid.voxelVolume_mm3();
    sum[place] += ct.grid.voxelVolume_mm3() * ct.grid.centre_P_mm(ijk);
  });
  for (std::size_t place = 4; place <= 8; ++place) {
    EXPECT_GT(volume_mm3[place], 250.0) << place;
    if (place > 4) {
      EXPECT_GT(sum[place].y / volume_mm3[place], sum[place - 1].y / volume_mm3[place - 1] + 4.0) << "in order";
    }
  }
}

TEST(SyntheticJaw, NamesTheParameterThatIsOutOfRange) {
  const auto message_of = [](const JawParameters& parameters) -> std::string {
    try {
      syntheticJaw(parameters);
    } catch (const LoadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message_of({.winter_angle_deg = 200.0}).find("Winter angle"), std::string::npos);
  EXPECT_NE(message_of({.depth_mm = -4.0}).find("depth"), std::string::npos);
  EXPECT_NE(message_of({.mandibular_canal_distance_mm = -0.1}).find("canal distance"), std::string::npos);
  EXPECT_NE(message_of({.spacing_mm = std::nan("")}).find("voxel size"), std::string::npos);
  EXPECT_NE(message_of({.opening_mm = 80.0}).find("opening of the mouth"), std::string::npos);
  EXPECT_NE(
      message_of({.winter_angle_deg = 0.0, .depth_mm = 8.0, .mandibular_canal_distance_mm = 6.0}).find("does not fit"),
      std::string::npos);
}

}  // namespace
}  // namespace assets
