#include <zlib.h>

#include <nlohmann/json.hpp>

#include "assets/patient/patient_folder.h"
#include "assets/synthetic/jaw.h"
#include "tests/app/commands/program.h"
#include "tests/app/half_space.h"

namespace app {
namespace {

constexpr char kCamera[] = "'{\"eye_mm\":[3,-30,40],\"look_at_mm\":[0,0,0],\"up\":[0,0,1],\"fov_y_deg\":20}'";

class SeeCommand : public ProgramTest {};

/// The floats of a gzip NRRD.
std::vector<float> floatsOf(const std::string& nrrd) {
  EXPECT_NE(nrrd.find("type: float"), std::string::npos);
  EXPECT_NE(nrrd.find("encoding: gzip"), std::string::npos);
  const std::string packed = nrrd.substr(nrrd.find("\n\n") + 2);
  std::vector<float> values(96 * 64);
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(values.data());
  stream.avail_out = static_cast<uInt>(values.size() * sizeof(float));
  EXPECT_EQ(inflateInit2(&stream, 15 + 32), Z_OK);
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.avail_out, 0u);
  inflateEnd(&stream);
  return values;
}

TEST_F(SeeCommand, MeasuresDistancesToAFace) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  const ProgramOutput said =
      molar("see --volume " + at("v.nrrd") + " --field solid --size 96x64 --samples 1 --camera " + kCamera + " --out " +
            at("a.png") + " --depth " + at("d.nrrd") + " --matrices " + at("m.json"));
  ASSERT_EQ(said.status, 0) << said.err;
  EXPECT_EQ(read("a.png").substr(1, 3), "PNG");
  const auto json = nlohmann::json::parse(read("m.json"));
  EXPECT_EQ(json.at("size"), (nlohmann::json{96, 64}));
  const auto m = json.at("clip_from_P").get<std::vector<double>>();
  ASSERT_EQ(m.size(), 16u);
  glm::dmat4 clip_from_P;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) clip_from_P[c][r] = m[static_cast<std::size_t>(4 * r + c)];
  const glm::dmat4 P_from_clip = glm::inverse(clip_from_P);

  // Each ray from the eye through its pixel meets the plane z = 0 where the depth says.
  const std::vector<float> depth_mm = floatsOf(read("d.nrrd"));
  const glm::dvec3 eye{3, -30, 40};
  int hits = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const double found = depth_mm[static_cast<std::size_t>(y * 96 + x)];
      const glm::dvec4 far = P_from_clip * glm::dvec4((x + 0.5) / 48.0 - 1.0, 1.0 - (y + 0.5) / 32.0, 0.9, 1.0);
      const glm::dvec3 ray = glm::normalize(glm::dvec3(far) / far.w - eye);
      const glm::dvec3 p = eye - eye.z / ray.z * ray;
      if (glm::abs(p.x) > 4.5 || glm::abs(p.y) > 4.5) continue;
      EXPECT_NEAR(found, glm::distance(eye, p), 0.02) << x << " " << y;
      ++hits;
    }
  EXPECT_GT(hits, 500);
}

TEST_F(SeeCommand, IsDeterministic) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  for (const char* name : {"a.png", "b.png"})
    ASSERT_EQ(molar("see --volume " + at("v.nrrd") + " --field solid --size 64x48 --samples 1 --camera " +
                    std::string(kCamera) + " --out " + at(name))
                  .status,
              0);
  EXPECT_EQ(read("a.png"), read("b.png"));
}

TEST_F(SeeCommand, ShowsCarvedBone) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  write("p.csv", poseCsv({{0, 0, 0, 0.5}, {1, 0, 0, 0.5}}));
  ASSERT_EQ(
      molar("carve --volume " + at("v.nrrd") + " --field solid --tool sphere:2 --set removal_rate_per_s=20 --poses " +
            at("p.csv") + " --out " + at("c.nrrd"))
          .status,
      0);
  for (const char* name : {"v", "c"})
    ASSERT_EQ(molar("see --volume " + at(name) + ".nrrd --field solid --size 96x64 --samples 1 --camera " +
                    std::string(kCamera) + " --out " + at(name) + ".png --depth " + at(name) + "_depth.nrrd")
                  .status,
              0);
  const auto before = floatsOf(read("v_depth.nrrd")), after = floatsOf(read("c_depth.nrrd"));
  // The middle ray meets the bottom of a hole of 1.5 mm; the corners of the picture do not change.
  EXPECT_NEAR(after[32 * 96 + 48] - before[32 * 96 + 48], 1.75, 0.35);
  EXPECT_EQ(after[0], before[0]);
}

TEST_F(SeeCommand, DrawsMoistBoneUnlessDryIsWanted) {
  writeHalfSpace(at("v.nrrd"), 0.2, {0, 0, 1}, 0.0);
  const auto pictureWith = [&](const std::string& option) {
    const ProgramOutput said =
        molar("see --volume " + at("v.nrrd") + " --field solid --size 64x48 --samples 1 --camera " + kCamera + option +
              " --force --out " + at("a.png") + " --depth " + at("d.nrrd"));
    EXPECT_EQ(said.status, 0) << said.err;
    return read("a.png");
  };
  const std::string moist = pictureWith("");
  const std::string depth = read("d.nrrd");
  EXPECT_NE(pictureWith(" --dry"), moist);
  EXPECT_EQ(read("d.nrrd"), depth) << "the same surface";
}

TEST_F(SeeCommand, ShowsEveryGuideWithoutAGraphicsCard) {
  assets::savePatient(assets::syntheticJaw({.spacing_mm = 0.6}), at("p"), false);
  const auto pictureWith = [&](const std::string& layers) {
    const ProgramOutput said = molar("see --patient " + at("p") + " --size 160x120 --samples 1 --renderer cpu" +
                                     layers + " --force --out " + at("a.png"));
    EXPECT_EQ(said.status, 0) << said.err;
    return read("a.png");
  };
  const std::string bare = pictureWith("");
  for (const char* guide : {"canal", "clearance", "plan"})
    EXPECT_NE(pictureWith(std::string(" --layers ") + guide), bare) << guide;
  EXPECT_EQ(pictureWith(" --layers ghost"), bare) << "no tool, no ghost";
}

}  // namespace
}  // namespace app
