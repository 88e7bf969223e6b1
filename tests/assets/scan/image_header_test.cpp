#include "assets/scan/image_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "tests/assets/scan_on_disk.h"

namespace {

using assets::HounsfieldImage;
using assets::ImageHeader;
using on_disk::packed;
using on_disk::replaced;
using testing::HasSubstr;

const on_disk::Scan kScan{{3, 4, 5}, glm::dmat3(0.5), {10, -20, 30}};

std::vector<std::int16_t> countingUp() {
  std::vector<std::int16_t> values(60);
  for (std::size_t v = 0; v < 60; ++v) values[v] = static_cast<std::int16_t>(10 * v - 300);
  return values;
}
const std::string kRaw = on_disk::bytesOf(countingUp());

std::string bigEndian(std::string bytes) {
  for (std::size_t b = 0; b + 1 < bytes.size(); b += 2) std::swap(bytes[b], bytes[b + 1]);
  return bytes;
}

/// A folder in which one file is read.
class ScanReading : public testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& bytes) {
    on_disk::write(folder_.at(name), bytes);
    return folder_.at(name);
  }
  std::string answer(const std::string& name, const std::string& bytes) {
    put(name, bytes);
    try {
      const HounsfieldImage image = assets::readHounsfield(folder_.at(name));
      return image.hounsfield == countingUp() ? "the voxels" : "other voxels";
    } catch (const assets::LoadError& refusal) {
      EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos);
      return refusal.what();
    }
  }
  /// Slices next to the header: s0.raw …
  void putSlices(int count) {
    for (int k = 0; k < count; ++k)
      put("s" + std::to_string(k) + ".raw", kRaw.substr(static_cast<std::size_t>(24 * k), 24));
  }

  on_disk::Folder folder_;
  const std::string nrrd_ = on_disk::nrrd(kScan, "short", "");
  const std::string detached_ = nrrd_.substr(0, nrrd_.size() - 1);
  const std::string meta_ = on_disk::meta(kScan, "MET_SHORT", "");
  const std::string nifti_ = on_disk::nifti(kScan, 4, 16, kRaw);
};
using NrrdReading = ScanReading;
using NiftiReading = ScanReading;
using MetaReading = ScanReading;
using VoxelReading = ScanReading;

std::string asHex(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    const char* digits = "0123456789aBcdEf";
    text += digits[static_cast<unsigned char>(c) >> 4];
    text += digits[c & 15];
    if (text.size() % 70 == 0) text += '\n';
  }
  return text + "\n";
}

std::string asText() {
  std::string text;
  for (const auto value : countingUp()) text += std::to_string(value) + (value % 3 == 0 ? "\n" : " ");
  return text;
}

TEST_F(NrrdReading, ReadsEveryCoding) {
  EXPECT_EQ(answer("a.nrrd", nrrd_ + kRaw), "the voxels");
  EXPECT_EQ(answer("a.nrrd", replaced(nrrd_, "little", "big") + bigEndian(kRaw)), "the voxels");
  EXPECT_EQ(answer("a.nrrd", replaced(nrrd_, "raw", "gzip") + packed(kRaw)), "the voxels");
  EXPECT_EQ(answer("a.nrrd", replaced(nrrd_, "raw", "hex") + asHex(kRaw)), "the voxels");
  EXPECT_EQ(answer("a.nrrd", replaced(nrrd_, "raw", "ascii") + asText()), "the voxels");
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "raw", "bzip2") + kRaw),
              HasSubstr("compressed with bzip2, which is not supported"));
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "raw", "zstd") + kRaw), HasSubstr("'zstd' is not supported"));
}

