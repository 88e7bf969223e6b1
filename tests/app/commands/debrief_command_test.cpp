// `molar debrief --headless`: pictures of any moment of a recorded session, made from the file alone.
#include <filesystem>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class DebriefCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("XDG_CACHE_HOME", MOLAR_TEST_CACHE, 1);
    setenv("MOLAR_CALIBRATION", at("store").c_str(), 1);
  }
  void rehearse(const std::string& file, const std::string& more) {
    const ProgramOutput said = molar("rehearse --headless --pace fast --device scripted --voxel 0.6 --size 96x64 " +
                                     more + " --record " + at(file));
    ASSERT_EQ(said.status, 0) << said.err;
  }
  std::string picture(const std::string& sessions, const std::string& at_s, const std::string& more = "") {
    const ProgramOutput said = molar("debrief " + sessions + " --headless --size 160x100 --renderer cpu --force --at " +
                                     at_s + " --snapshot " + at("p.png") + more);
    EXPECT_EQ(said.status, 0) << said.err;
    return read("p.png");
  }
};

TEST_F(DebriefCommand, ShowsAMomentTheSameEachTime) {
  rehearse("a.molar", "--seconds 8");
  const std::string a = at("a.molar"), early = picture(a, "2"), late = picture(a, "7");
  EXPECT_FALSE(early.empty());
  EXPECT_NE(early, late);
  EXPECT_EQ(picture(a, "2"), early);
  EXPECT_NE(picture(a, "7", " --trail force"), late);
  EXPECT_EQ(picture(a, "700"), picture(a, "8.1")) << "the end";
  EXPECT_NE(picture(a + " " + a, "7"), late) << "two of them";
}

TEST_F(DebriefCommand, EndsInOrderWithOpenGl) {
  rehearse("a.molar", "--seconds 1");
  const ProgramOutput said =
      molar("debrief " + at("a.molar") + " --headless --size 96x64 --renderer gl-fragment --at 0.5 --snapshot " +
            at("p.png"));
  if (said.status == 2 && said.err.find("OpenGL") != std::string::npos) GTEST_SKIP() << said.err;
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read("p.png").substr(1, 3), "PNG");
}

TEST_F(DebriefCommand, WritesAPartAsPictures) {
  rehearse("a.molar", "--seconds 2");
  const ProgramOutput said = molar("debrief " + at("a.molar") + " --headless --size 96x64 --renderer cpu --clip " +
                                   at("clip") + " --from 0.5 --to 0.9 --rate 10");
  ASSERT_EQ(said.status, 0) << said.err;
  for (const char* name : {"clip/frame_00000.png", "clip/frame_00004.png"})
    EXPECT_TRUE(std::filesystem::exists(at(name))) << name;
  EXPECT_FALSE(std::filesystem::exists(at("clip/frame_00005.png")));
}

TEST_F(DebriefCommand, RefusesInOneLine) {
  rehearse("a.molar", "--seconds 1");
  rehearse("left.molar", "--seconds 1 --case shallow");
  const std::string a = "debrief " + at("a.molar"), out = " --headless --snapshot " + at("p.png");
  expectRefusal(a + " --headless", "nothing is asked for");
  expectRefusal(a + " --headless --clip " + at("c") + " --from 2 --to 1", "a later --to");
  expectRefusal("debrief " + at("none.molar") + out, "none.molar");
  expectRefusal(a + " " + at("left.molar") + out, "another case");
  write("a.bookmarks.json", "{\"molar_bookmarks\": 1, \"bookmarks\": 7}");
  expectRefusal(a + out, "a.bookmarks.json");
  EXPECT_EQ(molar("report " + at("a.molar") + " --out " + at("r.html")).status, 0) << "a report shows no bookmarks";
}

}  // namespace
}  // namespace app
