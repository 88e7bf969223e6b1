// What a treatment has come to while it goes on, against the same measured at once.
#include "app/procedure/root_canal/treatment_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "app/procedure/root_canal/dense_tooth.h"
#include "assets/tissue.h"

namespace app {
namespace {

/// Two straight canals in a block of dentine, whose size is no whole number of blocks.
struct Block {
  assets::ToothCanals tooth;
  assets::CtVolume ct;

  Block() {
    tooth.chamber.outline_mm = {{0.0, 0.0}, {4.0, 0.0}};
    tooth.chamber.roof_mm = 1.0, tooth.chamber.floor_mm = 0.0;
    for (const double x : {0.0, 4.0}) {
      assets::ToothCanal canal;
      canal.name = x == 0.0 ? "first" : "second";
      for (int n = 0; n <= 10; ++n) canal.places.push_back({{x, 0.0, -1.0 * n}, 1.0 * n, 0.3, 0.3});
      canal.reference_P_mm = {0.0, 0.0, 3.0};
      tooth.canals.push_back(canal);
    }
    ct.grid = {{81, 41, 129}, 0.1, {-2.0, -2.0, -11.0}};
    ct.solid.assign(ct.grid.voxelCount(), 255);
    ct.label.assign(ct.grid.voxelCount(), static_cast<std::uint8_t>(assets::Tissue::dentine));
    const assets::PulpDistance pulp(tooth);
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const double mm = pulp.at_mm(ct.grid.centre_P_mm(ijk));
      ct.solid[v] = static_cast<std::uint8_t>(255.0 * std::clamp(0.5 + mm / ct.grid.spacing_mm, 0.0, 1.0) + 0.5);
    });
  }
};

/// Until it is measured; a minute at most.
bool awaitMeasured(TreatmentWatch& watch, const haptics::Tick& tick, const FileUse& files) {
  for (int n = 0; n < 6000; ++n) {
    if (watch.follow({}, tick, files)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(TreatmentWatch, MeasuresAMomentAfterAStrokeWhatIsMeasuredAtOnce) {
  const Block block;
  haptics::Bodies bodies(block.ct.grid, block.ct.solid, block.ct.label);
  const FileUse files(block.tooth);
  TreatmentWatch watch(block.tooth, block.ct, block.ct.solid, bodies);
  haptics::BurShape head;
  head.radius_mm = 0.5;
  haptics::ErosionStep step;
  step.loss.fill(0.3);
  for (std::uint64_t tick = 0; tick < 10; ++tick)
    haptics::carveTool(bodies, head, {{1.0, 0.0, 0.0, 0.0}, {0.1, 0.0, -6.0}}, step, tick);
  std::vector<glm::ivec3> bricks;
  bodies.takeDirtyBricks(bricks);
  ASSERT_FALSE(bricks.empty());

  haptics::Tick tick;
  tick.dt_s = 0.001, tick.t_s = 5.0;
  tick.drilling = true;
  watch.follow({}, tick, files);
  tick.t_s = 5.2, tick.drilling = false;
  EXPECT_FALSE(watch.follow({}, tick, files)) << "nothing has changed";
  EXPECT_FALSE(watch.newest());
  tick.t_s = 6.0;
  watch.follow(bricks, tick, files);
  ASSERT_TRUE(awaitMeasured(watch, tick, files));
  const Treatment& found = *watch.newest();
  EXPECT_GT(found.canals[0].outcomes.removed_mm3, 0.05);
  EXPECT_EQ(found.canals[1].outcomes.removed_mm3, 0.0);

  // The same from the bodies' bytes.
  const std::vector<std::uint8_t> now = bodies.solidInGridOrder();
  double lost_mm3 = 0.0;
  for (std::size_t v = 0; v < now.size(); ++v)
    lost_mm3 += (block.ct.solid[v] - now[v]) / 255.0 * block.ct.grid.voxelVolume_mm3();
  EXPECT_NEAR(found.canals[0].outcomes.removed_mm3, lost_mm3, 1e-9);
  EXPECT_EQ(watch.times(), 1);
  EXPECT_GT(watch.longest_s(), 0.0);
  const std::string line = treatmentLine(found);
  EXPECT_NE(line.find("first 0."), std::string::npos) << line;
  EXPECT_EQ(line.find("second"), std::string::npos) << line;
}

}  // namespace
}  // namespace app
