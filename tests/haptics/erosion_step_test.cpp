#include "haptics/bone/erosion_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "calibration/geometry/units.h"
#include "tests/haptics/granted_rate.h"

namespace haptics {
namespace {

using assets::Tissue;

constexpr double k40krpm = 40000.0 * 2.0 * calibration::kPi / 60.0;

ErosionSettings settingsOf(ErosionKind kind) {
  ErosionSettings settings;
  settings.kind = kind;
  return settings;
}

CutConditions moment(double dt_s) {
  CutConditions at;
  at.dt_s = dt_s;
  at.spindle_rad_per_s = k40krpm;
  at.overlap_mm3 = 3.5;
  at.normal_force_N = 1.5;
  at.sliding_arm_mm = 1.2;
  at.swept_mm3_per_s = 4.0;
  at.power_Nmm_per_s = 20e3;
  return at;
}

/// Bone under a bur that stays where it is, in doubles: what bone/carve does, without rounding.
class PlainBone {
 public:
  PlainBone(std::uint8_t first, std::uint8_t second) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 500; ++n)
      voxels_.push_back(
          {unit(random) < 0.3 ? unit(random) : 1.0, 0.0, 0.3 + 1.6 * unit(random), n % 3 == 0 ? second : first});
  }

  double overlap_mm3() const {
    double sum = 0.0;
    for (const Voxel& voxel : voxels_) sum += voxel.covered * (1.0 - voxel.dose) * kVoxel_mm3;
    return sum;
  }

  std::array<double, assets::kTissueCount> cut(const ErosionStep& step) {
    std::array<double, assets::kTissueCount> removed{};
    for (Voxel& voxel : voxels_) {
      const double hard = 1.0 - step.speed_share + step.speed_share * voxel.arm_mm / step.mean_arm_mm;
      const double dose = std::min(voxel.covered, voxel.dose + voxel.covered * step.loss[voxel.label] * hard);
      removed[voxel.label] += (dose - voxel.dose) * kVoxel_mm3;
      voxel.dose = dose;
    }
    return removed;
  }

 private:
  static constexpr double kVoxel_mm3 = 0.008;
  struct Voxel {
    double covered, dose, arm_mm;
    std::uint8_t label;
  };
  std::vector<Voxel> voxels_;
};

/// Cuts for `seconds` and returns what went of each tissue.
std::array<double, assets::kTissueCount> cutFor(PlainBone& bone, const ErosionSettings& settings, double seconds,
                                                double rate_Hz) {
  std::array<double, assets::kTissueCount> total{};
  ErosionState memory;
  for (int tick = 0; tick < static_cast<int>(std::lround(seconds * rate_Hz)); ++tick) {
    CutConditions at = moment(1.0 / rate_Hz);
    at.overlap_mm3 = bone.overlap_mm3();
    const auto removed = bone.cut(erosionStep(settings, at, memory));
    memory = updatedErosion(settings, at, memory, removed);
    for (std::size_t tissue = 0; tissue < total.size(); ++tissue) total[tissue] += removed[tissue];
  }
  return total;
}

double sum(const std::array<double, assets::kTissueCount>& removed) {
  double total = 0.0;
  for (double part : removed) total += part;
  return total;
}

constexpr std::uint8_t kCortical = 1, kTrabecular = 2, kEnamel = 4;

TEST(ErosionByTime, IsLinearInTimeAtAnyTickRate) {
  const ErosionSettings settings = settingsOf(ErosionKind::time);
  for (double rate_Hz : {500.0, 1000.0, 4000.0, 10000.0}) {
    double cortical = 0.0, enamel = 0.0;
    for (int tick = 0; tick < static_cast<int>(0.05 * rate_Hz); ++tick) {
      const ErosionStep step = erosionStep(settings, moment(1.0 / rate_Hz), {});
      cortical += step.loss[kCortical], enamel += step.loss[kEnamel];
    }
    EXPECT_NEAR(cortical, 4.0 * 0.05, 1e-9);
    EXPECT_NEAR(enamel, 4.0 / 3.0 * 0.05, 1e-9);
  }
}

TEST(ErosionByTime, AsksNothingOfTheForceAndCutsAlikeAllRound) {
  CutConditions light = moment(1e-3);
  light.normal_force_N = light.overlap_mm3 = 0.0;
  const ErosionStep step = erosionStep(settingsOf(ErosionKind::time), light, {});
  EXPECT_NEAR(step.loss[kCortical], 0.004, 1e-15);
  EXPECT_EQ(step.speed_share, 0.0);
}

