#include "tests/app/commands/program.h"
#include "tests/app/half_space.h"

namespace app {
namespace {

class BadInput : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    writeHalfSpace(at("v.nrrd"), 0.5, {0, 0, 1}, 0.0);
    write("p.csv", poseCsv({{0, 0, 0, 1}, {1, 0, 0, 1}}));
  }
  std::string feel(const std::string& volume, const std::string& poses, const std::string& more = "") const {
    return "feel --volume " + at(volume) + " --field solid --tool sphere:2 --poses " + at(poses) + " --out " +
           at("f.csv") + " " + more;
  }
};

TEST_F(BadInput, CommandLineIsOneLine) {
  expectRefusal("nonsense");
  expectRefusal("reherse", "did you mean rehearse?");
  expectRefusal("rehearse --recrod s.molar", "did you mean --record?");
  expectRefusal("laws --plot a.jpg", "end the name in .png");
  expectRefusal("rehearse --pedal nowhere", "plugged in");
  expectRefusal("feel");
  expectRefusal("feel --nonsense 3");
  expectRefusal("rehearse --display hologram --headless");
  expectRefusal("rehearse --headless", "--device scripted");
  expectRefusal("rehearse --seconds -1 --headless --device scripted");
  expectRefusal("see --out " + at("a.png"), "exactly one");
}

TEST_F(BadInput, TheProgramAloneHelps) {
  const ProgramOutput said = molar("");
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("Start with\n  molar rehearse\n"), std::string::npos);
  EXPECT_NE(molar("help calibrate fit").out.find("--held-out FILE"), std::string::npos);
}

TEST_F(BadInput, FilesAreNamed) {
  write("empty.nrrd", "");
  write("text.nrrd", "this is no volume");
  const std::string good = read("v.nrrd");
  write("cut.nrrd", good.substr(0, good.size() / 2));
  for (const char* name : {"missing.nrrd", "empty.nrrd", "text.nrrd", "cut.nrrd"})
    expectRefusal(feel(name, "p.csv"), name);
  write("bad.csv", "t_s,px_mm\n0,1\n");
  write("endless.csv", poseCsv({{0, 0, 0, 1}, {1e9, 0, 0, 1}}));
  expectRefusal("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --poses " + at("endless.csv") +
                    " --out " + at("c.nrrd"),
                "hour");
  for (const char* name : {"missing.csv", "bad.csv", "v.nrrd"}) expectRefusal(feel("v.nrrd", name), name);
  expectRefusal("see --volume " + at("v.nrrd") + " --field solid --rig " + at("p.csv") + " --out " + at("a.png"),
                "rig file");
  expectRefusal("see --patient " + at("nobody") + " --out " + at("a.png"), "nobody");
  expectRefusal("rehearse " + at("nobody") + " --headless --device scripted", "nobody");
  expectRefusal("replay " + at("v.nrrd") + " --verify", "v.nrrd");
  expectRefusal("metrics " + at("missing.molar"), "missing.molar");
  expectRefusal("import " + at("p.csv") + " --out " + at("patient"), "p.csv");
}

TEST_F(BadInput, OptionsHaveRanges) {
  expectRefusal(feel("v.nrrd", "p.csv", "--set stiffness_N_per_mm=nan"), "stiffness_N_per_mm");
  expectRefusal(feel("v.nrrd", "p.csv", "--set colour=1"), "molar laws lists");
  expectRefusal(feel("v.nrrd", "p.csv", "--law spring"));
  expectRefusal(feel("v.nrrd", "p.csv", "--served --set stiffness_N_per_mm=50"), "stiffness");
  expectRefusal("rehearse --headless --device scripted --tool sphere:10", "bur radius");
  for (const char* nan : {"--seconds nan", "--loupes nan", "--winter-angle nan", "--voxel 0.001", "--rate nan"})
    expectRefusal(std::string("rehearse --headless --device scripted ") + nan);
  expectRefusal("rehearse --headless --device scripted --record /dev/full --force", "plain file");
  expectRefusal("rehearse --headless --device scripted --snapshot " + at("a.png") + " --first-snapshot " + at("a.png"));
  for (const std::string option : {"--snapshot ", "--first-snapshot "})
    expectRefusal("rehearse --headless --device scripted " + option + at("a.jpg"), option + at("a.jpg"));
  expectRefusal("rehearse " + at("nobody") + " --voxel 0.6", "--voxel");
  const std::string see = "see --volume " + at("v.nrrd") + " --field solid --out " + at("a.png");
  expectRefusal(see + " --size 0x0", "--size");
  expectRefusal(see + " --size 99999x10", "--size");
  expectRefusal(see + " --camera '{}'", "eye_mm");
  expectRefusal(see + " --camera '{\"eye_mm\":[0,0,1],\"look_at_mm\":[0,0,1]}'");
  expectRefusal(see + " --renderer vulkan", "gl-fragment");
  expectRefusal(see + " --renderer cpu --mode mesh", "--mode iso");
  expectRefusal(see + " --mode solid", "iso");
}

TEST_F(BadInput, OutputsAreNeverOverwrittenOrPartial) {
  write("f.csv", "precious");
  expectRefusal(feel("v.nrrd", "p.csv"), "f.csv");
  EXPECT_EQ(read("f.csv"), "precious");
  const std::string poses = read("p.csv");
  expectRefusal("feel --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --force --poses " + at("p.csv") +
                    " --out " + at("p.csv"),
                "input");
  EXPECT_EQ(read("p.csv"), poses);
  const std::size_t before = fileCount();
  expectRefusal(feel("missing.nrrd", "p.csv", "--force"));
  EXPECT_EQ(read("f.csv"), "precious") << "a failing command keeps the old file";
  expectRefusal("carve --volume " + at("missing.nrrd") + " --tool sphere:2 --poses " + at("p.csv") + " --out " +
                at("c.nrrd"));
  expectRefusal("see --volume " + at("missing.nrrd") + " --out " + at("a.png") + " --depth " + at("d.nrrd"));
  EXPECT_EQ(fileCount(), before);
  EXPECT_EQ(molar(feel("v.nrrd", "p.csv", "--force")).status, 0);
  EXPECT_NE(read("f.csv"), "precious");
}

}  // namespace
}  // namespace app
