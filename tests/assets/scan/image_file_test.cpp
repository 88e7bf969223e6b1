#include "assets/scan/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "assets/load_error.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"

namespace {

using assets::VolumeGrid;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string refusalOf(const auto& act) {
  return tests::refusalOf<assets::LoadError>([&] { act(); });
}

const on_disk::Scan kSmall{{3, 4, 5}, glm::dmat3(0.5), {10, -20, 30}};

// A different value for every voxel of kSmall's size.
std::vector<std::int16_t> counting() {
  std::vector<std::int16_t> values(60);
  for (std::size_t v = 0; v < 60; ++v) values[v] = static_cast<std::int16_t>(10 * v - 300);
  return values;
}

// kSmall with i running to the patient's right and j anterior, as many NIfTI files do.
on_disk::Scan turned() {
  on_disk::Scan scan = kSmall;
  scan.step[0] = {0, 0, -0.5};
  scan.step[1] = {-0.5, 0, 0};
  scan.step[2] = {0, 0.5, 0};
  return scan;
}

std::string packed(const std::string& path, const std::string& bytes) {
  gzFile file = gzopen(path.c_str(), "wb");
  EXPECT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned int>(bytes.size())), static_cast<int>(bytes.size()));
  gzclose(file);
  return on_disk::read(path);
}

std::vector<std::int16_t> noise() {
  std::mt19937 random(1);
  std::vector<std::int16_t> values(60);
  for (auto& value : values) value = static_cast<std::int16_t>(random() % 2000);
  return values;
}

std::map<std::string, std::string> inEveryFormat(const on_disk::Scan& scan) {
  const std::string data = on_disk::bytesOf(counting());
  return {{"lps.nrrd", on_disk::nrrd(scan, "int16", data)},
          {"ras.nrrd", on_disk::nrrd(scan, "short", data, "right-anterior-superior", {-1, -1, 1})},
          {"a.nii", on_disk::nifti(scan, 4, 16, data)},
          {"a.mha", on_disk::meta(scan, "MET_SHORT", data)}};
}

TEST(ImageFile, ReadsEveryFormatIntoTheSameVoxels) {
  const on_disk::Folder folder;
  for (const auto& [name, bytes] : inEveryFormat(kSmall)) {
    on_disk::write(folder.at(name), bytes);
    const auto image = assets::readHounsfield(folder.at(name));
    EXPECT_TRUE(assets::isSameGrid(image.grid, {{3, 4, 5}, 0.5, {10, -20, 30}})) << name;
    EXPECT_EQ(image.hounsfield, counting()) << name;
  }
}

TEST(ImageFile, ReadsPermutedAxesAlikeFromEveryFormat) {
  const on_disk::Folder folder;
  for (const auto& [name, bytes] : inEveryFormat(turned())) {
    on_disk::write(folder.at(name), bytes);
    const auto image = assets::readHounsfield(folder.at(name));
    // File axes (k down, j right, i posterior): the grid is 4 x 5 x 3, from the far ends of x and z.
    ASSERT_TRUE(assets::isSameGrid(image.grid, {{4, 5, 3}, 0.5, {8.5, -20, 29}})) << name;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 4; ++i)
          EXPECT_EQ(image.hounsfield[image.grid.index({i, j, k})],
                    counting()[static_cast<std::size_t>((2 - k) + 3 * (3 - i) + 12 * j)])
              << name;
  }
}

TEST(ImageFile, ReadsObliqueAxesFromEveryFormat) {
  const double angle = 0.4;
  on_disk::Scan scan{{3, 4, 5}, glm::dmat3(1.0), {1, 2, 3}};
  scan.step[0] = 0.5 * glm::dvec3(std::cos(angle), std::sin(angle), 0);
  scan.step[1] = 0.5 * glm::dvec3(-std::sin(angle), std::cos(angle), 0);
  const on_disk::Folder folder;
  std::map<std::string, assets::HounsfieldImage> images;
  for (const auto& [name, bytes] : inEveryFormat(scan)) {
    on_disk::write(folder.at(name), bytes);
    images[name] = assets::readHounsfield(folder.at(name));
    EXPECT_TRUE(assets::isSameGrid(images[name].grid, images["a.mha"].grid)) << name;
    ASSERT_EQ(images[name].hounsfield.size(), images["a.mha"].hounsfield.size());
    for (std::size_t v = 0; v < images[name].hounsfield.size(); ++v)
      EXPECT_NEAR(images[name].hounsfield[v], images["a.mha"].hounsfield[v], 1) << name;
  }
  EXPECT_GT(images["a.mha"].hounsfield.size(), 60u);
}

