#include "assets/patient/patient_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assets/load_error.h"
#include "assets/patient/patient_toml.h"
#include "assets/scenery/face_frame.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"

namespace {

using assets::Patient;
using testing::HasSubstr;
using testing::Not;

std::string refusalOf(const auto& act) {
  return tests::refusalOf<std::runtime_error>([&] { act(); });
}

assets::MeshPart triangle(const std::string& name) {
  assets::MeshPart part;
  part.name = name;
  part.position_mm = {{45, 42, 22}, {55, 42, 22}, {45, 42, 32}};
  part.normal = {{0, -1, 0}, {0, -1, 0}, {0, -1, 0}};
  part.triangles = {0, 1, 2};
  return part;
}

Patient somebody() {
  Patient patient;
  patient.title = "test, \"quoted\" \xc3\xa9";
  patient.found = assets::Confirmation{true, false};
  patient.ct.grid = {{20, 21, 22}, 0.4, {41.95, 39.95, 19.95}};
  for (std::size_t v = 0; v < patient.ct.grid.voxelCount(); ++v) {
    patient.ct.hounsfield.push_back(static_cast<std::int16_t>(v % 3000));
    patient.ct.label.push_back(static_cast<std::uint8_t>(v % 10));
    patient.ct.solid.push_back(static_cast<std::uint8_t>(v % 256));
    patient.ct.tooth.push_back(static_cast<std::uint8_t>(v % 3 == 0 ? 38 : v % 3 == 1 ? 65 : 0));
  }
  patient.classification = {312.5, 77.7};
  patient.site = {38, {45.0 + 1.0 / 3.0, 42.1, 24.0}, glm::normalize(glm::dvec3(1, -2, 3))};
  patient.mandibular_canal_P_mm = {{1.0 / 3.0, 2, 3}, {4, 5e-7, -6}};
  patient.mandibular_canal_radius_mm = 1.1;
  patient.X_PF = {glm::normalize(glm::dquat(0.7, 0.6, -0.2, 0.1)), {12.5, -40.0, 1.0 / 3.0}};
  patient.gingiva.parts = {triangle("Gum lower")};
  patient.face.parts = {triangle("Skin"), triangle("Lips")};
  return patient;
}

TEST(PatientFolder, RoundTrips) {
  const on_disk::Folder folder;
  const Patient saved = somebody();
  assets::savePatient(saved, folder.at("p"), false);
  const Patient loaded = assets::loadPatient(folder.at("p"));
  EXPECT_EQ(loaded.title, saved.title);
  ASSERT_TRUE(loaded.found);
  EXPECT_TRUE(loaded.found->tooth);
  EXPECT_FALSE(loaded.found->canal);
  EXPECT_EQ(loaded.ct.grid, saved.ct.grid);
  EXPECT_EQ(loaded.ct.hounsfield, saved.ct.hounsfield);
  EXPECT_EQ(loaded.ct.label, saved.ct.label);
  EXPECT_EQ(loaded.ct.solid, saved.ct.solid);
  EXPECT_EQ(loaded.classification.iso_hu, 312.5);
  EXPECT_EQ(loaded.classification.sigma_hu, 77.7);
  EXPECT_EQ(loaded.ct.tooth, saved.ct.tooth);
  ASSERT_TRUE(loaded.site);
  EXPECT_EQ(loaded.site->fdi, 38);
  EXPECT_EQ(loaded.site->centre_P_mm, saved.site->centre_P_mm);
  EXPECT_EQ(loaded.site->axis_P, saved.site->axis_P);
  EXPECT_EQ(loaded.mandibular_canal_P_mm, saved.mandibular_canal_P_mm);
  EXPECT_EQ(loaded.mandibular_canal_radius_mm, 1.1);
  ASSERT_TRUE(loaded.X_PF);
  EXPECT_EQ(loaded.X_PF->translation_mm, saved.X_PF->translation_mm);
  EXPECT_NEAR(std::abs(glm::dot(loaded.X_PF->rotation, saved.X_PF->rotation)), 1.0, 1e-12);
}

TEST(PatientToml, RefusesAHeadThatIsNone) {
  std::string text = assets::patientToml(somebody());
  const std::size_t at = text.find("up_P = ");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, text.find('\n', at) - at, "up_P = [1.0, 0.0, 0.0]");
  EXPECT_NE(tests::refusalOf<assets::LoadError>([&] { assets::patientFromToml(text, "p"); }).find("right angle"),
            std::string::npos);
}

