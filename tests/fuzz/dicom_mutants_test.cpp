// Damaged DICOM files: every header read is a fault that is said or one whose pixels lie inside the file, and pixels
// are as stored or refused. Compressed streams are decoded in children, which costs more.
#include <gtest/gtest.h>

#include "assets/import/dicom/dicom_volume.h"
#include "assets/import/dicom/frame_reader.h"
#include "assets/import/dicom/stored_frame.h"
#include "assets/load_error.h"
#include "tests/assets/import/dicom/dicom_on_disk.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/mutants.h"
#include "tests/refusal.h"
#include "tests/shared_data.h"

namespace {

using dicom_on_disk::Elements;

std::string plainFile() {
  std::vector<std::int16_t> stored(64 * 64);
  for (std::size_t n = 0; n < stored.size(); ++n) stored[n] = static_cast<std::int16_t>(17 * n % 3000);
  Elements file = dicom_on_disk::slice(64, 64, stored);
  file[0x00200032] = dicom_on_disk::decimals({1, 2, 3});
  file[0x00280120] = dicom_on_disk::shortValue(5);
  return dicom_on_disk::bytesOf(file);
}

std::string groupedFile() {
  using namespace dicom_on_disk;
  Elements file = slice(64, 64, std::vector<std::int16_t>(64 * 64 * 2, 7));
  const std::string place = element(0x00209113, sequence({element(0x00200032, decimals({1, 2, 3}))}));
  const std::string scale = element(0x00289145, sequence({element(0x00281053, decimals({0.5}))}));
  file[0x00280008] = text("IS", "2");
  file[0x00081140] = sequence({element(0x00081150, text("UI", "1.2")), ""});
  file[0x52009229] = sequence({element(0x00289110, sequence({element(0x00280030, decimals({0.3, 0.3}))}))});
  file[0x52009230] = sequence({place + scale, place});
  return bytesOf(file);
}

std::string deflatedFile() {
  const std::string whole = plainFile();
  const std::string syntax = "1.2.840.10008.1.2.1.99";
  const std::string head = dicom_on_disk::bytesOf({}, syntax);
  return head + on_disk::packed(whole.substr(dicom_on_disk::bytesOf({}).size()), -15);
}

std::string runLengthFile() {
  using namespace dicom_on_disk;
  Elements file = slice(64, 64, {});
  std::string segments(64, '\0');
  const std::uint32_t two = 2, first = 64, second = 64 + 64;
  std::memcpy(segments.data(), &two, 4);
  std::memcpy(segments.data() + 4, &first, 4);
  std::memcpy(segments.data() + 8, &second, 4);
  for (int segment = 0; segment < 2; ++segment)
    for (int n = 0; n < 32; ++n) segments += std::string{static_cast<char>(-127), static_cast<char>(n)};
  const std::string delimiter = raw(std::uint16_t{0xfffe}) + raw(std::uint16_t{0xe0dd}) + std::string(4, '\0');
  file.erase(0x7fe00010);
  return bytesOf(file, "1.2.840.10008.1.2.5") + raw(std::uint16_t{0x7fe0}) + raw(std::uint16_t{0x0010}) + "OB" +
         std::string(2, '\0') + std::string(4, '\xff') + item("") + item(segments) + delimiter;
}

void expectSound(const std::string& file) {
  const assets::OpenedDicom opened = assets::openDicom(assets::DicomBytes::ofMemory(file), "IM0001");
  const assets::DicomHeader& header = opened.header;
  if (header.fault != assets::DicomFault::none || header.kind == assets::DicomKind::no_image) return;
  ASSERT_EQ(header.planes.size(), static_cast<std::size_t>(header.frames));
  ASSERT_GT(header.pixelCount(), 0U);
  if (header.syntax->packing > assets::PixelPacking::run_length) return;
  for (std::size_t frame = 0; frame < std::min<std::size_t>(header.planes.size(), 3); ++frame) {
    const std::string bytes = assets::frameBytesOf(opened.bytes, header, frame);
    const auto stored = bytes.empty() ? std::vector<std::uint16_t>() : assets::storedValues(header, bytes);
    if (stored.empty()) continue;
    std::vector<std::int16_t> grey(stored.size());
    assets::greyFromStored(stored, header.format, header.planes[frame].slope, header.planes[frame].intercept, grey);
  }
}

TEST(DicomMutants, HeadersAndPlainPixels) {
  const std::vector<std::string> good = {plainFile(), groupedFile(), deflatedFile(), runLengthFile()};
  for (const std::string& file : good) {
    const assets::OpenedDicom opened = assets::openDicom(assets::DicomBytes::ofMemory(file), "IM0001");
    ASSERT_EQ(opened.header.fault, assets::DicomFault::none);
    ASSERT_FALSE(assets::storedValues(opened.header, assets::frameBytesOf(opened.bytes, opened.header, 0)).empty());
  }
  mutants::forEachMutant(good, 1000,
                         [](const std::string& mutant, std::size_t, std::uint64_t) { expectSound(mutant); });
}

// Whole surveys and volumes: one file of a series damaged.
TEST(DicomMutants, OfASeries) {
  const on_disk::Folder folder;
  dicom_on_disk::Series series;
  for (int k = 1; k < series.slices; ++k)
    on_disk::write(folder.at("IM" + std::to_string(k)),
                   dicom_on_disk::bytesOf(dicom_on_disk::sliceOf(series, k, [](const glm::dvec3& p) { return p.x; })));
  const std::string good =
      dicom_on_disk::bytesOf(dicom_on_disk::sliceOf(series, 0, [](const glm::dvec3& p) { return p.x; }));
  constexpr std::uint64_t kSurveyCosts = 200;
  const auto judge = [&](const std::string& mutant, std::size_t, std::uint64_t) {
    on_disk::write(folder.at("IM0"), mutant);
    tests::refusalOf<assets::LoadError>([&] {
      const assets::DicomSurvey survey = assets::surveyDicom(folder.at(""), {});
      for (const assets::DicomVerdict& verdict : survey.verdicts)
        EXPECT_EQ(verdict.sentence.find('\n'), std::string::npos) << verdict.sentence;
      const auto grey = assets::readDicomVolume(survey);
      EXPECT_EQ(grey.size(), assets::countIn(survey.plan->geometry.size));
    });
  };
  mutants::forEachMutant({good}, 20, judge, kSurveyCosts);
}

// Damaged JPEG, JPEG-LS and JPEG 2000 streams break a child at most.
TEST(DicomMutants, OfCompressedPictures) {
  const std::filesystem::path root = tests::sharedData("dicom/synthetic");
  MOLAR_NEEDS(root);
  const on_disk::Folder folder;
  std::vector<std::string> good;
  for (const char* name : {"14_jpeg2000", "15_jpegls", "16_jpeg_lossless"})
    good.push_back(on_disk::read((root / name / "IM0000").string()));
  constexpr std::uint64_t kDecodingCosts = 100;
  const auto judge = [&](const std::string& mutant, std::size_t, std::uint64_t) {
    on_disk::write(folder.at("IM0"), mutant);
    const assets::DicomFolder one = assets::readDicomFolder(folder.at("IM0"), {});
    const assets::DicomHeader& header = one.files.at(0).header;
    if (header.fault != assets::DicomFault::none || header.planes.empty() || header.pixelCount() > 1'000'000) return;
    std::vector<std::int16_t> grey(header.pixelCount());
    assets::readFrames(one, {{0, 0}}, grey);
  };
  mutants::forEachMutant(good, 20, judge, kDecodingCosts);
}

}  // namespace
