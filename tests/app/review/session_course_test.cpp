#include "app/review/session_course.h"

#include <gtest/gtest.h>

#include "app/session/session_writer.h"
#include "app/session/touch_event.h"
#include "tests/app/session/small_session.h"

namespace app {
namespace {

/// 3 s: in bone from 0.5 to 1.0 and from 1.2 to 1.4 s with 2 N, from 2.4 s on with 0.6 N; a wider bur from 2 s on.
class SessionCourseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const test::SmallBone bone;
    SessionWriter writer(path_, false, bone.start());
    SessionBatch batch;
    haptics::Command command = bone.start().command;
    command.tool.head.radius_mm = 1.5;
    batch.commands.push_back({command, 0});
    for (std::uint64_t n = 0; n < 3000; ++n) {
      haptics::Tick tick = test::imaginedTick(n);
      const double t_s = 1e-3 * static_cast<double>(n);
      tick.drilling = (t_s >= 0.4999 && t_s < 0.9999) || (t_s >= 1.1999 && t_s < 1.3999) || t_s >= 2.3999;
      tick.overlap_mm3 = tick.drilling ? 0.1 : 0.0;
      tick.law_force_P_N.xyz = {0.0, 0.0, t_s < 2.0 ? 2.0 : 0.6};
      tick.removed_mm3 = tick.drilling ? 0.01 : 0.0;
      tick.restored_total_mm3 = n >= 1600 ? 0.5 : 0.0;
      batch.ticks.push_back(tick);
    }
    command.serial = 2;
    command.tool.head.radius_mm = 2.0;
    batch.commands.push_back({command, 2000});
    batch.events = {{100, "quality", "step 2"},
                    {900, kTouchEvent, touchText({"mandibular canal", 0.1})},
                    {920, kTouchEvent, touchText({"lower right third molar", 0.1})},
                    {950, "snapshot", "/a/path/of/somebody.png"}};
    writer.write(batch);
    writer.seal(0);
  }
  tests::ScratchFolder folder_;
  std::string path_ = folder_.file("s.molar");
};

TEST_F(SessionCourseTest, TellsWhenTheDrillWasInBone) {
  SessionReader session(path_);
  const SessionCourse course = courseOf(session);
  EXPECT_NEAR(course.duration_s, 3.0, 1e-9);
  ASSERT_EQ(course.drilling.size(), 2U) << "a pause of 0.2 s is bridged";
  EXPECT_NEAR(course.drilling[0].from_s, 0.5, 1e-6);
  EXPECT_NEAR(course.drilling[0].to_s, 1.4, 1e-6);
  EXPECT_NEAR(course.drilling[1].to_s, 3.0, 1e-6);
}

TEST_F(SessionCourseTest, SumsForceAndVolumeByTime) {
  SessionReader session(path_);
  const SessionCourse course = courseOf(session);
  ASSERT_EQ(course.most_force_N.size(), 6U);
  EXPECT_EQ(course.most_force_N[1], 2.0);
  EXPECT_EQ(course.most_force_N[5], 0.6);
  EXPECT_NEAR(course.removed_mm3[1], 5.0, 1e-9);
  EXPECT_NEAR(course.removed_mm3[0], 0.0, 1e-9);
  EXPECT_NEAR(course.force_s[8], 0.7, 1e-6) << "2 N";
  EXPECT_NEAR(course.force_s[2], 0.6, 1e-6) << "0.6 N";
}

TEST_F(SessionCourseTest, NamesInstrumentsAndWhatHappenedButNoPath) {
  SessionReader session(path_);
  const SessionCourse course = courseOf(session);
  ASSERT_EQ(course.tools.size(), 2U);
  EXPECT_EQ(course.tools[0].what, "round 3.0 mm, ISO 030");
  EXPECT_NEAR(course.tools[1].from_s, 2.0, 1e-6);
  ASSERT_EQ(course.marks.size(), 2U);
  EXPECT_EQ(course.marks[0].what, "mandibular canal touched");
  EXPECT_EQ(course.marks[1].what, "undone");
  EXPECT_NEAR(course.marks[1].t_s, 1.6, 1e-6);
}

TEST_F(SessionCourseTest, TheSessionCanBeReadAgain) {
  SessionReader session(path_);
  courseOf(session);
  EXPECT_NEAR(courseOf(session).duration_s, 3.0, 1e-9);
}

}  // namespace
}  // namespace app
