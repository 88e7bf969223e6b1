#include "assets/import/dicom/dicom_survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "assets/load_error.h"
#include "tests/assets/import/dicom/dicom_on_disk.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"

namespace {

using assets::DicomChoices;
using assets::DicomSurvey;
using dicom_on_disk::Elements;
using dicom_on_disk::Series;
using testing::HasSubstr;

double ramp(const glm::dvec3& p) { return 10.0 * p.x + 3.0 * p.y - 7.0 * p.z; }

using Change = std::function<void(Elements& file, int k)>;

void writeSeries(const on_disk::Folder& folder, const Series& series, const Change& change = {},
                 const std::string& stem = "IM") {
  for (int k = 0; k < series.slices; ++k) {
    Elements file = dicom_on_disk::sliceOf(series, k, ramp);
    if (change) change(file, k);
    if (!file.empty())
      on_disk::write(folder.at(stem + std::to_string(100 + (k * 37) % 64)), dicom_on_disk::bytesOf(file));
  }
}

std::string codes(const DicomSurvey& survey) {
  std::string list;
  for (const assets::DicomVerdict& verdict : survey.verdicts)
    list += (list.empty() ? "" : " ") + verdict.code + (verdict.stops ? "!" : "");
  return list;
}

std::string sentenceOf(const DicomSurvey& survey, const std::string& code) {
  for (const assets::DicomVerdict& verdict : survey.verdicts)
    if (verdict.code == code) return assets::lineOf(verdict);
  return "no " + code;
}

DicomSurvey surveyed(const on_disk::Folder& folder, const DicomChoices& choices = {}) {
  return assets::surveyDicom(folder.at(""), choices);
}

TEST(DicomSurvey, TakesAnOrdinarySeriesWithoutAWord) {
  const on_disk::Folder folder;
  writeSeries(folder, {});
  const DicomSurvey survey = surveyed(folder);
  EXPECT_EQ(codes(survey), "");
  ASSERT_TRUE(survey.plan);
  EXPECT_EQ(survey.plan->geometry.size, glm::ivec3(72, 64, 64));
  EXPECT_NEAR(glm::distance(survey.plan->geometry.step_P_mm[2], glm::dvec3(0, 0, 0.5)), 0.0, 1e-9);
}

TEST(DicomSurvey, NeverInventsASpacing) {
  const on_disk::Folder folder;
  writeSeries(folder, {}, [](Elements& file, int) { file.erase(0x00280030); });
  EXPECT_EQ(codes(surveyed(folder)), "P1!");
  DicomChoices said;
  said.spacing_mm = glm::dvec3(0.5);
  EXPECT_EQ(codes(surveyed(folder, said)), "");
  EXPECT_NEAR(glm::length(surveyed(folder, said).plan->geometry.step_P_mm[0]), 0.5, 1e-12);
}

TEST(DicomSurvey, NeverInventsAPosition) {
  const on_disk::Folder folder;
  writeSeries(folder, {}, [](Elements& file, int) {
    file.erase(0x00200032);
    file.erase(0x00200037);
    file[0x00180050] = dicom_on_disk::decimals({0.5});
  });
  EXPECT_THAT(sentenceOf(surveyed(folder), "P2"),
              HasSubstr("thickness says 0.5 mm; if slices touch, run again with --spacing-from-thickness"));
  EXPECT_EQ(codes(surveyed(folder)), "P2!");
  DicomChoices touching;
  touching.spacing_from_thickness = true;
  EXPECT_EQ(codes(surveyed(folder, touching)), "P2");
  DicomChoices ordered;
  ordered.assume_order = true;
  ordered.spacing_mm = glm::dvec3(0.6);
  const DicomSurvey survey = surveyed(folder, ordered);
  EXPECT_EQ(codes(survey), "P2");
  EXPECT_NEAR(survey.plan->geometry.step_P_mm[2].z, 0.6, 1e-12);
}

// Of a series without positions, its numbers from 1.
TEST(DicomSurvey, NumbersThatAreMissingOrTwiceAreNotPassedOver) {
  const on_disk::Folder folder;
  Series series;
  series.slices = 70;
  const auto write = [&](const std::string& name, int k, int number) {
    Elements file = dicom_on_disk::sliceOf(series, k, ramp);
    file.erase(0x00200032);
    file[0x00200013] = dicom_on_disk::text("IS", std::to_string(number));
    on_disk::write(folder.at(name), dicom_on_disk::bytesOf(file));
  };
  for (int k = 0; k < series.slices; ++k)
    if (k < 20 || k > 22) write("IM" + std::to_string(k), k, 2 * k + 2);
  DicomChoices ordered;
  ordered.assume_order = true;
  ordered.spacing_mm = glm::dvec3(0.5);
  EXPECT_NE(sentenceOf(surveyed(folder, ordered), "G3").find("21 to 23 of 70"), std::string::npos);
  for (int k = 20; k < 23; ++k) write("IM" + std::to_string(k), k, 2 * k + 2);
  EXPECT_EQ(codes(surveyed(folder, ordered)), "P2");
  write("again", 5, 12);
  const DicomSurvey survey = surveyed(folder, ordered);
  EXPECT_NE(sentenceOf(survey, "D1").find("1 slice is there twice"), std::string::npos);
  EXPECT_EQ(survey.plan->geometry.size.z, 70);
}

TEST(DicomSurvey, PlacesWithoutDirectionsAreRefused) {
  const on_disk::Folder folder;
  Series series;
  series.slices = 70;
  for (int k = 0; k < series.slices; ++k) {
    Elements file = dicom_on_disk::sliceOf(series, k, ramp);
    file.erase(0x00200037);
    on_disk::write(folder.at("IM" + std::to_string(k)), dicom_on_disk::bytesOf(file));
  }
  DicomChoices touching;
  touching.spacing_from_thickness = true;
  EXPECT_NE(sentenceOf(surveyed(folder, touching), "P2").find("not which way its rows"), std::string::npos);
}

TEST(DicomSurvey, RefusesMissingSlicesUnlessTheyMayBeBridged) {
  const on_disk::Folder folder;
  Series series;
  series.slices = 70;
  for (int k = 0; k < series.slices; ++k)
    if (k < 20 || k > 22)
      on_disk::write(folder.at("IM" + std::to_string(k)),
                     dicom_on_disk::bytesOf(dicom_on_disk::sliceOf(series, k, ramp)));
  EXPECT_EQ(sentenceOf(surveyed(folder), "G3"),
            "scan: slices 21 to 23 of 70 are missing (1.5 mm); copy the scan again, or run with --fill-gaps to bridge "
            "them");
  DicomChoices filling;
  filling.fill_gaps = true;
  const DicomSurvey survey = surveyed(folder, filling);
  EXPECT_EQ(codes(survey), "G3");
  EXPECT_EQ(survey.plan->geometry.size.z, 70);
  EXPECT_EQ(survey.plan->invented_slices, 3U);
}

TEST(DicomSurvey, KeepsOneOfIdenticalSlicesAndRefusesDifferentOnes) {
  const on_disk::Folder folder;
  writeSeries(folder, {});
  const Elements twice = dicom_on_disk::sliceOf({}, 9, ramp);
  on_disk::write(folder.at("IM9"), dicom_on_disk::bytesOf(twice));
  EXPECT_EQ(codes(surveyed(folder)), "D1");
  EXPECT_EQ(surveyed(folder).plan->geometry.size.z, 64);
  Elements other = twice;
  other[0x7fe00010].bytes[0] = static_cast<char>(other[0x7fe00010].bytes[0] ^ 1);
  on_disk::write(folder.at("IM9"), dicom_on_disk::bytesOf(other));
  EXPECT_EQ(codes(surveyed(folder)), "D2!");
}

TEST(DicomSurvey, JoinsSeriesThatFillEachOthersGapsAndNoOthers) {
  const on_disk::Folder folder;
  writeSeries(folder, {}, [](Elements& file, int k) {
    if (k % 9 == 4) file[0x0020000e] = dicom_on_disk::text("UI", "1.2.3." + std::to_string(2 + k % 2));
  });
  EXPECT_EQ(sentenceOf(surveyed(folder), "S1"), "scan: 3 series belong together and were joined (64 slices)");
  EXPECT_EQ(codes(surveyed(folder)), "S1");

  // A second reconstruction of the same scan.
  const on_disk::Folder two;
  writeSeries(two, {});
  Series fine;
  fine.step_P_mm.z = 0.45;
  writeSeries(
      two, fine, [](Elements& file, int) { file[0x0020000e] = dicom_on_disk::text("UI", "1.2.3.7"); }, "CT");
  const DicomSurvey survey = surveyed(two);
  EXPECT_EQ(codes(survey), "S2");
  EXPECT_EQ(survey.sorted.series.size(), 2U);
  DicomChoices second;
  second.series = 2;
  EXPECT_NE(surveyed(two, second).plan->geometry.step_P_mm[2].z, survey.plan->geometry.step_P_mm[2].z);
  second.series = 3;
  EXPECT_THAT(tests::refusalOf<assets::LoadError>([&] { surveyed(two, second); }), HasSubstr("no --series 3"));
}

TEST(DicomSurvey, JoinsSlicesThatAreASeriesEach) {
  const on_disk::Folder folder;
  writeSeries(folder, {}, [](Elements& file, int k) {
    file[0x0020000e] = dicom_on_disk::text("UI", "1.2.3." + std::to_string(100 + k));
  });
  EXPECT_EQ(codes(surveyed(folder)), "S1");
}

TEST(DicomSurvey, PassesOverScoutsScreenshotsAndOtherPictures) {
  const on_disk::Folder folder;
  writeSeries(folder, {});
  const auto add = [&](const std::string& name, const Change& change) {
    Elements file = dicom_on_disk::sliceOf({}, 3, ramp);
    change(file, 0);
    on_disk::write(folder.at(name), dicom_on_disk::bytesOf(file));
  };
  add("IM1", [](Elements& file, int) { file[0x00080008] = dicom_on_disk::text("CS", "ORIGINAL\\PRIMARY\\LOCALIZER"); });
  add("IM2", [](Elements& file, int) { file[0x00080016] = dicom_on_disk::text("UI", "1.2.840.10008.5.1.4.1.1.7"); });
  add("IM3", [](Elements& file, int) { file[0x00080060] = dicom_on_disk::text("CS", "PX"); });
  on_disk::write(folder.at("viewer.exe"), "MZ and so on");
  on_disk::write(folder.at("DICOMDIR"), std::string(128, '\0') + "DICM");
  const DicomSurvey survey = surveyed(folder);
  EXPECT_EQ(codes(survey), "");
  EXPECT_EQ(survey.sorted.counts.localizers, 1U);
  EXPECT_EQ(survey.sorted.counts.captures, 1U);
  EXPECT_EQ(survey.sorted.counts.other_modalities, 1U);
  EXPECT_EQ(survey.sorted.counts.not_dicom, 1U);
  EXPECT_EQ(codes(assets::surveyDicom(folder.at("DICOMDIR"), {})), "");
}

TEST(DicomSurvey, NamesAFileThatEndsTooSoonUnlessItIsLeftOut) {
  const on_disk::Folder folder;
  writeSeries(folder, {}, [](Elements& file, int k) {
    if (k == 0) file.clear();
  });
  std::string bytes = dicom_on_disk::bytesOf(dicom_on_disk::sliceOf({}, 0, ramp));
  bytes.resize(bytes.size() - 5000);
  on_disk::write(folder.at("IM5"), bytes);
  EXPECT_EQ(
      sentenceOf(surveyed(folder), "F1"),
      "scan/IM5: the file ends after 4,216 of 9,216 bytes of its image; copy it from the CD again, or leave it out "
      "with --without IM5");
  DicomChoices without;
  without.without = {"IM5"};
  EXPECT_EQ(codes(surveyed(folder, without)), "");
  without.without = {"IM6"};
  EXPECT_THAT(tests::refusalOf<assets::LoadError>([&] { surveyed(folder, without); }), HasSubstr("not in it"));
}

TEST(DicomSurvey, AnEmptyFileAmongTheNumbersOfASeriesIsNotPassedOver) {
  const on_disk::Folder folder;
  writeSeries(folder, {});
  on_disk::write(folder.at("notes.txt"), "");
  on_disk::write(folder.at("other/IM900"), "");
  EXPECT_EQ(codes(surveyed(folder)), "") << "of another name or folder";
  on_disk::write(folder.at("IM900"), "");
  EXPECT_EQ(codes(surveyed(folder)), "F1!");
  EXPECT_THAT(sentenceOf(surveyed(folder), "F1"), HasSubstr("scan/IM900: the file is empty"));
  DicomChoices choices;
  choices.without = {"IM900"};
  EXPECT_EQ(codes(surveyed(folder, choices)), "");
}

TEST(DicomSurvey, RefusesSlicesOfMorePixelsThanAreRead) {
  const on_disk::Folder folder;
  Series wide;
  wide.columns = 8200, wide.slices = 2;
  writeSeries(folder, wide);
  EXPECT_EQ(codes(surveyed(folder)), "R3!");
}

TEST(DicomSurvey, SaysNoToTooFewTooCoarseAndTooSmall) {
  const on_disk::Folder few, coarse, low;
  Series series;
  series.slices = 9;
  writeSeries(few, series);
  EXPECT_EQ(sentenceOf(surveyed(few), "G1"), "scan: only 9 slices; a jaw needs at least 60");
  series = {};
  series.step_P_mm.z = 2.0;
  writeSeries(coarse, series);
  EXPECT_EQ(sentenceOf(surveyed(coarse), "R1"),
            "scan: slices are 2 mm apart; below 1 mm a third molar cannot be rehearsed");
  series.step_P_mm.z = 0.3;
  writeSeries(low, series);
  EXPECT_EQ(sentenceOf(surveyed(low), "R2"), "scan: the volume is 19 mm high: no whole lower jaw");
}

TEST(DicomSurvey, AsksForBurntInTextToBeLookedAt) {
  const on_disk::Folder folder;
  writeSeries(folder, {}, [](Elements& file, int) { file[0x00280301] = dicom_on_disk::text("CS", "YES"); });
  EXPECT_EQ(codes(surveyed(folder)), "B1!");
  DicomChoices checked;
  checked.burnt_in_checked = true;
  EXPECT_EQ(codes(surveyed(folder, checked)), "");
}

TEST(DicomSurvey, ReadsAMultiFrameFileByTheGroupsOfItsFrames) {
  const on_disk::Folder folder;
  const Series series;
  Elements file = dicom_on_disk::sliceOf(series, 0, ramp);
  std::string pixels;
  std::vector<std::string> frames;
  for (int n = 0; n < series.slices; ++n) {
    const int k = (n * 37) % series.slices;  // in no order
    const Elements one = dicom_on_disk::sliceOf(series, k, ramp);
    pixels += one.at(0x7fe00010).bytes;
    frames.push_back(dicom_on_disk::element(
        0x00209113, dicom_on_disk::sequence({dicom_on_disk::element(0x00200032, one.at(0x00200032))})));
  }
  const std::string shared =
      dicom_on_disk::element(0x00209116,
                             dicom_on_disk::sequence({dicom_on_disk::element(0x00200037, file.at(0x00200037))})) +
      dicom_on_disk::element(0x00289110,
                             dicom_on_disk::sequence({dicom_on_disk::element(0x00280030, file.at(0x00280030))}));
  for (const std::uint32_t tag : {0x00200032U, 0x00200037U, 0x00280030U}) file.erase(tag);
  file[0x00280008] = dicom_on_disk::text("IS", std::to_string(series.slices));
  file[0x52009229] = dicom_on_disk::sequence({shared});
  file[0x52009230] = dicom_on_disk::sequence(frames);
  file[0x7fe00010].bytes = pixels;
  on_disk::write(folder.at("IM1"), dicom_on_disk::bytesOf(file));
  EXPECT_EQ(codes(surveyed(folder)), "");
  EXPECT_EQ(surveyed(folder).plan->geometry.size.z, 64);
  file.erase(0x52009230);
  on_disk::write(folder.at("IM1"), dicom_on_disk::bytesOf(file));
  EXPECT_EQ(codes(surveyed(folder)), "P2!");
}

TEST(DicomSurvey, NoFolderOfPicturesIsSaidPlainly) {
  const on_disk::Folder folder;
  Elements file = dicom_on_disk::sliceOf({}, 0, ramp);
  file.erase(0x7fe00010);
  on_disk::write(folder.at("IM1"), dicom_on_disk::bytesOf(file));
  EXPECT_EQ(sentenceOf(surveyed(folder), "F3"),
            "scan: 1 file, none a DICOM image; choose the folder that holds the many equal-sized files");
}

TEST(DicomFolder, ShowsOnlyNamesThatSayNothingOfAPerson) {
  for (const char* name : {"IM0005", "I12", "slice_001.dcm", "00017.dcm", "IMG-3.ima"})
    EXPECT_TRUE(assets::isPlainFileName(name)) << name;
  for (const char* name : {"Miller_001.dcm", "Anna.dcm", "IM0005.Miller", "1.2.840.113619.2.5.dcm", "20011231123",
                           "IM001 Miller.dcm", "readme"})
    EXPECT_FALSE(assets::isPlainFileName(name)) << name;

  const on_disk::Folder folder;
  Elements file = dicom_on_disk::sliceOf({}, 0, ramp);
  file[0x00100020] = dicom_on_disk::text("LO", "0042");
  on_disk::write(folder.at("IM0042"), dicom_on_disk::bytesOf(file));
  on_disk::write(folder.at("Miller"), dicom_on_disk::bytesOf(file));
  const assets::DicomFolder read = assets::readDicomFolder(folder.at(""), {});
  EXPECT_EQ(read.files[0].shown, "file 1");
  EXPECT_EQ(read.files[1].shown, "file 2");
}

}  // namespace
