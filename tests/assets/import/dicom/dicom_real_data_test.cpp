// The folders of defects and the files of every packing that lie beside the project (shared_data.h).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "assets/import/dicom/dicom_survey.h"
#include "assets/import/dicom/dicom_volume.h"
#include "assets/import/dicom/frame_reader.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/shared_data.h"

namespace {

namespace fs = std::filesystem;

std::string verdictCodes(const assets::DicomSurvey& survey) {
  std::string list;
  for (const assets::DicomVerdict& verdict : survey.verdicts)
    list += (list.empty() ? "" : " ") + verdict.code + (verdict.stops ? "!" : "");
  return list;
}

class DicomRealData : public testing::Test {
 protected:
  void SetUp() override { MOLAR_NEEDS(root_); }

  assets::DicomSurvey folder(const std::string& name, const assets::DicomChoices& choices = {}) const {
    return assets::surveyDicom((root_ / "synthetic" / name).string(), choices);
  }
  /// Grey values of a whole file, whatever its modality; empty: it cannot be decoded.
  std::vector<std::int16_t> greyOf(const std::string& name) const {
    assets::DicomFolder one = assets::readDicomFolder((root_ / name).string(), {});
    const assets::DicomHeader& header = one.files.at(0).header;
    if (header.fault != assets::DicomFault::none || header.planes.empty()) return {};
    std::vector<assets::DicomSlice> slices;
    for (std::size_t frame = 0; frame < header.planes.size(); ++frame) slices.push_back({0, frame});
    std::vector<std::int16_t> grey(header.pixelCount() * slices.size());
    return assets::readFrames(one, slices, grey).empty() ? grey : std::vector<std::int16_t>();
  }

