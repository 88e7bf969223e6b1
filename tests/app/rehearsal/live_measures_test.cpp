#include "app/rehearsal/live_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace app {
namespace {

/// Strokes over a block's face, with a change of water and bur on the way.
struct Work {
  assets::CtVolume ct;
  std::vector<haptics::Tick> ticks;
  haptics::Command first, second;

  Work() {
    ct.grid = {{40, 40, 20}, 0.5, glm::dvec3(0.0)};
    ct.solid.assign(ct.grid.voxelCount(), 0);
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) { ct.solid[v] = ijk.z < 10 ? 255 : 0; });
    first.tool = {{haptics::ShapeKind::sphere, 1.0, 0.0}, {}};
    second = first;
    second.irrigating = false;
    second.tool.head.radius_mm = 1.5;
    for (std::uint64_t n = 0; n < 6000; ++n) {
      haptics::Tick tick;
      tick.index = n;
      tick.dt_s = 0.001;
      tick.t_s = 0.001 * static_cast<double>(n);
      tick.command_serial = n < 3333 ? 1 : 2;
      const double s = 6.0 * tick.t_s;
      tick.proxy_P.mm = {10.0 + 3.0 * std::sin(s), 8.0 + 0.6 * tick.t_s, 5.2};
      tick.hand.X_PT.translation_mm = tick.proxy_P.mm;
      tick.hand.velocity_P_mm_per_s.xyz = {18.0 * std::cos(s), 0.6, 0.0};
      tick.law_force_P_N.xyz = {0.0, 0.0, 1.5 + 0.2 * std::sin(3.0 * s)};
      tick.drilling = n > 100;
      tick.overlap_mm3 = 0.3;
      tick.removed_mm3 = 0.002;
      ticks.push_back(tick);
    }
  }
};

TEST(LiveMeasures, AreThoseOfTheRecording) {
  const Work work;
  const OriginalSurface surface(work.ct.grid, work.ct.solid);
  HandWork recorded;
  for (const haptics::Tick& tick : work.ticks)
    recorded.add(workSample(tick, tick.command_serial == 1 ? work.first : work.second, &surface));
  recorded.finish();

  LiveMeasures live(work.ct, false);
  // Frames of a sixtieth of a second; the command changes before its first tick is read.
  for (std::size_t at = 0; at < work.ticks.size(); at += 17) {
    const std::size_t end = std::min(at + 17, work.ticks.size());
    live.follow(std::span(work.ticks).subspan(at, end - at), end < 3320 ? work.first : work.second, end < 3320 ? 1 : 2);
  }
  live.finish();
  ASSERT_EQ(live.values().size(), 6u);
  for (const MeasureValue& value : live.values()) {
    const auto all = recorded.values();
    const auto same = std::ranges::find(all, value.id, &MeasureValue::id);
    EXPECT_EQ(value.value, same->value) << value.id << ", to the bit";
    EXPECT_TRUE(value.id != "S10.dry" || value.value > 2.0) << "the change of water counts";
  }
  EXPECT_NE(live.text().find("\"S10.dry\":"), std::string::npos);
}

}  // namespace
}  // namespace app
