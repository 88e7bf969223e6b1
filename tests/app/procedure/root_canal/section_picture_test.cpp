#include "app/procedure/root_canal/section_picture.h"

#include <gtest/gtest.h>

#include "tests/app/procedure/root_canal/at_once.h"
#include "tests/app/procedure/root_canal/shapes.h"

namespace app::drawn_sections {
namespace {

/// A round root of 1.2 mm with a canal of 0.15; prepared to 0.3 mm, moved aside by `e`.
double root(const glm::dvec3& p) { return std::min(1.2 - std::hypot(p.x, p.y), std::hypot(p.x, p.y) - 0.15); }

render::Image picture(double e) {
  const assets::VolumeGrid grid = shapes::gridOf({-1.4, -1.4, -10.4}, {1.4, 1.4, 0.4}, 0.05);
  const ToothBlocks before(shapes::ShapeTooth(grid, root, [](const glm::dvec3& p) {
    if (std::hypot(p.x, p.y) > 1.2) return assets::Tissue::ligament;
    return root(p) < 0.0 ? assets::Tissue::pulp : assets::Tissue::dentine;
  }));
  const shapes::ShapeSolid after(
      grid, [e](const glm::dvec3& p) { return e < 0.0 ? root(p) : std::min(root(p), std::hypot(p.x - e, p.y) - 0.3); });
  const CanalOutcomes out =
      shapes::outcomesAtOnce(before, after, {shapes::straightCanal(10.0, 0.15)}, 0, {1.0, 0.0, 0.0});
  return sectionPicture({{"36 distal", out.sections}});
}

/// Pixels of the line as it is, and the mean of their places within the panels, to the right positive.
struct Orange {
  int count = 0;
  double right = 0.0;
};
Orange orangeOf(const render::Image& image) {
  Orange orange;
  constexpr int kPanel = 250;
  for (int y = 0; y < image.h; ++y)
    for (int x = 0; x < image.w; ++x) {
      const std::uint8_t* const px = image.rgba.data() + 4 * (y * image.w + x);
      if (px[0] < 180 || px[1] > 130 || px[2] > 90) continue;
      ++orange.count;
      orange.right += x % kPanel - kPanel / 2;
    }
  if (orange.count > 0) orange.right /= orange.count;
  return orange;
}

TEST(SectionPicture, DrawsWhatWasCutWhereItWasCut) {
  EXPECT_EQ(orangeOf(picture(-1.0)).count, 0) << "nothing was cut";
  const Orange centred = orangeOf(picture(0.0)), aside = orangeOf(picture(0.2));
  EXPECT_GT(centred.count, 200);
  EXPECT_NEAR(centred.right, 0.0, 2.0);
  EXPECT_GT(aside.right, 4.0) << "the furcation is to the right";
  const render::Image drawn = picture(0.2);
  EXPECT_EQ(drawn.w, 4 * 250);
}

}  // namespace
}  // namespace app::drawn_sections