TEST_F(NrrdReading, ReadsDataFilesInItsFolder) {
  put("v.raw", std::string(77, 'x') + kRaw);
  EXPECT_EQ(answer("a.nhdr", detached_ + "byte skip: 77\ndata file: v.raw\n"), "the voxels");
  EXPECT_EQ(answer("a.nhdr", detached_ + "byte skip: -1\ndata file: ./v.raw\n"), "the voxels");
  EXPECT_THAT(answer("a.nhdr", detached_ + "data file: v.raw\n"), HasSubstr("more voxels than its header states"));
  put("l.raw", "two\nlines\n" + kRaw);
  EXPECT_EQ(answer("a.nhdr", detached_ + "line skip: 2\ndata file: l.raw\n"), "the voxels");
  put("v.raw.gz", packed(std::string(9, 'x') + kRaw));
  EXPECT_EQ(answer("a.nhdr", replaced(detached_, "raw", "gzip") + "byte skip: 9\ndata file: v.raw.gz\n"), "the voxels");

  putSlices(5);
  const std::string list = "s0.raw\ns1.raw\ns2.raw\ns3.raw\ns4.raw\n";
  EXPECT_EQ(answer("a.nhdr", detached_ + "data file: LIST\n" + list), "the voxels");
  EXPECT_EQ(answer("a.nhdr", detached_ + "data file: LIST 2\n" + list), "the voxels");
  EXPECT_EQ(answer("a.nhdr", detached_ + "data file: s%d.raw 0 4 1\n"), "the voxels");
  EXPECT_EQ(answer("a.nhdr", detached_ + "data file: s%01d.raw 0 4 1 2\n"), "the voxels");
  EXPECT_THAT(answer("a.nhdr", detached_ + "data file: s%d.raw 0 3 1\n"),
              HasSubstr("names 4 data files where it needs 5"));
  EXPECT_THAT(answer("a.nhdr", detached_ + "data file: s%s%n.raw 0 4 1\n"), HasSubstr("needs one number"));
  EXPECT_THAT(answer("a.nhdr", detached_ + "data file: s%d.raw 0 4 0\n"), HasSubstr("is not valid"));
}

TEST_F(NrrdReading, AppliesUnitsOfLength) {
  const auto spacing_mm = [&](const std::string& line, double number) {
    on_disk::Scan scan = kScan;
    scan.step = glm::dmat3(number);
    put("a.nrrd", replaced(on_disk::nrrd(scan, "short", ""), "\n\n", "\nspace units: " + line + "\n\n") + kRaw);
    return assets::readImageHeader(folder_.at("a.nrrd")).geometry.step_P_mm[1][1];
  };
  EXPECT_DOUBLE_EQ(spacing_mm(R"("mm" "mm" "mm")", 0.5), 0.5);
  EXPECT_DOUBLE_EQ(spacing_mm(R"("m" "m" "m")", 0.0005), 0.5);
  EXPECT_DOUBLE_EQ(spacing_mm(R"("um" "um" "um")", 500), 0.5);
  EXPECT_DOUBLE_EQ(spacing_mm("\"\xc2\xb5m\" \"\xc2\xb5m\" \"\xc2\xb5m\"", 500), 0.5);
  EXPECT_DOUBLE_EQ(spacing_mm(R"("cm" "cm" "cm")", 0.05), 0.5);
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "\n\n", "\nspace units: \"mm\" \"ell\" \"mm\"\n\n") + kRaw),
              HasSubstr("'ell'"));
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "\n\n", "\nspace units: \"mm\"\n\n") + kRaw), HasSubstr("spaceunits"));

  const std::string plain =
      "NRRD0001\ntype: short\ndimension: 3\nsizes: 3 4 5\nspacings: 500 500 500\nunits: \"um\" \"um\" "
      "\"um\"\nendian: little\nencoding: raw\n\n";
  put("a.nrrd", plain + kRaw);
  EXPECT_DOUBLE_EQ(assets::readImageHeader(folder_.at("a.nrrd")).geometry.step_P_mm[2][2], 0.5);
}

/// The unit of a direction is that of the space; metres read as mm would be a thousand times too small.
TEST_F(NrrdReading, RefusesUnitsOfAxesWithDirections) {
  const auto with_units = [&](const std::string& units) {
    return answer("a.nrrd", replaced(nrrd_, "\n\n", "\nunits: " + units + "\n\n") + kRaw);
  };
  EXPECT_EQ(with_units(R"("mm" "" "none")"), "the voxels");
  EXPECT_THAT(with_units(R"("m" "m" "m")"), HasSubstr("belong to axes with directions"));
  EXPECT_THAT(with_units(R"("ell" "ell" "ell")"), HasSubstr("'ell'"));
}

TEST_F(NrrdReading, RecognisesLists) {
  put("list_of_bone.raw", kRaw);
  EXPECT_EQ(answer("a.nhdr", detached_ + "data file: list_of_bone.raw\nkey:=value\n"), "the voxels");
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "LOCAL", "list_of_bone.raw")), "the voxels");
}

