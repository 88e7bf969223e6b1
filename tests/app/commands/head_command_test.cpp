// Force and removed volume of every head on flat bone, against closed forms.
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"
#include "tests/app/half_space.h"

namespace app {
namespace {

using std::numbers::pi;

struct HeadOverBone {
  const char* tool;
  double half_mm;         ///< from the middle to the lowest point, standing on its end
  double whole_mm3;       ///< of the head
  double half_depth_mm3;  ///< of its part 0.5 mm deep in flat bone
};

const std::vector<HeadOverBone> kHeads = {
    {"sphere:1.5", 1.5, 4.0 / 3.0 * pi * 3.375, pi * 0.25 * (1.5 - 0.5 / 3.0)},
    {"capsule:1,2", 2.0, 4.0 / 3.0 * pi + 2.0 * pi, pi * 0.25 * (1.0 - 0.5 / 3.0)},
    {"cylinder:1,3", 1.5, 3.0 * pi, 0.5 * pi},
    {"cone:1.5,2", 1.0, 1.5 * pi, pi / 3.0 * std::pow(0.5 * 1.5 / 2.0, 2) * 0.5},
    {"wheel:1,1.5", 0.75, 1.5 * pi, 0.5 * pi},
    // Its lower end is 0.6 of the radius.
    {"taper:1,3", 1.5, 1.96 * pi, pi / 6.0 * (0.36 + 0.4 + 0.4 / 0.9)}};

class HeadCommand : public ProgramTest {};

TEST_F(HeadCommand, EveryHeadGivesItsDepth) {
  writeHalfSpace(at("v.nrrd"), 0.1, {0, 0, 1}, 0.02, 6.0);
  for (const HeadOverBone& head : kHeads) {
    write("p.csv", poseCsv({{0.0, 0.013, 0.027, 0.02 + head.half_mm - 0.5}}));
    const ProgramOutput said =
        molar("feel --volume " + at("v.nrrd") + " --field solid --tool " + head.tool + " --poses " + at("p.csv") +
              " --set stiffness_N_per_mm=1 --out " + at("f.csv") + " --force");
    ASSERT_EQ(said.status, 0) << said.err;
    std::istringstream rows(read("f.csv"));
    std::string line;
    std::getline(rows, line);
    std::vector<double> felt;
    for (std::string number; std::getline(rows, number, ',');) felt.push_back(std::stod(number));
    ASSERT_EQ(felt.size(), 9u);
    EXPECT_NEAR(felt[3], 0.5, 0.02) << head.tool;
    EXPECT_NEAR(felt[7], head.half_depth_mm3, 0.02 * head.half_depth_mm3 + 0.015) << head.tool;
    EXPECT_NEAR(felt[8], 0.5, 0.02) << head.tool;
  }
}

TEST_F(HeadCommand, EveryHeadRemovesItsVolume) {
  writeHalfSpace(at("v.nrrd"), 0.1, {0, 0, 1}, 2.5, 6.0);
  write("p.csv", poseCsv({{0.0, 0.013, 0.027, 0.0}, {0.2, 0.013, 0.027, 0.0}}));
  for (const HeadOverBone& head : kHeads) {
    const ProgramOutput said =
        molar("carve --volume " + at("v.nrrd") + " --field solid --tool " + head.tool + " --poses " + at("p.csv") +
              " --set removal_rate_per_s=100 --out " + at("c.nrrd") + " --force");
    ASSERT_EQ(said.status, 0) << said.err;
    const double removed_mm3 = nlohmann::json::parse(said.out).at("removed_mm3").get<double>();
    EXPECT_NEAR(removed_mm3, head.whole_mm3, 0.01 * head.whole_mm3) << head.tool;
  }
}

TEST_F(HeadCommand, InvalidHeadsAreRefusedWithTheAcceptedForms) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0, 4.0);
  write("p.csv", poseCsv({{0.0, 0.0, 0.0, 1.0}, {0.1, 0.0, 0.0, 1.0}}));
  for (const char* tool : {"cone:1", "cylinder:0,2", "capsule:1,x", "disc:1,2"})
    for (const char* command : {"feel", "carve"}) {
      const ProgramOutput said = molar(std::string(command) + " --volume " + at("v.nrrd") + " --field solid --tool " +
                                       tool + " --poses " + at("p.csv") + " --out " + at("o.nrrd"));
      EXPECT_EQ(said.status, 2) << tool;
      EXPECT_NE(said.err.find("give "), std::string::npos) << said.err;
    }
}

}  // namespace
}  // namespace app
