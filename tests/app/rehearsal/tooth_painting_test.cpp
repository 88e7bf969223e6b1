// What of the measures is painted on the tooth, by the layers of the picture.
#include "app/rehearsal/tooth_painting.h"

#include <gtest/gtest.h>

namespace app {
namespace {

const assets::VolumeGrid kVolume{glm::ivec3(40), 0.1, glm::dvec3(-2.0)};
const assets::VolumeGrid kBox{glm::ivec3(16), 0.1, glm::dvec3(-2.0) + 0.1 * glm::dvec3(8, 4, 12)};

PreparationPaint measured() {
  PreparationPaint paint;
  paint.box = kBox;
  paint.deviation = {{0, 0xff0000ff}, {17, 0xff0000ff}};
  paint.undercut = {{17, 0xff00ff00}};
  paint.arrow = render::GuideArrow{{{0, 0, 4}}, {{0, 0, 1}}};
  paint.way = "way of insertion 2.0° off the axis", paint.hindered = "undercut 0.10 mm³";
  return paint;
}
BittenTooth::Marked marked() {
  BittenTooth::Marked marks;
  marks.box = kBox;
  marks.bite.paper_mm = 0.04;
  marks.spots = {{17, 0xffff0000}};
  return marks;
}

std::uint32_t texel(const render::Frame& frame, glm::ivec3 ijk) { return *frame.paint->texels.at(ijk); }

TEST(ToothPainting, PaintsWhatItsLayersAskForLaterOverEarlier) {
  ToothPainting painting(kVolume);
  const PreparationPaint paint = measured();
  const BittenTooth::Marked marks = marked();
  render::Frame frame;
  painting.show(frame);
  EXPECT_EQ(frame.paint, nullptr) << "nothing was measured";
  painting.take(paint);
  painting.show(frame);
  EXPECT_EQ(frame.paint, nullptr) << "nobody asked";
  EXPECT_FALSE(frame.arrow);

  frame.layers.deviation = true;
  painting.show(frame);
  ASSERT_NE(frame.paint, nullptr);
  EXPECT_EQ(frame.paint->low, glm::ivec3(8, 4, 12));
  EXPECT_EQ(texel(frame, {1, 1, 0}), 0xff0000ffu);
  EXPECT_EQ(texel(frame, {2, 1, 0}), 0u);
  EXPECT_EQ(frame.paint->title, "off the ideal");
  EXPECT_EQ(frame.paint->rows.size(), 5u);
  EXPECT_FALSE(frame.arrow);

  frame.layers.insertion = true;
  painting.show(frame);
  EXPECT_EQ(texel(frame, {1, 1, 0}), 0xff00ff00u) << "undercut over deviation";
  EXPECT_EQ(texel(frame, {0, 0, 0}), 0xff0000ffu);
  EXPECT_TRUE(frame.arrow);
  EXPECT_EQ(frame.paint->rows.back().means, "undercut 0.10 mm³");

  painting.take(marks);
  painting.show(frame);
  EXPECT_EQ(texel(frame, {1, 1, 0}), 0xffff0000u) << "marks over all";
  EXPECT_EQ(frame.paint->rows.back().means, kMadeAntagonist);

  frame.layers.deviation = frame.layers.insertion = false;
  painting.show(frame);
  ASSERT_NE(frame.paint, nullptr);
  EXPECT_EQ(texel(frame, {0, 0, 0}), 0u);
  EXPECT_EQ(frame.paint->title, "bite");
  frame.layers.marks = false;
  painting.show(frame);
  EXPECT_EQ(frame.paint, nullptr);
}

TEST(ToothPainting, HasANewSerialWheneverItIsAnother) {
  ToothPainting painting(kVolume);
  const PreparationPaint paint = measured();
  render::Frame frame;
  frame.layers.deviation = true;
  painting.take(paint);
  painting.show(frame);
  const std::uint64_t first = frame.paint_serial;
  painting.show(frame);
  EXPECT_EQ(frame.paint_serial, first) << "as it was";
  painting.take(paint);
  painting.show(frame);
  EXPECT_NE(frame.paint_serial, first) << "measured anew";
  const std::uint64_t second = frame.paint_serial;
  frame.layers.deviation = false;
  painting.show(frame);
  EXPECT_NE(frame.paint_serial, second) << "put away";
}

}  // namespace
}  // namespace app