TEST_F(ScanReading, ReportsWhetherTheOrientationIsStated) {
  const auto orientation_known = [&](const std::string& name, const std::string& bytes) {
    put(name, bytes + kRaw);
    return assets::readHounsfield(folder_.at(name)).orientation_known;
  };
  const std::string end = "endian: little\nencoding: raw\n\n";
  EXPECT_TRUE(orientation_known("a.nrrd", nrrd_));
  EXPECT_FALSE(
      orientation_known("a.nrrd", "NRRD0001\ntype: short\ndimension: 3\nsizes: 3 4 5\nspacings: 1 1 1\n" + end));
  EXPECT_FALSE(orientation_known("a.nrrd", replaced(nrrd_, "space: left-posterior-superior", "space dimension: 3")));
  EXPECT_TRUE(orientation_known("a.mha", meta_));
  EXPECT_FALSE(orientation_known("a.mha", replaced(meta_, "TransformMatrix", "AnotherMatrix")));
  EXPECT_TRUE(orientation_known("a.nii", nifti_.substr(0, 352)));
}

TEST_F(NrrdReading, DropsNonSpatialAxesOfOneVoxel) {
  const std::string end = "endian: little\nencoding: raw\n\n" + kRaw;
  EXPECT_EQ(answer("a.nrrd", "NRRD0001\ntype: short\ndimension: 4\nsizes: 1 3 4 5\nspacings: NaN .01 .01 .01\n" + end),
            "the voxels");
  EXPECT_EQ(answer("a.nrrd", "NRRD0001\ntype: short\ndimension: 4\nsizes: 3 4 5 1\nspacings: .1 .1 .1 2\n" + end),
            "the voxels");
  EXPECT_EQ(answer("a.nrrd",
                   "NRRD0004\ntype: short\ndimension: 4\nspace: LPS\nsizes: 1 3 4 5\nspace directions: none "
                   "(1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\n" +
                       end),
            "the voxels");
  EXPECT_THAT(answer("a.nrrd", "NRRD0001\ntype: short\ndimension: 4\nsizes: 3 2 2 5\nspacings: 1 1 1 1\n" + end),
              HasSubstr("it has 4 axes"));
}

TEST_F(NrrdReading, RefusesInvalidSpacings) {
  const auto spaced = [&](const std::string& spacings) {
    return answer("a.nrrd", "NRRD0001\ntype: short\ndimension: 3\nsizes: 3 4 5\nspacings: " + spacings +
                                "\nendian: little\nencoding: raw\n\n" + kRaw);
  };
  EXPECT_EQ(spaced("0.5 0.5 0.5"), "the voxels");
  for (const char* bad : {"0 1 1", "-1 1 1", "inf 1 1", "nan 1 1", "1e999 1 1", "1e-320 1 1", "1 1", "1 1 1 1", "1,1,1",
                          "", "0x1 1 1", "1e300 1 1"})
    EXPECT_THAT(spaced(bad), HasSubstr("a.nrrd: ")) << bad;
}

TEST_F(NrrdReading, RefusesMissingAndRepeatedFields) {
  for (const char* line : {"type: short\n", "dimension: 3\n", "sizes: 3 4 5\n", "encoding: raw\n", "endian: little\n"})
    EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, line, "") + kRaw), HasSubstr("a.nrrd: ")) << line;
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "endian: little\n", "") + kRaw), HasSubstr("byte order"));
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "sizes:", "sizes: 3 4 5\nsizes:") + kRaw), HasSubstr("twice"));
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "kinds", "kindness") + kRaw), HasSubstr("line 7 is not a field"));
  EXPECT_EQ(answer("a.nrrd", replaced(nrrd_, "kinds", "# a comment\nkey:=value: any\nkinds") + kRaw), "the voxels");
  EXPECT_THAT(answer("a.nrrd", nrrd_.substr(0, nrrd_.size() - 1) + kRaw), HasSubstr("blank line"));
}