// A scan with a tilted gantry: sheared axes, read as they are or refused.
TEST(ImageFile, KeepsTheShearOfATiltedGantry) {
  on_disk::Scan scan{{20, 20, 20}, glm::dmat3(0.5), {10, -20, 30}};
  scan.step[2] = {0, 0.2, 0.5};
  const glm::dvec3 slope(30, 20, -25);
  std::vector<std::int16_t> values;
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i)
        values.push_back(
            static_cast<std::int16_t>(std::lround(glm::dot(slope, scan.origin + scan.step * glm::dvec3(i, j, k)))));
  const std::string data = on_disk::bytesOf(values);
  const on_disk::Folder folder;
  on_disk::write(folder.at("a.nrrd"), on_disk::nrrd(scan, "short", data));
  on_disk::write(folder.at("a.mha"), on_disk::meta(scan, "MET_SHORT", data));
  on_disk::write(folder.at("a.nii"), on_disk::nifti(scan, 4, 16, data));
  for (const char* name : {"a.nrrd", "a.mha", "a.nii"}) {
    assets::HounsfieldImage image;
    const std::string refusal = refusalOf([&] { image = assets::readHounsfield(folder.at(name)); });
    if (refusal != "accepted") {
      EXPECT_STREQ(name, "a.nii") << refusal;
      continue;
    }
    const glm::dvec3 p_P_mm = scan.origin + scan.step * glm::dvec3(9.3, 8.1, 15.4);
    const glm::ivec3 ijk(glm::round(image.grid.indexFromPoint(p_P_mm)));
    ASSERT_TRUE(image.grid.contains(ijk)) << name;
    EXPECT_NEAR(image.hounsfield[image.grid.index(ijk)], glm::dot(slope, image.grid.centre_P_mm(ijk)), 1.1) << name;
  }
}

template <class Stored>
void expectReads(const on_disk::Folder& folder, const std::string& type) {
  const std::vector<Stored> values = {0, 1, 2, 100, 127, 7, 8, 9};
  const on_disk::Scan cube{{2, 2, 2}, glm::dmat3(0.5), {0, 0, 0}};
  on_disk::write(folder.at("a.nrrd"), on_disk::nrrd(cube, type, on_disk::bytesOf(values)));
  EXPECT_EQ(assets::readHounsfield(folder.at("a.nrrd"), assets::GreyWindow{0.0, 255.0}).hounsfield,
            (std::vector<std::int16_t>{0, 1, 2, 100, 127, 7, 8, 9}));
  EXPECT_EQ(assets::readSolid(folder.at("a.nrrd")).values, (std::vector<std::uint8_t>{0, 1, 2, 100, 127, 7, 8, 9}));
  EXPECT_EQ(assets::readLabels(folder.at("a.nrrd")).values, (std::vector<std::uint8_t>{0, 1, 2, 100, 127, 7, 8, 9}));
}

TEST(ImageFile, ReadsEveryScalarType) {
  const on_disk::Folder folder;
  expectReads<std::int8_t>(folder, "signed char");
  expectReads<std::uint8_t>(folder, "uchar");
  expectReads<std::int16_t>(folder, "short");
  expectReads<std::uint16_t>(folder, "ushort");
  expectReads<std::int32_t>(folder, "int");
  expectReads<std::uint32_t>(folder, "uint");
  expectReads<std::int64_t>(folder, "longlong");
  expectReads<std::uint64_t>(folder, "ulonglong");
  expectReads<float>(folder, "float");
  expectReads<double>(folder, "double");
}

TEST(ImageFile, RefusesValuesThatDoNotFit) {
  const on_disk::Folder folder;
  const auto hounsfieldOf = [&](float value) {
    std::vector<float> values(60, 1.0F);
    values[33] = value;
    on_disk::write(folder.at("a.nrrd"), on_disk::nrrd(kSmall, "float", on_disk::bytesOf(values)));
    return refusalOf([&] { assets::readHounsfield(folder.at("a.nrrd")); });
  };
  EXPECT_EQ(hounsfieldOf(32767.0F), "accepted");
  EXPECT_EQ(hounsfieldOf(-32768.4F), "accepted");
  EXPECT_THAT(hounsfieldOf(32768.0F), HasSubstr("rescale it to Hounsfield"));
  EXPECT_THAT(hounsfieldOf(1.0e30F), HasSubstr("rescale it to Hounsfield"));
  EXPECT_THAT(hounsfieldOf(std::numeric_limits<float>::quiet_NaN()), HasSubstr("finite"));
  EXPECT_THAT(hounsfieldOf(-std::numeric_limits<float>::infinity()), HasSubstr("finite"));
  on_disk::write(folder.at("a.nrrd"), on_disk::nrrd(kSmall, "short", on_disk::bytesOf(counting())));
  EXPECT_THAT(refusalOf([&] { assets::readSolid(folder.at("a.nrrd")); }), HasSubstr("-300 lies outside 0..255"));
  EXPECT_THAT(refusalOf([&] { assets::readLabels(folder.at("a.nrrd")); }), HasSubstr("-300 lies outside 0..255"));
}

