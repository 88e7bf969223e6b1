#include "app/session/measures/near_work.h"

#include <gtest/gtest.h>

#include "app/session/measures/tissue_work.h"
#include "tests/app/session/measures/measure_named.h"
#include "tests/haptics/structure_phantom.h"

namespace app {
namespace {

using test::named;
using test::valueNamed;

const haptics::Tool kBallBur{{haptics::ShapeKind::sphere, 1.0, 0.0}, {}};

/// A straight canal along x, its surface at z = -4 mm.
const assets::RiskStructures& straightCanal() {
  static const assets::RiskStructures kRisks = [] {
    assets::RiskStructures risks;
    risks.distance[0] = haptics::phantom::structureOf(0.25, [](const glm::dvec3& p) {
                          return std::hypot(p.y, p.z + 6.0) <= 2.0;
                        }).distance();
    return risks;
  }();
  return kRisks;
}
constexpr double kCanalTop_mm = -4.0, kBall_mm = 1.0;

/// The ball's surface `clear_mm` off the canal, moving with this velocity.
haptics::Tick near(double clear_mm, double force_N, const glm::dvec3& velocity_mm_per_s, int n) {
  haptics::Tick tick;
  tick.dt_s = 0.001;
  tick.t_s = 0.001 * n;
  tick.proxy_P.mm = {0.0, 0.0, kCanalTop_mm + clear_mm + kBall_mm};
  tick.hand.X_PT.translation_mm = tick.proxy_P.mm;
  tick.hand.velocity_P_mm_per_s.xyz = velocity_mm_per_s;
  tick.law_force_P_N.xyz = {0.0, 0.0, force_N};
  tick.drilling = true;
  tick.overlap_mm3 = 1.0;
  return tick;
}

TEST(NearWork, TwoNewtonsForThreeSecondsAreSixNewtonSeconds) {
  NearWork work(straightCanal());
  for (int n = 0; n < 3000; ++n) work.add(near(1.0, 2.0, {}, n), kBallBur);
  for (int n = 0; n < 3000; ++n) work.add(near(5.0, 9.0, {}, 3000 + n), kBallBur);
  const auto values = work.values();
  EXPECT_NEAR(valueNamed(values, "S3.canal_impulse"), 6.0, 1e-6);
  EXPECT_NEAR(valueNamed(values, "S3.canal_max"), 2.0, 1e-9);
  EXPECT_NEAR(valueNamed(values, "S3.canal_p95"), 2.0, 0.02);
  EXPECT_FALSE(named(values, "S3.lingual_max").value) << "the case has none";
  EXPECT_FALSE(named(values, "S3.lingual_max").why.empty());
}

TEST(NearWork, ARampOfFourMillimetresAtOneNewtonIsARiskOfOne) {
  NearWork work(straightCanal());
  for (int n = 0; n < 4000; ++n) work.add(near(4.0 - 0.001 * n, 1.0, {0.0, 0.0, -1.0}, n), kBallBur);
  EXPECT_NEAR(valueNamed(work.values(), "S4.canal"), 1.0, 0.1);
}

TEST(NearWork, HeadOnIsTheSpeedAndAlongIsNone) {
  NearWork head_on(straightCanal()), along(straightCanal()), far(straightCanal());
  for (int n = 0; n < 100; ++n) {
    head_on.add(near(3.0 - 0.005 * n, 0.0, {0.0, 0.0, -5.0}, n), kBallBur);
    along.add(near(3.0, 0.0, {5.0, 0.0, 0.0}, n), kBallBur);
    far.add(near(6.0, 0.0, {0.0, 0.0, -5.0}, n), kBallBur);
  }
  EXPECT_NEAR(valueNamed(head_on.values(), "S5.canal"), 5.0, 0.1);
  EXPECT_NEAR(valueNamed(along.values(), "S5.canal"), 0.0, 0.2);
  EXPECT_EQ(valueNamed(far.values(), "S5.canal"), 0.0);
}

TEST(NearWork, OneFastTickAmongSlowOnesIsTheApproach) {
  NearWork work(straightCanal());
  for (int n = 0; n < 100; ++n) work.add(near(3.0, 0.0, {0.0, 0.0, n == 47 ? -50.0 : -1.0}, n), kBallBur);
  EXPECT_NEAR(valueNamed(work.values(), "S5.canal"), 50.0, 1.0);
}

TEST(ContactEnvelope, ExpertsThemselvesAreAboveInATwentieth) {
  ContactEnvelope experts, rough;
  for (int n = 0; n < 4000; ++n) {
    const double u = (n % 100 + 0.5) / 100.0;
    experts.add(static_cast<std::size_t>(n % 4), 3.0 * u * u, 40.0 * u, 0.001);
    rough.add(2, 8.0, 5.0, 0.001);
  }
  EXPECT_NEAR(ContactEnvelope::shareAbove(experts.force_s, experts.force_s).value(), 0.05, 1e-6);
  EXPECT_NEAR(ContactEnvelope::shareAbove(experts.speed_s, experts.speed_s).value(), 0.05, 1e-6);
  EXPECT_EQ(ContactEnvelope::shareAbove(rough.force_s, experts.force_s), 1.0);
  EXPECT_EQ(ContactEnvelope::shareAbove(rough.speed_s, experts.speed_s), 0.0);
  EXPECT_FALSE(ContactEnvelope::shareAbove(rough.force_s, ContactEnvelope().force_s));
  EXPECT_TRUE(ContactEnvelope().isEmpty());
}

TEST(HeatedCell, SettlesWhereHeatAndCoolingAreEqual) {
  HeatedCell cell;
  const double power_W = 0.6, cooling_W_per_K = 0.2;
  for (int n = 0; n < 5000; ++n) cell.step(0.001 * n, 0.001, power_W, cooling_W_per_K);
  EXPECT_NEAR(cell.over_K, power_W / cooling_W_per_K, 1e-9);
  cell.step(100.0, 0.001, 0.0, cooling_W_per_K);
  EXPECT_NEAR(cell.over_K, 0.0, 1e-9) << "left alone";
}

TEST(TissueWork, TellsOfForceSoftTissueHeatAndBurs) {
  TissueWork work;
  haptics::Command command;
  command.tool = kBallBur;
  int n = 0;
  const auto drill = [&](double force_N, assets::Tissue tissue, assets::SoftTissue soft, int ticks) {
    for (int end = n + ticks; n < end; ++n) {
      haptics::Tick tick = near(10.0, force_N, {}, n);
      tick.contact_tissue = static_cast<std::uint8_t>(tissue);
      tick.soft.bur_cuts = soft;
      tick.removed_mm3 = 0.01;
      tick.spindle_rad_per_s = 4000.0;
      work.add(tick, command);
    }
  };
  drill(2.0, assets::Tissue::cortical, assets::SoftTissue::none, 1000);
  const double heat_K = TissueWork::kHeatShare * 2.0 * 4.0 / TissueWork::kWet_W_per_K;
  EXPECT_NEAR(valueNamed(work.values({}), "S11.heat"), heat_K, 1e-6);
  EXPECT_EQ(valueNamed(work.values({}), "S8.bone"), 0.0);
  drill(13.0, assets::Tissue::cortical, assets::SoftTissue::lip, 100);
  drill(7.0, assets::Tissue::enamel, assets::SoftTissue::none, 1000);
  drill(7.0, assets::Tissue::enamel, assets::SoftTissue::lip, 100);
  command.tool.head.radius_mm = 1.5;
  drill(1.0, assets::Tissue::cortical, assets::SoftTissue::none, 1100);
  const auto values = work.values(1.5);
  EXPECT_NEAR(valueNamed(values, "S8.bone"), 0.1, 1e-9);
  EXPECT_NEAR(valueNamed(values, "S8.tooth"), 1.1, 1e-9);
  EXPECT_NEAR(valueNamed(values, "S9.time"), 0.2, 1e-9);
  EXPECT_EQ(valueNamed(values, "S9.events"), 2.0);
  EXPECT_EQ(valueNamed(values, "M9.changes"), 1.0);
  EXPECT_NEAR(valueNamed(values, "M9.planned_size"), 0.5, 1e-9);
  EXPECT_FALSE(named(work.values({}), "M9.planned_size").value);
}

}  // namespace
}  // namespace app