TEST_F(VoxelReading, NeverLeavesTheHeadersFolder) {
  put("v.raw", kRaw);
  std::filesystem::create_directory(folder_.at("inside"));
  std::filesystem::create_directory(folder_.at("d"));
  put("inside/v.raw", kRaw);
  const std::string outside =
      folder_.at("") + "../" + std::filesystem::path(folder_.at("x")).parent_path().filename().string() + "_o.raw";
  on_disk::write(outside, kRaw);
  std::filesystem::create_symlink(outside, folder_.at("link.raw"));
  std::filesystem::create_symlink("v.raw", folder_.at("inner.raw"));
  ASSERT_EQ(::mkfifo(folder_.at("pipe.raw").c_str(), 0600), 0);
  for (const auto& [name, answered] : std::vector<std::pair<std::string, std::string>>{
           {"v.raw", "the voxels"},
           {"inside/v.raw", "the voxels"},
           {"inner.raw", "the voxels"},
           {folder_.at("v.raw"), "outside its folder"},
           {"inside/../v.raw", "outside its folder"},
           {"../" + std::filesystem::path(outside).filename().string(), "outside its folder"},
           {"link.raw", "outside its folder"},
           {"/dev/zero", "outside its folder"},
           {"pipe.raw", "not a regular file"},
           {"d", "not a regular file"},
           {".", "its data file '.'"},
           {"none.raw", "is not there"}}) {
    EXPECT_THAT(answer("a.nhdr", detached_ + "data file: " + name + "\n"), HasSubstr(answered)) << name;
    EXPECT_THAT(answer("a.mhd", replaced(meta_, "LOCAL", name)), HasSubstr(answered)) << name;
  }
  std::filesystem::remove(outside);
}

TEST_F(VoxelReading, RefusesAPipeAndADevice) {
  ASSERT_EQ(::mkfifo(folder_.at("pipe.nrrd").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder_.at("zero.nrrd"));
  for (const char* name : {"pipe.nrrd", "zero.nrrd"})
    EXPECT_THROW(assets::readHounsfield(folder_.at(name)), assets::LoadError);
}

TEST_F(VoxelReading, ReadsExactlyWhatTheHeaderStates) {
  for (const auto& [name, head] :
       std::map<std::string, std::string>{{"a.nrrd", nrrd_}, {"a.mha", meta_}, {"a.nii", nifti_.substr(0, 352)}}) {
    EXPECT_EQ(answer(name, head + kRaw), "the voxels");
    EXPECT_EQ(answer(name, head + kRaw + "\n"), "the voxels") << "a line end after them";
    EXPECT_THAT(answer(name, head + kRaw + "xx"), HasSubstr("more voxels than its header states"));
    EXPECT_THAT(answer(name, head + kRaw.substr(1)), HasSubstr("fewer voxels than its header states"));
    EXPECT_THAT(answer(name, head), HasSubstr("fewer voxels than its header states"));
  }
}

TEST_F(VoxelReading, ChecksACompressedStreamToItsEnd) {
  const std::string head = replaced(nrrd_, "raw", "gzip"), zipped = packed(kRaw);
  EXPECT_EQ(answer("a.nrrd", head + packed(kRaw.substr(0, 50)) + packed(kRaw.substr(50))), "the voxels")
      << "two members";
  for (std::size_t byte = 10; byte < zipped.size(); ++byte) {
    std::string changed = zipped;
    changed[byte] = static_cast<char>(changed[byte] ^ 4);
    EXPECT_THAT(answer("a.nrrd", head + changed), HasSubstr("a.nrrd: ")) << byte;
    EXPECT_THAT(answer("a.nrrd", head + zipped.substr(0, byte)), HasSubstr("a.nrrd: ")) << byte;
  }
  EXPECT_THAT(answer("a.nrrd", head + zipped + "more"), HasSubstr("extra bytes after its compressed voxels"));
  EXPECT_THAT(answer("a.nrrd", head + packed(kRaw + "\n")), HasSubstr("more voxels")) << "no line ends in a stream";
  EXPECT_THAT(answer("a.nrrd", head + packed(kRaw + "more")), HasSubstr("more voxels"));
}

TEST_F(VoxelReading, RefusesNumbersThatDoNotFitTheirType) {
  const std::string head = replaced(nrrd_, "raw", "ascii");
  std::string text = asText();
  EXPECT_THAT(answer("a.nrrd", head + replaced(text, "-300", "40000")),
              HasSubstr("'40000' is not a number of the stated type"));
  EXPECT_THAT(answer("a.nrrd", head + replaced(text, "-300", "1.5")),
              HasSubstr("'1.5' is not a number of the stated type"));
  EXPECT_THAT(answer("a.nrrd", head + replaced(text, "-300", "")), HasSubstr("fewer voxels"));
  EXPECT_THAT(answer("a.nrrd", head + text + " 7"), HasSubstr("more voxels"));
  EXPECT_THAT(answer("a.nrrd", replaced(nrrd_, "raw", "hex") + replaced(asHex(kRaw), "d", "g")),
              HasSubstr("hexadecimal"));
}

std::string niftiWith(std::string file, std::size_t at, auto value) {
  std::memcpy(file.data() + at, &value, sizeof value);
  return file;
}

TEST_F(NiftiReading, RescalesAsStated) {
  std::vector<std::uint16_t> raised;
  for (const auto value : countingUp()) raised.push_back(static_cast<std::uint16_t>(value + 1024));
  std::string file = on_disk::nifti(kScan, 512, 16, on_disk::bytesOf(raised));
  EXPECT_EQ(answer("a.nii", niftiWith(file, 116, -1024.0F)), "the voxels");
  std::vector<std::int16_t> halved;
  for (const auto value : countingUp()) halved.push_back(static_cast<std::int16_t>(value / 2));
  EXPECT_EQ(answer("a.nii", niftiWith(on_disk::nifti(kScan, 4, 16, on_disk::bytesOf(halved)), 112, 2.0F)),
            "the voxels");
  EXPECT_EQ(answer("a.nii", niftiWith(nifti_, 112, 0.0F)), "the voxels");
  EXPECT_EQ(answer("a.nii", niftiWith(nifti_, 112, std::nanf(""))), "the voxels");
  EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 112, HUGE_VALF)), HasSubstr("rescale"));
  EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 116, std::nanf(""))), HasSubstr("rescale"));
  EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 112, 1000.0F)), HasSubstr("lies outside -32768..32767"));
}

