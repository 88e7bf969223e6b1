#include "assets/patient_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "assets/face_frame.h"
#include "assets/load_error.h"
#include "assets/patient_toml.h"
#include "tests/assets/scan_on_disk.h"

namespace {

using assets::Patient;
using testing::HasSubstr;
using testing::Not;

std::string refusalOf(const auto& act) {
  try {
    act();
  } catch (const assets::LoadError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return "accepted";
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
  patient.ct.grid = {{20, 21, 22}, 0.4, {41.95, 39.95, 19.95}};
  for (std::size_t v = 0; v < patient.ct.grid.voxelCount(); ++v) {
    patient.ct.hounsfield.push_back(static_cast<std::int16_t>(v % 3000));
    patient.ct.label.push_back(static_cast<std::uint8_t>(v % 10));
    patient.ct.solid.push_back(static_cast<std::uint8_t>(v % 256));
  }
  patient.classification = {312.5, 77.7};
  patient.site = {true, 38, {45.0 + 1.0 / 3.0, 42.1, 24.0}, glm::normalize(glm::dvec3(1, -2, 3))};
  patient.canal_P_mm = {{1.0 / 3.0, 2, 3}, {4, 5e-7, -6}};
  patient.canal_radius_mm = 1.1;
  patient.gum.parts = {triangle("Gum lower")};
  patient.face.parts = {triangle("Skin"), triangle("Lips")};
  return patient;
}

TEST(PatientFolder, GivesBackThePatient) {
  const on_disk::Folder folder;
  const Patient saved = somebody();
  assets::savePatient(saved, folder.at("p"), false);
  const Patient loaded = assets::loadPatient(folder.at("p"));
  EXPECT_EQ(loaded.title, saved.title);
  EXPECT_EQ(loaded.ct.grid, saved.ct.grid);
  EXPECT_EQ(loaded.ct.hounsfield, saved.ct.hounsfield);
  EXPECT_EQ(loaded.ct.label, saved.ct.label);
  EXPECT_EQ(loaded.ct.solid, saved.ct.solid);
  EXPECT_EQ(loaded.classification.iso_hu, 312.5);
  EXPECT_EQ(loaded.classification.sigma_hu, 77.7);
  EXPECT_TRUE(loaded.site.known);
  EXPECT_EQ(loaded.site.tooth_fdi, 38);
  EXPECT_EQ(loaded.site.third_molar_P_mm, saved.site.third_molar_P_mm);
  EXPECT_EQ(loaded.site.crown_direction_P, saved.site.crown_direction_P);
  EXPECT_EQ(loaded.canal_P_mm, saved.canal_P_mm);
  EXPECT_EQ(loaded.canal_radius_mm, 1.1);
}

TEST(PatientFolder, KeepsGumAndFaceApartAndInPlace) {
  const on_disk::Folder folder;
  Patient saved = somebody();
  saved.gum.parts.push_back(triangle("flap"));
  saved.face.parts.push_back(triangle("Gums and tongue"));
  assets::savePatient(saved, folder.at("p"), false);
  const Patient loaded = assets::loadPatient(folder.at("p"));
  ASSERT_EQ(loaded.gum.parts.size(), 2u);
  ASSERT_EQ(loaded.face.parts.size(), 3u);
  EXPECT_EQ(loaded.gum.parts[0].name, "Gum lower");
  EXPECT_EQ(loaded.gum.parts[1].name, "Gum flap");
  EXPECT_EQ(loaded.face.parts[2].name, "Face Gums and tongue");
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_LT(glm::distance(loaded.face.parts[0].position_mm[v], saved.face.parts[0].position_mm[v]), 1e-4F);
    EXPECT_LT(glm::distance(loaded.face.parts[0].normal[v], saved.face.parts[0].normal[v]), 1e-6F);
  }
}

TEST(PatientFolder, GoesWithoutMeshes) {
  const on_disk::Folder folder;
  Patient saved = somebody();
  saved.gum.parts.clear();
  saved.face.parts.clear();
  assets::savePatient(saved, folder.at("p"), false);
  EXPECT_FALSE(std::filesystem::exists(folder.at("p/face.glb")));
  EXPECT_TRUE(assets::loadPatient(folder.at("p")).face.parts.empty());
}

TEST(PatientFolder, IsReplacedOnlyWithLeave) {
  const on_disk::Folder folder;
  Patient patient = somebody();
  assets::savePatient(patient, folder.at("p"), false);
  EXPECT_THAT(refusalOf([&] { assets::savePatient(patient, folder.at("p"), false); }), HasSubstr("--force"));
  patient.title = "second";
  assets::savePatient(patient, folder.at("p"), true);
  EXPECT_EQ(assets::loadPatient(folder.at("p")).title, "second");
}

TEST(PatientFolder, RefusesWhatIsMissing) {
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
  patient.site.third_molar_P_mm.x = 900.0;
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
  EXPECT_EQ(with("schema = 1", "schema = 1"), "accepted");
  EXPECT_THAT(with("schema = 1", "schema = 2"), HasSubstr("schema is 2"));
  EXPECT_THAT(with("schema = 1", "scheme = 1"), HasSubstr("no schema"));
  EXPECT_THAT(with("schema = 1", "schema = = 1"), HasSubstr("line"));
  EXPECT_THAT(with("tooth_fdi = 38", "tooth_fdi = 40"), HasSubstr("38 or 48"));
  EXPECT_THAT(with("tooth_fdi = 38", "tooth_fdi = nan"), HasSubstr("tooth_fdi"));
  EXPECT_THAT(with("known = true", "known = 1"), HasSubstr("true or false"));
  EXPECT_THAT(with("iso_hu = 312.5", "iso_hu = inf"), HasSubstr("iso_hu"));
  EXPECT_THAT(with("iso_hu = 312.5", "iso_hu = \"312\""), HasSubstr("iso_hu"));
  EXPECT_THAT(with("sigma_hu = 77.7", "sigma_hu = 0"), HasSubstr("sigma_hu"));
  EXPECT_THAT(with("radius_mm = 1.1", "radius_mm = -1.1"), HasSubstr("radius_mm"));
  EXPECT_THAT(with("radius_mm = 1.1", ""), HasSubstr("radius_mm"));
  EXPECT_THAT(with("[canal]", "[channel]"), HasSubstr("[canal]"));
  EXPECT_THAT(with("line_P_mm = [", "line_P_mm = [ [1,2],"), HasSubstr("three numbers"));
  EXPECT_THAT(with("crown_direction_P = [", "crown_direction_P = [0.1, 0.1, 0.1] #"), HasSubstr("crown_direction_P"));
  EXPECT_THAT(with("title = ", "title = \"a\\nb\" #"), HasSubstr("one line"));
  EXPECT_THAT(with("third_molar_P_mm = [", "third_molar_P_mm = [nan, 1, 2] #"), HasSubstr("third_molar_P_mm"));
}

TEST(PatientToml, ReadsOrRefusesAnyDamagedText) {
  const std::string good = assets::patientToml(somebody());
  std::mt19937 random(11);
  int refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    std::string text = good;
    for (auto times = random() % 3 + 1; times > 0; --times) {
      const std::size_t at = random() % text.size();
      if (random() % 5 == 0)
        text.resize(at + 1);
      else
        text[at] = static_cast<char>(random() % 3 == 0 ? random() : ' ' + random() % 95);
    }
    refused += refusalOf([&] { assets::patientFromToml(text, "patient.toml"); }) == "accepted" ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
}

TEST(FaceFrame, TurnsUpIntoSuperiorAndForwardIntoAnterior) {
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