TEST(ImageFile, RefusesTruncatedFilesOfEveryFormat) {
  const on_disk::Folder folder;
  auto files = inEveryFormat(kSmall);
  {
    auto packed_nrrd = assets::nrrdOutput(folder.at("packed.nrrd"), false);
    assets::writeHounsfield({{3, 4, 5}, 0.5, {10, -20, 30}}, noise(), packed_nrrd);
    files["packed.nrrd"] = on_disk::read(folder.at("packed.nrrd"));
    files["a.nii.gz"] = packed(folder.at("a.nii.gz"), on_disk::nifti(kSmall, 4, 16, on_disk::bytesOf(noise())));
  }
  for (const auto& [name, bytes] : files) {
    on_disk::write(folder.at(name), bytes);
    EXPECT_EQ(refusalOf([&] { assets::readHounsfield(folder.at(name)); }), "accepted") << name;
    for (const std::size_t kept :
         {bytes.size() - 20, bytes.size() - 115, bytes.size() / 2, std::size_t{10}, std::size_t{0}}) {
      on_disk::write(folder.at(name), bytes.substr(0, kept));
      EXPECT_THAT(refusalOf([&] { assets::readHounsfield(folder.at(name)); }), HasSubstr(name)) << kept;
    }
  }
}

TEST(ImageFile, RefusesWhatIsNotAScalarVolume) {
  const on_disk::Folder folder;
  const auto refusal = [&](const std::string& name, const std::string& bytes) {
    on_disk::write(folder.at(name), bytes);
    return refusalOf([&] { assets::readHounsfield(folder.at(name)); });
  };
  const std::string data(20000, '\0');
  EXPECT_THAT(refusal("a.nii", on_disk::nifti(kSmall, 128, 24, data)), HasSubstr("vectors, colours"));
  EXPECT_THAT(refusal("a.nii", on_disk::nifti(kSmall, 32, 64, data)), HasSubstr("vectors, colours"));
  EXPECT_THAT(refusal("a.nii", on_disk::nifti(kSmall, 4, 16, data, 0)), HasSubstr("orientation"));
  EXPECT_THAT(
      refusal(
          "a.nrrd",
          "NRRD0004\ntype: short\ndimension: 2\nsizes: 4 4\nspacings: 1 1\nendian: little\nencoding: raw\n\n" + data),
      HasSubstr("2 axes"));
  EXPECT_THAT(
      refusal("a.nrrd", "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 4 4\nendian: little\nencoding: raw\n\n" + data),
      HasSubstr("states no voxel size"));
  EXPECT_THAT(
      refusal("a.nrrd",
              "NRRD0004\ntype: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 3 4 4 4\nspace directions: "
              "none (1,0,0) (0,1,0) (0,0,1)\nkinds: vector domain domain domain\nendian: little\nencoding: "
              "raw\nspace origin: (0,0,0)\n\n" +
                  data),
      HasSubstr("vectors, colours"));
  EXPECT_THAT(
      refusal(
          "a.mha",
          "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" + data),
      HasSubstr("states no voxel size"));
  on_disk::Scan huge = kSmall;
  huge.size = {4096, 4096, 4096};
  EXPECT_THAT(refusal("a.nrrd", on_disk::nrrd(huge, "short", data)), HasSubstr("a.nrrd: it is"));
  huge.size = {1000, 1000, 1000};
  EXPECT_THAT(refusal("a.nrrd", on_disk::nrrd(huge, "short", data)), HasSubstr("truncated"));
  on_disk::Scan flat = kSmall;
  flat.step[2] = flat.step[1];
  EXPECT_THAT(refusal("a.nrrd", on_disk::nrrd(flat, "short", data)), HasSubstr("a.nrrd"));
  on_disk::Scan lost = kSmall;
  lost.origin.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal("a.nrrd", on_disk::nrrd(lost, "short", data)), HasSubstr("a.nrrd"));
  EXPECT_THAT(refusal("a.nrrd", on_disk::nrrd(kSmall, "short", data, "left-anterior-superior")), HasSubstr("space"));
  EXPECT_THAT(refusal("a.nrrd", "no volume at all"), HasSubstr("a.nrrd"));
  EXPECT_THAT(refusal("a.txt", data), HasSubstr("extension"));
  EXPECT_THAT(refusalOf([&] { assets::readSolid(folder.at("none.nrrd")); }), HasSubstr("no such file"));
  EXPECT_THAT(refusalOf([&] { assets::readSolid(folder.at("")); }), HasSubstr("not a file"));
}

