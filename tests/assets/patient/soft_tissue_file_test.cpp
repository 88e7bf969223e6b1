#include "assets/patient/soft_tissue_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "assets/load_error.h"
#include "assets/scan/file_checksum.h"
#include "assets/scenery/soft_tissue_distance.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace assets {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kOfThisPatient = 0x1234567890abcdefu;
constexpr std::size_t kSeal_bytes = 24;

SoftTissueField smallField() {
  SoftTissueField field;
  field.grid = {{12, 9, 7}, 1.5, {-3.25, 1.0 / 3.0, 40.0}};
  for (std::size_t v = 0; v < field.grid.voxelCount(); ++v) {
    field.distance.push_back(SoftTissueField::stored(0.05 * static_cast<double>(v) - 5.0));
    field.tissue.push_back(static_cast<std::uint8_t>(v % kSoftTissueCount));
  }
  return field;
}

std::string refusalOf(const std::string& path, std::uint64_t fingerprint = kOfThisPatient) {
  return tests::refusalOf<LoadError>([&] { readSoftTissue(path, fingerprint); });
}

TEST(SoftTissueFile, RoundTripsAFieldAndAnEmptyOne) {
  const tests::ScratchFolder folder;
  for (const SoftTissueField& field : {smallField(), SoftTissueField{}}) {
    writeSoftTissue(field, kOfThisPatient, folder.file("soft"));
    EXPECT_EQ(readSoftTissue(folder.file("soft"), kOfThisPatient), field);
  }
}

TEST(SoftTissueFile, RefusesWhatIsAbsentForeignOrOfAnotherPatient) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("soft");
  EXPECT_THAT(refusalOf(path), HasSubstr("no such file"));
  writeSoftTissue(smallField(), kOfThisPatient, path);
  EXPECT_THAT(refusalOf(path, kOfThisPatient + 1), HasSubstr("another patient"));
  on_disk::write(path, std::string(500, 'x'));
  EXPECT_THAT(refusalOf(path), HasSubstr("not written by this program"));
  appendChecksum(path);
  EXPECT_THAT(refusalOf(path), HasSubstr("no soft tissue"));
}

TEST(SoftTissueFile, RefusesAnyChangedByte) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("soft");
  writeSoftTissue(smallField(), kOfThisPatient, path);
  const std::string good = on_disk::read(path);
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    on_disk::write(path, bad);
    EXPECT_NE(refusalOf(path), "accepted") << at;
  }
}

// Sealed again after the change, so that the values themselves are judged.
TEST(SoftTissueFile, RefusesValuesOutOfRange) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("soft");
  const auto refusal_of = [&](const SoftTissueField& field) {
    writeSoftTissue(field, kOfThisPatient, path);
    return refusalOf(path);
  };
  SoftTissueField field = smallField();
  field.tissue[5] = kSoftTissueCount;
  EXPECT_THAT(refusal_of(field), HasSubstr("value is out of range"));
  field = smallField();
  field.distance[7] = static_cast<std::int16_t>(SoftTissueField::stored(SoftTissueField::kOutside_mm) + 1);
  EXPECT_THAT(refusal_of(field), HasSubstr("value is out of range"));
  field = smallField();
  field.grid.spacing_mm = std::nan("");
  EXPECT_THAT(refusal_of(field), HasSubstr("voxels are out of range"));
  field = smallField();
  field.grid.size = {1, 12 * 9, 7};
  EXPECT_THAT(refusal_of(field), HasSubstr("size is out of range"));
  field = smallField();
  field.grid.size = {1000, 1000, 30};
  EXPECT_THAT(refusal_of(field), HasSubstr("cut short"));
}

MeshModel tetrahedron(const std::string& name) {
  MeshPart part;
  part.name = name;
  part.position_mm = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}};
  part.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return {{part}};
}

TEST(SoftTissueFingerprint, KnowsEverythingTheFieldIsComputedFrom) {
  const MeshModel gum = tetrahedron("Gingiva"), face = tetrahedron("Face");
  const SoftTissueRegion region{{1.0, 2.0, 3.0}};
  const std::uint64_t usual = softTissueFingerprint(gum, face, region);
  EXPECT_EQ(softTissueFingerprint(gum, face, region), usual);
  EXPECT_NE(softTissueFingerprint(face, gum, region), usual);
  EXPECT_NE(softTissueFingerprint(gum, {}, region), usual);
  EXPECT_NE(softTissueFingerprint(gum, face, {{1.0, 2.0, 3.5}}), usual);
  EXPECT_NE(softTissueFingerprint(gum, face, {region.centre_P_mm, 60.0}), usual);
  const auto changed = [&](auto change) {
    MeshModel other = face;
    change(other.parts.front());
    return softTissueFingerprint(gum, other, region);
  };
  EXPECT_NE(changed([](MeshPart& p) { p.name = "Lips"; }), usual);
  EXPECT_NE(changed([](MeshPart& p) { p.material.metallic = 1.0f; }), usual);
  EXPECT_NE(changed([](MeshPart& p) { p.position_mm[3].z += 1e-5f; }), usual);
  EXPECT_NE(changed([](MeshPart& p) { std::swap(p.triangles[0], p.triangles[1]); }), usual);
  EXPECT_EQ(changed([](MeshPart& p) { p.colour.assign(4, glm::vec4(1.0f)); }), usual) << "colours are not read";
}

// A field of a fixed body, in whole voxels: if this changes, kSoftTissueRevision must be raised with it.
TEST(SoftTissueFingerprint, TheRevisionNamesThisField) {
  EXPECT_EQ(kSoftTissueRevision, 1u);
  const SoftTissueRegion region{glm::dvec3(0.0)};
  const SoftTissueField field = softTissueField(softTissueSurfaces(tetrahedron("Gingiva"), {}, region), region);
  EXPECT_EQ(field.grid.size, glm::ivec3(23));
  int inside = 0, near = 0;
  for (const std::int16_t distance : field.distance) {
    inside += distance < 0 ? 1 : 0;
    near += distance < SoftTissueField::stored(5.0) ? 1 : 0;
  }
  EXPECT_EQ(inside, 35);
  EXPECT_EQ(near, 936);
}

}  // namespace
}  // namespace assets