TEST(PatientFolder, TakesOverTheVolumeItWasJustWrittenWith) {
  const on_disk::Folder folder;
  const Patient saved = somebody();
  assets::savePatient(saved, folder.at("p"), false);
  const Patient whole = assets::loadPatient(folder.at("p")),
                rest = assets::loadPatient(folder.at("p"), [&] { return saved.ct; });
  EXPECT_EQ(rest.ct.grid, whole.ct.grid);
  EXPECT_EQ(rest.ct.hounsfield, whole.ct.hounsfield);
  EXPECT_EQ(rest.ct.label, whole.ct.label);
  EXPECT_EQ(rest.ct.solid, whole.ct.solid);
  EXPECT_EQ(rest.ct.tooth, whole.ct.tooth);
  EXPECT_EQ(rest.title, whole.title);
  ASSERT_EQ(rest.face.parts.size(), whole.face.parts.size());
  EXPECT_EQ(rest.face.parts[0].position_mm, whole.face.parts[0].position_mm);
}

TEST(PatientFolder, KeepsGingivaAndFaceApartAndInPosition) {
  const on_disk::Folder folder;
  Patient saved = somebody();
  saved.gingiva.parts.push_back(triangle("flap"));
  saved.face.parts.push_back(triangle("Gums and tongue"));
  assets::savePatient(saved, folder.at("p"), false);
  const Patient loaded = assets::loadPatient(folder.at("p"));
  ASSERT_EQ(loaded.gingiva.parts.size(), 2u);
  ASSERT_EQ(loaded.face.parts.size(), 3u);
  EXPECT_EQ(loaded.gingiva.parts[0].name, "Gum lower");
  EXPECT_EQ(loaded.gingiva.parts[1].name, "Gum flap");
  EXPECT_EQ(loaded.face.parts[2].name, "Face Gums and tongue");
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_LT(glm::distance(loaded.face.parts[0].position_mm[v], saved.face.parts[0].position_mm[v]), 1e-4F);
    EXPECT_LT(glm::distance(loaded.face.parts[0].normal[v], saved.face.parts[0].normal[v]), 1e-6F);
  }
}

TEST(PatientFolder, IsValidWithoutMeshes) {
  const on_disk::Folder folder;
  Patient saved = somebody();
  saved.gingiva.parts.clear();
  saved.face.parts.clear();
  assets::savePatient(saved, folder.at("p"), false);
  EXPECT_FALSE(std::filesystem::exists(folder.at("p/face.glb")));
  EXPECT_TRUE(assets::loadPatient(folder.at("p")).face.parts.empty());
}

TEST(PatientFolder, IsReplacedOnlyOnRequest) {
  const on_disk::Folder folder;
  Patient patient = somebody();
  assets::savePatient(patient, folder.at("p"), false);
  EXPECT_THAT(refusalOf([&] { assets::savePatient(patient, folder.at("p"), false); }), HasSubstr("--force"));
  patient.title = "second";
  assets::savePatient(patient, folder.at("p"), true);
  EXPECT_EQ(assets::loadPatient(folder.at("p")).title, "second");
}

TEST(PatientFolder, RefusesAMissingFile) {
  const on_disk::Folder folder;
  EXPECT_THAT(refusalOf([&] { assets::loadPatient(folder.at("none")); }), HasSubstr("no such patient folder"));
  assets::savePatient(somebody(), folder.at("p"), false);
  std::filesystem::remove(folder.at("p/volume.vdb"));
  EXPECT_THAT(refusalOf([&] { assets::loadPatient(folder.at("p")); }), HasSubstr("volume.vdb"));
  std::filesystem::remove(folder.at("p/patient.toml"));
  EXPECT_THAT(refusalOf([&] { assets::loadPatient(folder.at("p")); }), HasSubstr("patient.toml"));
}

TEST(PatientFolder, RefusesASiteOutsideItsVolume) {
  const on_disk::Folder folder;
  Patient patient = somebody();
  patient.site->centre_P_mm.x = 900.0;
  assets::savePatient(patient, folder.at("p"), false);
  EXPECT_THAT(refusalOf([&] { assets::loadPatient(folder.at("p")); }), HasSubstr("outside the volume"));
}

