#include <nlohmann/json.hpp>

#include "tests/app/half_space.h"
#include "tests/app/program.h"

namespace app {
namespace {

constexpr char kCamera[] = "'{\"eye_mm\":[3,-30,40],\"look_at_mm\":[0,0,0],\"up\":[0,0,1],\"fov_y_deg\":20}'";

class SeeCommand : public ProgramTest {};

/// Distances of the picture that `see --depth` wrote: a 2-D gzip NRRD, read as a volume of one slice.
TEST_F(SeeCommand, PutsTheFaceWhereTheMatricesSay) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  const Said said =
      molar("see --volume " + at("v.nrrd") + " --field solid --size 96x64 --samples 1 --camera " + kCamera + " --out " +
            at("a.png") + " --depth " + at("d.nrrd") + " --matrices " + at("m.json"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read("a.png").substr(1, 3), "PNG");
  const auto json = nlohmann::json::parse(read("m.json"));
  EXPECT_EQ(json.at("size"), (nlohmann::json{96, 64}));
  const auto m = json.at("clip_from_P").get<std::vector<double>>();
  ASSERT_EQ(m.size(), 16u);
  // The point looked at is in the middle of the picture.
  EXPECT_NEAR(m[3] / m[15], 0.0, 1e-9);
  EXPECT_NEAR(m[7] / m[15], 0.0, 1e-9);
}

TEST_F(SeeCommand, DrawsTheSamePictureTwice) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  for (const char* name : {"a.png", "b.png"})
    ASSERT_EQ(molar("see --volume " + at("v.nrrd") + " --field solid --size 64x48 --samples 1 --camera " +
                    std::string(kCamera) + " --out " + at(name))
                  .status,
              0);
  EXPECT_EQ(read("a.png"), read("b.png"));
}

TEST_F(SeeCommand, ShowsWhatWasCarved) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  write("p.csv", poseCsv({{0, 0, 0, 0.5}, {1, 0, 0, 0.5}}));
  ASSERT_EQ(
      molar("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --set removal_rate_per_s=20 --poses " +
            at("p.csv") + " --out " + at("c.nrrd"))
          .status,
      0);
  for (const char* name : {"v", "c"})
    ASSERT_EQ(molar("see --volume " + at(name) + ".nrrd --field solid --size 64x48 --samples 1 --camera " +
                    std::string(kCamera) + " --out " + at(name) + ".png")
                  .status,
              0);
  EXPECT_NE(read("v.png"), read("c.png"));
}

}  // namespace
}  // namespace app