TEST(ErosionByDose, RemovesAlphaTimesTheWorkOfFriction) {
  const ErosionSettings settings = settingsOf(ErosionKind::dose);
  const double granted = 0.5e-3 * 0.3 * 1.5 * k40krpm * 1.2;  // mm3/J N mm/s
  EXPECT_NEAR(grantedRate_mm3_per_s(settings, moment(1e-3), Tissue::cortical), granted, 1e-12);
  EXPECT_NEAR(grantedRate_mm3_per_s(settings, moment(1e-3), Tissue::enamel), granted / 3.0, 1e-12);
  // The overlap of an untouched bone: a fully covered voxel loses its share.
  const ErosionStep step = erosionStep(settings, moment(1e-3), {});
  EXPECT_NEAR(step.loss[kCortical] * 3.5, granted * 1e-3, 1e-12);
  EXPECT_EQ(step.speed_share, 1.0);
}

TEST(ErosionByDose, MeetsItsVolumeWhateverIsAlreadyUsedUp) {
  const ErosionSettings settings = settingsOf(ErosionKind::dose);
  const double rate = grantedRate_mm3_per_s(settings, moment(1e-3), Tissue::cortical);
  for (double rate_Hz : {500.0, 1000.0, 4000.0, 10000.0})
    for (double part : {0.2, 0.5, 0.8}) {
      PlainBone bone(kCortical, kCortical);
      const double seconds = std::round(part * bone.overlap_mm3() / rate * 500.0) / 500.0;
      EXPECT_NEAR(sum(cutFor(bone, settings, seconds, rate_Hz)) / (rate * seconds), 1.0, 0.01)
          << rate_Hz << " " << part;
    }
}

TEST(ErosionByDose, SpendsTheSameWorkInMixedTissue) {
  const ErosionSettings settings = settingsOf(ErosionKind::dose);
  const double reference = grantedRate_mm3_per_s(settings, moment(1e-3), Tissue::cortical);
  PlainBone bone(kEnamel, kTrabecular);
  const auto removed = cutFor(bone, settings, 0.3, 1000.0);
  const double work = 3.0 * removed[kEnamel] + 0.3 * removed[kTrabecular];
  EXPECT_NEAR(work / (reference * 0.3), 1.0, 0.01);
  EXPECT_GT(removed[kTrabecular], 3.0 * removed[kEnamel]);
}

TEST(ErosionByDose, LeavesEnamelLongestAndCancellousShortest) {
  const auto removed = [](ErosionKind kind, std::uint8_t label) {
    PlainBone bone(label, label);
    return sum(cutFor(bone, settingsOf(kind), 0.05, 1000.0));
  };
  for (ErosionKind kind : {ErosionKind::time, ErosionKind::dose}) {
    EXPECT_GT(removed(kind, kTrabecular), 2.0 * removed(kind, kCortical));
    EXPECT_GT(removed(kind, kCortical), 2.0 * removed(kind, kEnamel));
  }
}

TEST(ErosionByMachining, TakesWhatTheFeedSweepsWithinThePowerThereIs) {
  ErosionSettings settings = settingsOf(ErosionKind::machining);
  CutConditions at = moment(1e-3);
  EXPECT_NEAR(grantedRate_mm3_per_s(settings, at, Tissue::cortical), 4.0, 1e-12);
  at.power_Nmm_per_s = 250.0;  // 0.1 J/mm3: 2.5 mm3/s
  EXPECT_NEAR(grantedRate_mm3_per_s(settings, at, Tissue::cortical), 2.5, 1e-12);
  EXPECT_NEAR(grantedRate_mm3_per_s(settings, at, Tissue::enamel), 2.5 / 3.0, 1e-12);
  EXPECT_NEAR(grantedRate_mm3_per_s(settings, at, Tissue::trabecular), 4.0, 1e-12);
  at.swept_mm3_per_s = 0.0;
  EXPECT_TRUE(erosionStep(settings, at, {}).isZero());
}

TEST(ErosionByMachining, MeetsItsVolumeWhateverIsAlreadyUsedUp) {
  const ErosionSettings settings = settingsOf(ErosionKind::machining);
  for (double rate_Hz : {500.0, 10000.0}) {
    PlainBone bone(kCortical, kEnamel);
    EXPECT_NEAR(sum(cutFor(bone, settings, 0.5, rate_Hz)) / 2.0, 1.0, 0.01) << rate_Hz;
  }
}