TEST(PatientToml, ChecksEveryNumber) {
  const std::string good = assets::patientToml(somebody());
  const auto with = [&](const std::string& old_text, const std::string& new_text) {
    std::string text = good;
    const std::size_t at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text << " in\n" << text;
    if (at != std::string::npos) text.replace(at, old_text.size(), new_text);
    return refusalOf([&] { assets::patientFromToml(text, "patient.toml"); });
  };
  EXPECT_EQ(with("schema = 2", "schema = 2"), "accepted");
  EXPECT_THAT(with("schema = 2", "schema = 3"), HasSubstr("schema: it is 3"));
  EXPECT_THAT(with("schema = 2", "scheme = 2"), HasSubstr("schema: it is missing"));
  EXPECT_THAT(with("schema = 2", "schema = = 2"), HasSubstr("line"));
  for (const char* fdi : {"40", "49", "56", "nan", "38.5", "\"38\""})
    EXPECT_THAT(with("fdi = 38", std::string("fdi = ") + fdi), HasSubstr("[site] fdi")) << fdi;
  EXPECT_EQ(with("fdi = 38", "fdi = 55"), "accepted");
  EXPECT_THAT(with("[jaw]", "[chin]"), HasSubstr("[jaw]"));
  EXPECT_THAT(with("iso_hu = 312.5", "iso_hu = inf"), HasSubstr("iso_hu"));
  EXPECT_THAT(with("iso_hu = 312.5", "iso_hu = \"312\""), HasSubstr("iso_hu"));
  EXPECT_THAT(with("sigma_hu = 77.7", "sigma_hu = 0"), HasSubstr("sigma_hu"));
  EXPECT_THAT(with("radius_mm = 1.1", "radius_mm = -1.1"), HasSubstr("radius_mm"));
  EXPECT_THAT(with("radius_mm = 1.1", ""), HasSubstr("radius_mm"));
  EXPECT_EQ(with("[mandibular_canal]", "[canal]"), "accepted");
  EXPECT_THAT(with("[mandibular_canal]", "[channel]"), HasSubstr("[mandibular_canal]"));
  EXPECT_THAT(with("line_P_mm = [", "line_P_mm = [ [1,2],"), HasSubstr("three numbers"));
  EXPECT_THAT(with("axis_P = [", "axis_P = [0.1, 0.1, 0.1] #"), HasSubstr("axis_P"));
  EXPECT_THAT(with("title = ", "title = \"a\\nb\" #"), HasSubstr("one line"));
  EXPECT_THAT(with("centre_P_mm = [", "centre_P_mm = [nan, 1, 2] #"), HasSubstr("centre_P_mm"));
}

/// Schema 1, with its keys.
TEST(PatientToml, ReadsSchema1) {
  const auto former = [](const char* known) {
    return std::string("schema = 1\ntitle = \"before\"\nframe = \"P: LPS, mm\"\n\n[site]\nknown = ") + known +
           "\ntooth_fdi = 48\nthird_molar_P_mm = [1.5, 2.0, -3.0]\ncrown_direction_P = [0.0, 0.6, 0.8]\n\n"
           "[classification]\niso_hu = 300.0\nsigma_hu = 75.0\n\n[canal]\nradius_mm = 1.3\nline_P_mm = [\n"
           "  [1.0, 2.0, 3.0],\n  [2.0, 3.0, 4.0],\n]\n";
  };
  const Patient with_site = assets::patientFromToml(former("true"), "patient.toml");
  ASSERT_TRUE(with_site.site);
  EXPECT_EQ(with_site.site->fdi, 48);
  EXPECT_EQ(with_site.site->centre_P_mm, glm::dvec3(1.5, 2.0, -3.0));
  EXPECT_EQ(with_site.site->axis_P, glm::dvec3(0.0, 0.6, 0.8));
  EXPECT_EQ(with_site.mandibular_canal_P_mm.size(), 2u);
  EXPECT_EQ(with_site.mandibular_canal_radius_mm, 1.3);
  const Patient without = assets::patientFromToml(former("false"), "patient.toml");
  EXPECT_FALSE(without.site);
  EXPECT_EQ(without.focus_P_mm(), glm::dvec3(1.5, 2.0, -3.0));
}

TEST(PatientFolder, NumbersTheToothAtTheSiteOfAFolderWithoutNumbers) {
  const on_disk::Folder folder;
  Patient saved = somebody();
  saved.ct.tooth.clear();
  assets::savePatient(saved, folder.at("p"), false);
  const Patient loaded = assets::loadPatient(folder.at("p"));
  ASSERT_EQ(loaded.ct.tooth.size(), loaded.ct.label.size());
  for (std::size_t v = 0; v < loaded.ct.label.size(); ++v) {
    const auto label = loaded.ct.label[v];
    ASSERT_EQ(loaded.ct.tooth[v], label >= 4 && label <= 6 ? 38 : 0);
  }
}

TEST(PatientFolder, HoldsAPatientWithoutASite) {
  const on_disk::Folder folder;
  Patient saved = somebody();
  saved.site.reset();
  saved.jaw_P_mm = {44.0, 41.5, 23.0};
  assets::savePatient(saved, folder.at("p"), false);
  const Patient loaded = assets::loadPatient(folder.at("p"));
  EXPECT_FALSE(loaded.site);
  EXPECT_EQ(loaded.focus_P_mm(), saved.jaw_P_mm);
}

TEST(FaceFrame, MapsUpToSuperiorAndForwardToAnterior) {
  assets::MeshModel face_F;
  face_F.parts.emplace_back();
  face_F.parts[0].position_mm = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  face_F.parts[0].normal = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto face_P = assets::modelInPatientFrame(face_F);
  const glm::vec3 expected[] = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_LT(glm::distance(face_P.parts[0].position_mm[v], expected[v]), 1e-6F);
    EXPECT_LT(glm::distance(face_P.parts[0].normal[v], expected[v]), 1e-6F);
    EXPECT_LT(glm::distance(assets::modelInFaceFrame(face_P).parts[0].position_mm[v], face_F.parts[0].position_mm[v]),
              1e-6F);
  }
}

}  // namespace