TEST_F(NiftiReading, AppliesUnitsAndVoxelOffset) {
  const auto unit = [&](char code) {
    std::string file = nifti_;
    file[123] = code;
    put("a.nii", file);
    return assets::readImageHeader(folder_.at("a.nii")).geometry.step_P_mm[0].x;
  };
  EXPECT_DOUBLE_EQ(unit(2), 0.5);
  EXPECT_DOUBLE_EQ(unit(0), 0.5);
  EXPECT_DOUBLE_EQ(unit(2 + 8), 0.5) << "seconds in the upper bits";
  EXPECT_THROW(unit(1), assets::LoadError) << "voxels of half a metre";
  EXPECT_THROW(unit(3), assets::LoadError) << "voxels of half a micrometre";
  EXPECT_THROW(unit(5), assets::LoadError);

  const std::string head = nifti_.substr(0, 352);
  EXPECT_EQ(answer("a.nii", niftiWith(head + std::string(48, 'e'), 108, 400.0F) + kRaw), "the voxels");
  for (const float bad : {512.0F, -32768.0F, 1.0e30F, 352.5F, 100.0F, std::nanf("")})
    EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 108, bad)), HasSubstr("a.nii: ")) << bad;
}

TEST_F(NiftiReading, ReadsEitherByteOrderAndCompressedFiles) {
  std::string file = nifti_;
  const auto reverse = [&](std::size_t at, std::size_t width) {
    std::reverse(file.begin() + static_cast<long>(at), file.begin() + static_cast<long>(at + width));
  };
  reverse(0, 4);
  for (std::size_t at = 40; at < 56; at += 2) reverse(at, 2);
  for (std::size_t at : {68, 70, 72, 252, 254}) reverse(at, 2);
  for (std::size_t at = 76; at < 120; at += 4) reverse(at, 4);
  for (std::size_t at = 256; at < 328; at += 4) reverse(at, 4);
  EXPECT_EQ(answer("a.nii", file.substr(0, 352) + bigEndian(kRaw)), "the voxels");
  EXPECT_EQ(answer("a.nii.gz", packed(nifti_)), "the voxels");
  EXPECT_EQ(answer("b.nii.gz", nifti_), "the voxels") << "the extension of a compressed file";
}

TEST_F(NiftiReading, RefusesInvalidGeometry) {
  for (const float bad : {0.0F, -0.5F, std::nanf(""), HUGE_VALF, 0.7F})
    EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 80, bad)), HasSubstr("pixdim")) << bad;
  EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 280, std::nanf(""))), HasSubstr("sform"));
  EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 292, 3.0e38F)), HasSubstr("1 km"));
  std::string quaternion = niftiWith(niftiWith(nifti_, 254, std::int16_t{0}), 252, std::int16_t{1});
  EXPECT_EQ(answer("a.nii", quaternion), "other voxels") << "RAS";
  EXPECT_THAT(answer("a.nii", niftiWith(quaternion, 256, 1.5F)), HasSubstr("qform"));
  EXPECT_THAT(answer("a.nii", niftiWith(quaternion, 260, std::nanf(""))), HasSubstr("qform"));
  EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 0, std::int32_t{540})), HasSubstr("NIfTI-2"));
  EXPECT_THAT(answer("a.nii", replaced(nifti_, "n+1", "ni1")), HasSubstr(".img"));
  for (const std::int16_t dimensions : {std::int16_t{0}, std::int16_t{2}, std::int16_t{9}, std::int16_t{-3}})
    EXPECT_THAT(answer("a.nii", niftiWith(nifti_, 40, dimensions)), HasSubstr("three axes"));
}