  const fs::path root_ = tests::sharedData("dicom");
};

TEST_F(DicomRealData, EveryDefectHasItsVerdict) {
  const std::map<std::string, std::string> expected = {{"01_plain_shuffled_names", ""},
                                                       {"02_reversed_instance_numbers", ""},
                                                       {"03_implicit_vr_signed", ""},
                                                       {"04_slope_half_intercept", ""},
                                                       {"05_missing_slices", "G3!"},
                                                       {"06_duplicate_slices", "D1"},
                                                       {"07_gantry_tilt_15", "T1"},
                                                       {"08_no_pixel_spacing", "P1!"},
                                                       {"09_no_position", "P2!"},
                                                       {"10_irregular_spacing", "G2"},
                                                       {"11_two_series_mixed", "S1"},
                                                       {"12_left_handed_iop", ""},
                                                       {"13_rle", ""},
                                                       {"14_jpeg2000", ""},
                                                       {"15_jpegls", ""},
                                                       {"16_jpeg_lossless", ""},
                                                       {"17_truncated_file", "F1!"}};
  for (const auto& [name, verdict] : expected) EXPECT_EQ(verdictCodes(folder(name)), verdict) << name;
}

TEST_F(DicomRealData, WhatIsWholeIsTheSameVolumeBitForBit) {
  const assets::DicomSurvey plain = folder("01_plain_shuffled_names");
  const std::vector<std::int16_t> expected = assets::readDicomVolume(plain);
  EXPECT_EQ(plain.plan->geometry.size, glm::ivec3(72, 80, 72));
  EXPECT_EQ(*std::ranges::min_element(expected), -1024);
  EXPECT_EQ(*std::ranges::max_element(expected), 2636);
  EXPECT_NEAR(glm::distance(plain.plan->geometry.origin_P_mm, glm::dvec3(42.75, 67.95, 38.35)), 0.0, 1e-9);
  for (const char* name :
       {"02_reversed_instance_numbers", "03_implicit_vr_signed", "04_slope_half_intercept", "06_duplicate_slices",
        "11_two_series_mixed", "13_rle", "14_jpeg2000", "15_jpegls", "16_jpeg_lossless"})
    EXPECT_EQ(assets::readDicomVolume(folder(name)), expected) << name;
  const assets::DicomSurvey mirrored = folder("12_left_handed_iop");
  const assets::Resampling upright(plain.plan->geometry, "scan"), turned(mirrored.plan->geometry, "scan");
  // The same pixels with rows that run the other way: a mirrored body.
  std::vector<std::int16_t> other = turned.linear(assets::readDicomVolume(mirrored), -1000);
  EXPECT_NEAR(turned.grid().origin_P_mm.x, 42.75 - 71 * 0.4, 1e-9);
  for (auto row = other.begin(); row != other.end(); row += 72) std::reverse(row, row + 72);
  EXPECT_EQ(other, upright.linear(expected, -1000));
}

TEST_F(DicomRealData, MissingSlicesAreBridgedOnDemandAndTheRestStays) {
  assets::DicomChoices filling;
  filling.fill_gaps = true;
  const assets::DicomSurvey survey = folder("05_missing_slices", filling);
  EXPECT_EQ(verdictCodes(survey), "G3");
  const auto bridged = assets::readDicomVolume(survey);
  const auto whole = assets::readDicomVolume(folder("01_plain_shuffled_names"));
  ASSERT_EQ(bridged.size(), whole.size());
  const std::size_t pixels = 72 * 80;
  for (std::size_t k = 0; k < 72; ++k)
    EXPECT_EQ(std::equal(whole.begin() + static_cast<std::ptrdiff_t>(k * pixels),
                         whole.begin() + static_cast<std::ptrdiff_t>((k + 1) * pixels),
                         bridged.begin() + static_cast<std::ptrdiff_t>(k * pixels)),
              k < 20 || k > 22)
        << k;
}

TEST_F(DicomRealData, EveryPackingOfOneSliceDecodesToIt) {
  const std::string stem = "transfer_syntaxes/CTImage.dcm";
  const auto expected = greyOf(stem + "_LittleEndianExplicitTransferSyntax_1.2.840.10008.1.2.1.dcm");
  ASSERT_EQ(expected.size(), 512U * 512U);
  /// The largest difference that each packing may make.
  const std::map<std::string, int> packings = {
      {"LittleEndianImplicitTransferSyntax_1.2.840.10008.1.2", 0},
      {"BigEndianExplicitTransferSyntax_1.2.840.10008.1.2.2", 0},
      {"DeflatedExplicitVRLittleEndianTransferSyntax_1.2.840.10008.1.2.1.99", 0},
      {"RLELosslessTransferSyntax_1.2.840.10008.1.2.5", 0},
      {"JPEGProcess14TransferSyntax_1.2.840.10008.1.2.4.57", 0},
      {"JPEGProcess14SV1TransferSyntax_1.2.840.10008.1.2.4.70", 0},
      {"JPEGLSLosslessTransferSyntax_1.2.840.10008.1.2.4.80", 0},
      {"JPEG2000LosslessOnlyTransferSyntax_1.2.840.10008.1.2.4.90", 0},
      {"JPEGLSLossyTransferSyntax_1.2.840.10008.1.2.4.81", 3},
      {"JPEG2000TransferSyntax_1.2.840.10008.1.2.4.91", 8},
      {"JPEGProcess2_4TransferSyntax_1.2.840.10008.1.2.4.51", 60},
      {"JPEGProcess6_8TransferSyntax_1.2.840.10008.1.2.4.53", 60},
      {"JPEGProcess10_12TransferSyntax_1.2.840.10008.1.2.4.55", 60}};
  for (const auto& [name, most] : packings) {
    const auto grey = greyOf(stem + "_" + name + ".dcm");
    ASSERT_EQ(grey.size(), expected.size()) << name;
    int farthest = 0;
    for (std::size_t n = 0; n < grey.size(); ++n) farthest = std::max(farthest, std::abs(grey[n] - expected[n]));
    EXPECT_LE(farthest, most) << name;
  }
  EXPECT_FALSE(greyOf(stem + "_JPEGProcess1TransferSyntax_1.2.840.10008.1.2.4.50.dcm").empty());
}

TEST_F(DicomRealData, OddFilesAreReadOrRefusedNeverFilled) {
  EXPECT_EQ(greyOf("odd/693_J2KR.dcm").size(), 512U * 512U);
  for (const char* name : {"odd/emri_small_RLE.dcm", "odd/emri_small_big_endian.dcm",
                           "odd/emri_small_jpeg_2k_lossless.dcm", "odd/emri_small_jpeg_ls_lossless.dcm",
                           "odd/emri_small_jpeg_2k_lossless_too_short.dcm" /* its delimiter alone is missing */})
    EXPECT_EQ(greyOf(name), greyOf("odd/emri_small.dcm")) << name;
  EXPECT_EQ(greyOf("odd/emri_small.dcm").size(), 10U * 64U * 64U);
  EXPECT_EQ(greyOf("transfer_syntaxes/CT1_J2KR").size(), 512U * 512U);
  EXPECT_FALSE(greyOf("transfer_syntaxes/CT0012.fragmented_no_bot_jpeg_baseline.51.dcm").empty());
  for (const char* name :
       {"odd/MR_truncated.dcm", "odd/badVR.dcm", "odd/liver_deflate.dcm", "transfer_syntaxes/no-pixel-data.dcm"})
    EXPECT_TRUE(greyOf(name).empty()) << name;

  // A slice of 13 bits whose header says signed and whose stream does not.
  const auto unsigned_grey = greyOf("odd/J2K_pixelrep_mismatch.dcm");
  ASSERT_EQ(unsigned_grey.size(), 512U * 512U);
}

// The fragment's length is as it was; the decoder would fill what is lost.
TEST_F(DicomRealData, AStreamWithoutItsEndIsRefused) {
  for (const char* name : {"14_jpeg2000", "15_jpegls", "16_jpeg_lossless"}) {
    std::string bytes = on_disk::read((root_ / "synthetic" / name / "IM0000").string());
    const std::size_t end = bytes.rfind("\xff\xd9");
    ASSERT_NE(end, std::string::npos);
    bytes.replace(end - 6, 8, 8, '\0');
    const on_disk::Folder folder;
    on_disk::write(folder.at("IM0000"), bytes);
    const assets::DicomFolder one = assets::readDicomFolder(folder.at("IM0000"), {});
    ASSERT_EQ(one.files[0].header.fault, assets::DicomFault::none) << name;
    std::vector<std::int16_t> grey(72 * 80);
    EXPECT_EQ(assets::readFrames(one, {{0, 0}}, grey), (std::vector<std::size_t>{0})) << name;
  }
}

TEST_F(DicomRealData, EachFileAloneHasAVerdictThatStops) {
  std::size_t files = 0;
  for (const char* below : {"odd", "transfer_syntaxes"})
    for (const auto& entry : fs::directory_iterator(root_ / below)) {
      if (entry.path().filename() == "LICENSE") continue;
      const assets::DicomSurvey survey = assets::surveyDicom(entry.path().string(), {});
      ASSERT_NE(survey.refusal(), nullptr) << entry.path();
      ++files;
    }
  EXPECT_EQ(files, 43U);
  const auto verdict = [&](const char* name) { return verdictCodes(assets::surveyDicom((root_ / name).string(), {})); };
  EXPECT_EQ(verdict("odd/MR_truncated.dcm"), "F1!");
  EXPECT_EQ(verdict("odd/liver_deflate.dcm"), "F2!");
  EXPECT_EQ(verdict("odd/emri_small.dcm"), "F3!");
  EXPECT_EQ(verdict("odd/no_meta.dcm"), "F3!");  // a byte too many at its beginning
  EXPECT_EQ(verdict("odd/CT_small.dcm"), "G1!");
  EXPECT_EQ(verdict("transfer_syntaxes/no-pixel-spacing.dcm"), "F2!");  // a palette of colours
}

}  // namespace
