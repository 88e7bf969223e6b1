#include <cstdlib>

#include "tests/app/commands/program.h"

namespace app {
namespace {

class DisplayCommand : public ProgramTest {};

TEST_F(DisplayCommand, WritesEveryPatternAsAnImage) {
  for (const char* pattern : {"eyes", "crosstalk", "grid", "cross", "text"}) {
    const std::string name = std::string(pattern) + ".png";
    const ProgramOutput said =
        molar("display --display side-by-side --size 320x200 --pattern " + std::string(pattern) + " --out " + at(name));
    EXPECT_EQ(said.status, 0) << said.err;
    EXPECT_EQ(read(name).substr(1, 3), "PNG");
  }
  expectRefusal("display --pattern eyes --size 320x200 --out " + at("eyes.png"), "eyes.png");
}

TEST_F(DisplayCommand, RefusesInvalidOptions) {
  expectRefusal("display --pattern snow --out " + at("a.png"), "crosstalk");
  expectRefusal("display --display hologram --out " + at("a.png"), "row-interleaved");
  expectRefusal("display --display frame-packing --size 640x480 --out " + at("a.png"), "1280x720");
  expectRefusal("display --display two-windows --size 320x200 --out " + at("a.png"), "two outputs");
  expectRefusal("display --size 99999x99999 --out " + at("a.png"), "16384");
  expectRefusal("display --rig " + at("none.yaml") + " --out " + at("a.png"), "none.yaml");
}

TEST_F(DisplayCommand, OpensAndFallsBackWithoutStereo) {
  if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no DISPLAY: run under xvfb-run";
  for (const char* mode : {"mono", "row-interleaved", "two-windows", "anaglyph"}) {
    const ProgramOutput said = molar("display --windowed --size 160x100 --seconds 0.3 --display " + std::string(mode));
    EXPECT_EQ(said.status, 0) << mode << said.err;
    EXPECT_EQ(said.err, "") << mode;
  }
  // Software rasterisers have none; a machine that has must say nothing.
  const ProgramOutput quad = molar("display --windowed --size 160x100 --seconds 0.3 --display quad-buffer");
  EXPECT_EQ(quad.status, 0) << quad.err;
  EXPECT_TRUE(quad.err.empty() || quad.err.find("showing mono") != std::string::npos) << quad.err;
  const ProgramOutput listed = molar("display --monitors");
  EXPECT_EQ(listed.status, 0);
  EXPECT_NE(listed.out.find("Hz"), std::string::npos);
}

}  // namespace
}  // namespace app