TEST_F(MetaReading, ReadsEveryCoding) {
  EXPECT_EQ(answer("a.mha", meta_ + kRaw), "the voxels");
  EXPECT_EQ(answer("a.mha", replaced(meta_, "MSB = False", "MSB = True") + bigEndian(kRaw)), "the voxels");
  EXPECT_EQ(answer("a.mha",
                   replaced(meta_, "CompressedData = False", "CompressedData = True") + packed(kRaw, on_disk::kZlib)),
            "the voxels");
  EXPECT_EQ(answer("a.mha", replaced(meta_, "CompressedData = False", "CompressedData = True") + packed(kRaw)),
            "the voxels");
  EXPECT_EQ(answer("a.mha", replaced(meta_, "BinaryData = True", "BinaryData = False") + asText()), "the voxels");
}

TEST_F(MetaReading, ReadsDataFilesInItsFolder) {
  put("v.raw", std::string(77, 'x') + kRaw);
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "ElementDataFile = LOCAL", "HeaderSize = 77\nElementDataFile = v.raw")),
            "the voxels");
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "ElementDataFile = LOCAL", "HeaderSize = -1\nElementDataFile = v.raw")),
            "the voxels");
  put("v.zraw", std::string(77, 'x') + packed(kRaw, on_disk::kZlib));
  const std::string packed = replaced(meta_, "CompressedData = False", "CompressedData = True");
  EXPECT_EQ(answer("a.mhd", replaced(packed, "ElementDataFile = LOCAL", "HeaderSize = 77\nElementDataFile = v.zraw")),
            "the voxels")
      << "bytes of the stored file";
  putSlices(5);
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "LOCAL", "LIST") + "s0.raw\ns1.raw\ns2.raw\ns3.raw\ns4.raw\n"),
            "the voxels");
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "LOCAL", "LIST 2D") + "s0.raw\ns1.raw\ns2.raw\n\ns3.raw\ns4.raw"),
            "the voxels");
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "LOCAL", "s%d.raw 0 4 1")), "the voxels");
  EXPECT_EQ(answer("a.mhd", replaced(meta_, "LOCAL", "s%d.raw 0")), "the voxels");
  EXPECT_THAT(answer("a.mhd", replaced(meta_, "LOCAL", "LIST") + "s0.raw\ns1.raw\n"),
              HasSubstr("lists 2 data files where it needs 5"));
  EXPECT_THAT(answer("a.mhd", replaced(meta_, "LOCAL", "s%d.raw 0 9 1")),
              HasSubstr("names 10 data files where it needs 5"));
  EXPECT_THAT(answer("a.mhd", replaced(meta_, "LOCAL", "s%d%d.raw 0 4 1")), HasSubstr("needs one number"));
}

TEST_F(MetaReading, RefusesInvalidGeometry) {
  const std::string spacing = "ElementSpacing = 0.5 0.5 0.5";
  for (const char* bad : {"0 1 1", "-1 1 1", "nan 1 1", "inf 1 1", "1 1", "1e999 1 1", "1 1 1 1", "none"})
    EXPECT_THAT(answer("a.mha", replaced(meta_, spacing, std::string("ElementSpacing = ") + bad) + kRaw),
                HasSubstr("a.mha: "))
        << bad;
  EXPECT_THAT(answer("a.mha", replaced(meta_, "TransformMatrix = 1 0 0", "TransformMatrix = 2 0 0") + kRaw),
              HasSubstr("length 1"));
  EXPECT_THAT(answer("a.mha", replaced(meta_, "NDims = 3", "NDims = 65536") + kRaw), HasSubstr("ndims"));
  EXPECT_THAT(answer("a.mha", replaced(meta_, "MET_SHORT", "MET_SHORT_ARRAY") + kRaw), HasSubstr("vectors"));
  EXPECT_THAT(answer("a.mha", replaced(meta_, "NDims = 3", "NDims = 3\nElementNumberOfChannels = 3") + kRaw),
              HasSubstr("vectors"));
  EXPECT_EQ(answer("a.mha", replaced(meta_, "NDims = 3", "NDims = 3\nITK_InputFilterName = any: thing") + kRaw),
            "the voxels");
}

}  // namespace