TEST(ImageFile, PrintsNothingAboutBadFiles) {
  const on_disk::Folder folder;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (const auto& [name, bytes] : inEveryFormat(kSmall))
    for (std::size_t kept = 0; kept + 2 < bytes.size(); kept += 23) {
      on_disk::write(folder.at(name), bytes.substr(0, kept));
      EXPECT_NE(refusalOf([&] { assets::readHounsfield(folder.at(name)); }), "accepted") << name << ' ' << kept;
    }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageFile, ReadsBackWhatItWrites) {
  const on_disk::Folder folder;
  const VolumeGrid grid{{3, 4, 5}, 0.1, {-12.345678901234567, 1.0 / 3.0, 1e-9}};
  auto hu = assets::nrrdOutput(folder.at("hu.nrrd"), false);
  assets::writeHounsfield(grid, counting(), hu);
  EXPECT_EQ(assets::readHounsfield(folder.at("hu.nrrd")).grid, grid);
  EXPECT_EQ(assets::readHounsfield(folder.at("hu.nrrd")).hounsfield, counting());

  std::vector<std::uint8_t> bytes(60);
  for (std::size_t v = 0; v < 60; ++v) bytes[v] = static_cast<std::uint8_t>(4 * v);
  auto solid = assets::nrrdOutput(folder.at("solid.nrrd"), false);
  assets::writeSolid(grid, bytes, solid);
  EXPECT_EQ(assets::readSolid(folder.at("solid.nrrd")).grid, grid);
  EXPECT_EQ(assets::readSolid(folder.at("solid.nrrd")).values, bytes);
  EXPECT_THAT(on_disk::read(folder.at("solid.nrrd")), AllOf(HasSubstr("space: left-posterior-superior"),
                                                            HasSubstr("encoding: gzip"), HasSubstr("sizes: 3 4 5")));
}

TEST(ImageFile, WritesTheSameBytesForTheSameVolume) {
  const on_disk::Folder folder;
  for (const char* name : {"a.nrrd", "b.nrrd"}) {
    auto file = assets::nrrdOutput(folder.at(name), false);
    assets::writeHounsfield({{3, 4, 5}, 0.1}, counting(), file);
  }
  EXPECT_EQ(on_disk::read(folder.at("a.nrrd")), on_disk::read(folder.at("b.nrrd")));
}

TEST(ImageFile, WritesADepthImageOfTwoAxes) {
  const on_disk::Folder folder;
  auto file = assets::nrrdOutput(folder.at("depth.nrrd"), false);
  assets::writeDepth(3, 2, {0, 1, 2, 3, 4, 5}, file);
  EXPECT_THAT(on_disk::read(folder.at("depth.nrrd")), AllOf(HasSubstr("type: float"), HasSubstr("sizes: 3 2\n")));
}

TEST(ImageFile, WritesOnlyNrrd) {
  const on_disk::Folder folder;
  EXPECT_THAT(refusalOf([&] { assets::nrrdOutput(folder.at("a.nii.gz"), false); }), HasSubstr(".nrrd"));
}

TEST(ImageFile, DistinguishesGrids) {
  const VolumeGrid grid{{100, 100, 100}, 0.4, {1, 2, 3}};
  VolumeGrid other = grid;
  other.origin_P_mm.y += 0.003;
  EXPECT_TRUE(assets::isSameGrid(grid, other));
  other.origin_P_mm.y += 0.003;
  EXPECT_FALSE(assets::isSameGrid(grid, other));
  other = grid;
  other.spacing_mm = 0.4001;
  EXPECT_FALSE(assets::isSameGrid(grid, other));
  other = grid;
  other.size.z = 99;
  EXPECT_FALSE(assets::isSameGrid(grid, other));
}

TEST(ImageFile, DetectsAChangedByteInACompressedFile) {
  const on_disk::Folder folder;
  auto file = assets::nrrdOutput(folder.at("packed.nrrd"), false);
  assets::writeHounsfield({{3, 4, 5}, 0.5, {10, -20, 30}}, noise(), file);
  packed(folder.at("a.nii.gz"), on_disk::nifti(kSmall, 4, 16, on_disk::bytesOf(noise())));
  for (const char* name : {"packed.nrrd", "a.nii.gz"}) {
    std::string bytes = on_disk::read(folder.at(name));
    bytes[bytes.size() - 40] = static_cast<char>(bytes[bytes.size() - 40] ^ 0x10);
    on_disk::write(folder.at(name), bytes);
    EXPECT_THAT(refusalOf([&] { assets::readHounsfield(folder.at(name)); }), HasSubstr(name));
  }
}

}  // namespace