TEST(Erosion, StopsWithTheSpindleAndFadesWithItsEdge) {
  for (const ErosionName& law : kErosions) {
    ErosionSettings settings = settingsOf(law.kind);
    CutConditions at = moment(1e-3);
    const double fresh = grantedRate_mm3_per_s(settings, at, Tissue::cortical);
    EXPECT_GT(fresh, 0.0);
    settings.worn = 0.75;
    EXPECT_NEAR(grantedRate_mm3_per_s(settings, at, Tissue::cortical), 0.25 * fresh, 1e-12) << law.key;
    settings.worn = 1.0;
    EXPECT_TRUE(erosionStep(settings, at, {}).isZero()) << law.key;
    settings.worn = 0.0;
    at.spindle_rad_per_s = 0.0;
    EXPECT_TRUE(erosionStep(settings, at, {}).isZero()) << law.key;
    at.spindle_rad_per_s = -k40krpm;
    EXPECT_NEAR(grantedRate_mm3_per_s(settings, at, Tissue::cortical), fresh, 1e-12) << law.key;
  }
}

TEST(Erosion, GoesWithTheSpeedOfTheSpindle) {
  for (ErosionKind kind : {ErosionKind::time, ErosionKind::dose}) {
    CutConditions half = moment(1e-3);
    half.spindle_rad_per_s *= 0.5;
    EXPECT_NEAR(erosionStep(settingsOf(kind), half, {}).loss[kCortical],
                0.5 * erosionStep(settingsOf(kind), moment(1e-3), {}).loss[kCortical], 1e-15);
  }
}

TEST(Erosion, OwesLittleAndForgetsItInTheAir) {
  // Everything is used up, the hand presses on for a second, then finds fresh bone.
  const ErosionSettings settings = settingsOf(ErosionKind::dose);
  ErosionState memory;
  for (int tick = 0; tick < 1000; ++tick) memory = updatedErosion(settings, moment(1e-3), memory, {});
  EXPECT_LE(memory.deficit_mm3, 0.05 * 3.5 + 1e-12);
  PlainBone bone(kCortical, kCortical);
  const double rate = grantedRate_mm3_per_s(settings, moment(1e-3), Tissue::cortical);
  double gone = 0.0;
  for (int tick = 0; tick < 50; ++tick) {
    CutConditions at = moment(1e-3);
    at.overlap_mm3 = bone.overlap_mm3();
    const auto removed = bone.cut(erosionStep(settings, at, memory));
    gone += sum(removed);
    memory = updatedErosion(settings, at, memory, removed);
  }
  EXPECT_LT(gone, rate * 0.05 + 0.1 * 3.5);
  CutConditions air = moment(1e-3);
  air.overlap_mm3 = 0.0;
  EXPECT_EQ(updatedErosion(settings, air, memory, {}).deficit_mm3, 0.0);
  EXPECT_EQ(updatedErosion(settings, air, memory, {}).yield, 1.0);
}

TEST(Erosion, RemovesNothingByWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const ErosionName& law : kErosions)
    for (double bad : {nan, inf, -1.0}) {
      CutConditions at = moment(bad);
      EXPECT_TRUE(erosionStep(settingsOf(law.kind), at, {}).isZero()) << law.key << bad;
      at = moment(1e-3);
      at.normal_force_N = at.sliding_arm_mm = at.overlap_mm3 = at.swept_mm3_per_s = at.power_Nmm_per_s = bad;
      const ErosionStep step = erosionStep(settingsOf(law.kind), at, {});
      for (double loss : step.loss) EXPECT_TRUE(loss >= 0.0 && std::isfinite(loss)) << law.key << bad;
      EXPECT_TRUE(std::isfinite(updatedErosion(settingsOf(law.kind), at, {}, {}).deficit_mm3));
      EXPECT_TRUE(std::isfinite(updatedErosion(settingsOf(law.kind), at, {}, {}).yield));
    }
}

TEST(ErosionParameters, AreEachWithinTheirRangeByDefaultAndHeldThere) {
  ErosionSettings wild;
  for (const ErosionParameter& parameter : erosionParameters()) {
    EXPECT_GE(parameter.in(wild), parameter.lowest) << parameter.key;
    EXPECT_LE(parameter.in(wild), parameter.highest) << parameter.key;
    parameter.in(wild) = 1e9;
  }
  wild.kind = static_cast<ErosionKind>(77);
  ErosionSettings held = sanitised(wild);
  for (const ErosionParameter& parameter : erosionParameters()) EXPECT_EQ(parameter.in(held), parameter.highest);
  EXPECT_EQ(held.kind, ErosionKind::time);
  wild.worn = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sanitised(wild).worn, 0.0);
}

}  // namespace
}  // namespace haptics
