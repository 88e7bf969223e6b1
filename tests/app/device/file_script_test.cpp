// A scripted hand with root-canal files.
#include "app/device/file_script.h"
#include "app/device/access_script.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "assets/synthetic/built_in_teeth.h"

namespace app {
namespace {

assets::ToothCanals firstMolar() { return assets::canalsOf(assets::builtInTooth({}, 46)); }

TEST(FileScript, TakesEverySizeIntoEveryForamen) {
  const assets::ToothCanals tooth = firstMolar();
  const HandScript script = fileScript(tooth);
  const auto foramina = static_cast<std::size_t>(
      std::ranges::count_if(tooth.canals, [](const assets::ToothCanal& canal) { return !canal.joins; }));
  ASSERT_GE(foramina, 2u);
  ASSERT_EQ(script.requests.size(), 4 * foramina + 2);
  EXPECT_EQ(script.requests[0].tool, "k-file:10,25");
  EXPECT_EQ(script.requests[3].tool, "k-file:25,25");
  // Then one of them is filled.
  EXPECT_TRUE(script.requests[4 * foramina].tool.starts_with("gp-cone:")) << script.requests[4 * foramina].tool;
  EXPECT_EQ(script.requests[4 * foramina + 1].tool, "root-plugger");
  for (std::size_t n = 1; n < script.requests.size(); ++n)
    EXPECT_GT(script.requests[n].t_s, script.requests[n - 1].t_s) << n;
}

TEST(FileScript, MovesNoFasterThanAHandAndToTheWorkingLength) {
  const assets::ToothCanals tooth = firstMolar();
  const HandScript script = fileScript(tooth);
  for (std::size_t n = 1; n < script.poses.size(); ++n) {
    const double s = script.poses[n].t_s - script.poses[n - 1].t_s;
    ASSERT_GT(s, 0.0) << n;
    const double way_mm = glm::distance(script.poses[n].X_DH.translation_mm, script.poses[n - 1].X_DH.translation_mm);
    ASSERT_LT(way_mm / s, 30.0) << n;
  }
  // The straight file's tip comes as far from each orifice as its canal is long, less 0.5 mm, and a little more.
  for (const assets::ToothCanal& canal : tooth.canals) {
    if (canal.joins) continue;
    double deepest_mm = 0.0;
    for (const haptics::TimedHandlePose& pose : script.poses) {
      if (pose.t_s > script.requests[script.requests.size() - 2].t_s) break;
      const glm::dvec3 in = pose.X_DH.rotation * glm::dvec3(0.0, 0.0, -1.0);
      const glm::dvec3 tip_P = pose.X_DH.translation_mm + 25.0 * in, beyond = tip_P - canal.orifice_P_mm();
      if (glm::length(beyond - glm::dot(beyond, in) * in) < 1e-6)
        deepest_mm = std::max(deepest_mm, glm::dot(beyond, in));
    }
    EXPECT_NEAR(deepest_mm, canal.length_mm() - 0.5, 0.5) << canal.name;
  }
}

TEST(AccessScript, KeepsTheBurWithinTheChambersOutlineAndOffItsFloor) {
  const assets::ToothCanals tooth = firstMolar();
  const std::vector<glm::dvec3> way_P = accessWay_P(tooth);
  double lowest_mm = 100.0, widest_mm = -100.0;
  for (const glm::dvec3& at_P : way_P) {
    const glm::dvec3 p = tooth.frame.local(at_P);
    lowest_mm = std::min(lowest_mm, p.z - kAccessBurRadius_mm);
    const double over_mm = std::max(0.0, p.z - tooth.chamber.roof_mm);
    widest_mm = std::max(widest_mm, assets::outlineDistance_mm(tooth.chamber.outline_mm, {p.x, p.y}) +
                                        kAccessBurRadius_mm - tooth.chamber.round_mm - 0.1 * over_mm);
  }
  EXPECT_LT(lowest_mm, tooth.chamber.roof_mm) << "through the roof";
  EXPECT_GT(lowest_mm, tooth.chamber.floor_mm + 0.2);
  EXPECT_LT(widest_mm, 0.5) << "a chamber narrower than the bur is no reason to stay out";
  const HandScript script = fileScript(tooth, true);
  EXPECT_EQ(script.requests[0].tool, kAccessBur);
  EXPECT_TRUE(script.poses[1].pedal);
  EXPECT_EQ(script.requests[1].tool, "k-file:10,25");
  const double filled_s = script.requests[script.requests.size() - 2].t_s;
  for (const haptics::TimedHandlePose& pose : script.poses)
    EXPECT_FALSE(pose.pedal && pose.t_s >= script.requests[1].t_s && pose.t_s < filled_s) << pose.t_s;
}

}  // namespace
}  // namespace app
