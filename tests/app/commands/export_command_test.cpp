#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/session/session_writer.h"
#include "assets/mesh/gltf_file.h"
#include "assets/scenery/face_frame.h"
#include "tests/app/commands/program.h"
#include "tests/app/half_space.h"
#include "tests/app/session/real_session.h"
#include "tests/assets/mesh/closed_mesh.h"
#include "tests/assets/mesh/stl_reader.h"

namespace app {
namespace {

using testing::Not;

class ExportCommand : public ProgramTest {
 protected:
  /// A recorded rehearsal that carves a block of bone, enamel below z = -2.
  std::string session() const {
    const test::BoneBlock block;
    haptics::Bodies bone(block.grid, block.solid, block.label);
    SessionWriter writer(at("s.molar"), true, block.start());
    writer.write({{}, test::rehearse(bone, block.start().command, 400, 400), {}});
    writer.seal(0, &bone);
    return at("s.molar");
  }
  nlohmann::json parts(const std::string& arguments) const {
    const ProgramOutput said = molar("export " + arguments);
    EXPECT_EQ(said.status, 0) << said.err;
    return said.status == 0 ? nlohmann::json::parse(said.out).at("parts") : nlohmann::json::array();
  }
};

TEST_F(ExportCommand, WritesTheBoneOfASessionAsAClosedSurface) {
  const auto said = parts(session() + " --out " + at("a.stl"));
  const assets::test::StlFile after = assets::test::readStl(at("a.stl"));
  EXPECT_EQ(assets::test::opennessOf(after.mesh.triangles), "");
  EXPECT_EQ(said.at(0).at("triangles"), after.normal.size());
  EXPECT_NEAR(said.at(0).at("enclosed_mm3").get<double>(), assets::test::volume(after.mesh), 1e-3);

  // The moment before the first cut holds all of the block: 8.2 x 8.2 mm, 4.1 mm high to its grey surface.
  parts(session() + " --to 0 --out " + at("b.stl"));
  const double before_mm3 = assets::test::volume(assets::test::readStl(at("b.stl")).mesh);
  EXPECT_NEAR(before_mm3, 8.2 * 8.2 * 4.1, 1.5);
  EXPECT_LT(assets::test::volume(after.mesh), before_mm3 - 0.2);
}

TEST_F(ExportCommand, WritesBoneAndTeethAsPartsOfOneGltf) {
  const auto said = parts(session() + " --out " + at("a.glb"));
  const assets::MeshModel model_P = assets::modelInPatientFrame(assets::readGltf(at("a.glb")));
  ASSERT_EQ(model_P.parts.size(), 2u);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(model_P.parts[0].name, "Bone");
  EXPECT_EQ(model_P.parts[1].name, "Teeth");
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(assets::test::opennessOf(model_P.parts[n].triangles), "");
    EXPECT_NEAR(assets::test::volume(model_P.parts[n]), said.at(n).at("enclosed_mm3").get<double>(), 0.05);
  }
  // Enamel lies below z = -2 mm in the patient, bone above.
  for (const glm::vec3& p : model_P.parts[0].position_mm) ASSERT_GT(p.z, -2.3f);
  for (const glm::vec3& p : model_P.parts[1].position_mm) ASSERT_LT(p.z, -1.7f);
}

TEST_F(ExportCommand, WritesASingleTissue) {
  const auto tooth = parts(session() + " --tissue tooth --out " + at("t.stl"));
  const auto bone = parts(session() + " --tissue bone --out " + at("b.stl"));
  const auto all = parts(session() + " --out " + at("a.stl"));
  const auto mm3 = [](const nlohmann::json& said) { return said.at(0).at("enclosed_mm3").get<double>(); };
  EXPECT_NEAR(mm3(tooth), 8.2 * 8.2 * 2.0, 3.0);
  EXPECT_NEAR(mm3(tooth) + mm3(bone), mm3(all), 3.0);
}

TEST_F(ExportCommand, WritesAVolume) {
  writeHalfSpace(at("v.nrrd"), 0.5, {0, 0, 1}, 0.0);
  const auto said = parts("--volume " + at("v.nrrd") + " --field solid --out " + at("v.glb"));
  EXPECT_NEAR(said.at(0).at("enclosed_mm3").get<double>(), 500.0, 5.0);  // its edges are bevelled
}

TEST_F(ExportCommand, WritesNoPersonalData) {
  const std::string path = session();
  parts(path + " --out " + at("a.stl"));
  parts(path + " --out " + at("a.glb"));
  for (const char* name : {"a.stl", "a.glb"}) EXPECT_THAT(read(name), Not(testing::HasSubstr("block of bone")));
}

TEST_F(ExportCommand, RefusesInOneLine) {
  const std::string path = session();
  const std::string to = " --out " + at("a.stl");
  expectRefusal("export" + to, "exactly one");
  expectRefusal("export " + path + " --patient " + at("nobody") + to, "exactly one");
  expectRefusal("export --patient " + at("nobody") + to, "nobody");
  expectRefusal("export " + at("missing.molar") + to, "missing.molar");
  expectRefusal("export " + path + " --out " + at("a.obj"), ".stl or .glb");
  expectRefusal("export " + path + " --tissue hair" + to, "tissue");
  expectRefusal("export --patient " + at("p") + " --to 1" + to, "--to");
  writeHalfSpace(at("v.nrrd"), 0.5, {0, 0, 1}, 0.0);
  expectRefusal("export --volume " + at("v.nrrd") + " --field solid --tissue tooth" + to, "tooth");
  EXPECT_FALSE(std::filesystem::exists(at("a.stl")));

  write("a.stl", "precious");
  expectRefusal("export " + path + to, "a.stl");
  EXPECT_EQ(read("a.stl"), "precious");
  EXPECT_EQ(molar("export " + path + to + " --force").status, 0);
}

}  // namespace
}  // namespace app
