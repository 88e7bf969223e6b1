#include "assets/import/dicom/dicom_volume.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "assets/import/dicom/stored_frame.h"
#include "assets/scan/resampling.h"
#include "tests/assets/import/dicom/dicom_on_disk.h"
#include "tests/assets/scan_on_disk.h"

namespace {

using dicom_on_disk::Elements;
using dicom_on_disk::Series;

/// Balls of 2 mm with soft walls round known centres, different in size so that none is taken for another.
const std::array<glm::dvec3, 4> kCentres_P_mm = {{{0, 0, 0}, {9, 0, 2}, {0, 8, -3}, {-4, 3, 9}}};

double balls(const glm::dvec3& p_P_mm) {
  double grey = -1000.0;
  for (std::size_t n = 0; n < kCentres_P_mm.size(); ++n) {
    const double radius_mm = 2.0 + 0.2 * static_cast<double>(n);
    const double depth_mm = radius_mm - glm::distance(p_P_mm, kCentres_P_mm[n]);
    grey = std::max(grey, -1000.0 + 2000.0 * std::clamp(depth_mm + 0.5, 0.0, 1.0));
  }
  return grey;
}

/// Places of the balls in the volume that was read, by the centre of what is dense round each true place.
void expectBallsInPlace(const assets::VolumeGrid& grid, const std::vector<std::int16_t>& grey, double tolerance_mm) {
  for (const glm::dvec3& centre : kCentres_P_mm) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = grid.centre_P_mm(ijk);
      if (glm::distance(p, centre) > 3.8) return;
      const double weight = grey[v] + 1000.0;
      sum += weight * p, weights += weight;
    });
    ASSERT_GT(weights, 0.0);
    EXPECT_LT(glm::distance(sum / weights, centre), tolerance_mm)
        << "ball at " << centre.x << ' ' << centre.y << ' ' << centre.z;
  }
}

void write(const on_disk::Folder& folder, const Series& series) {
  for (int k = 0; k < series.slices; ++k)
    on_disk::write(folder.at("IM" + std::to_string((k * 31) % series.slices)),
                   dicom_on_disk::bytesOf(dicom_on_disk::sliceOf(series, k, balls)));
}

/// A series whose middle lies at the origin.
Series centred(Series series) {
  series.rows = series.columns = 64;
  series.slices = 64;
  const glm::dvec3 half =
      31.5 * (series.row_P * series.spacing_mm.y + series.column_P * series.spacing_mm.x + series.step_P_mm);
  series.origin_P_mm = -half;
  return series;
}

void expectBallsOf(const Series& series, double tolerance_mm) {
  const on_disk::Folder folder;
  write(folder, series);
  const assets::DicomSurvey survey = assets::surveyDicom(folder.at(""), {});
  ASSERT_EQ(survey.refusal(), nullptr) << survey.refusal()->sentence;
  const assets::Resampling resampling(survey.plan->geometry, "scan");
  expectBallsInPlace(resampling.grid(), resampling.linear(assets::readDicomVolume(survey), -1000), tolerance_mm);
}

/// All 24 ways to lay rows, columns and their normal along the body's axes.
std::vector<Series> orientations() {
  std::vector<Series> all;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      for (int signs = 0; signs < 4 && row != column; ++signs) {
        Series series;
        series.row_P = series.column_P = glm::dvec3(0.0);
        series.row_P[row] = (signs & 1) != 0 ? -1.0 : 1.0;
        series.column_P[column] = (signs & 2) != 0 ? -1.0 : 1.0;
        series.step_P_mm = 0.5 * glm::cross(series.row_P, series.column_P);
        all.push_back(series);
      }
  return all;
}

// With slices in both orders.
TEST(DicomVolume, BallsLieWhereTheyAreInEveryOrientation) {
  ASSERT_EQ(orientations().size(), 24U);
  for (Series series : orientations()) {
    expectBallsOf(centred(series), 0.02);
    series.step_P_mm = -series.step_P_mm;
    expectBallsOf(centred(series), 0.02);
  }
}

// In every orientation: a leaning gantry, a head that lies askew, pixels that are no squares, to a tenth of a voxel.
TEST(DicomVolume, TiltObliqueAndNonSquareScansAreStraightened) {
  for (const Series& straight : orientations()) {
    const glm::dvec3 row = straight.row_P, column = straight.column_P, normal = glm::cross(row, column);
    for (const double tilt_deg : {5.0, 15.0, -18.5}) {
      const double a = tilt_deg * std::numbers::pi / 180.0;
      Series series = straight;
      series.column_P = std::cos(a) * column + std::sin(a) * normal;  // the planes lean, the table moves straight
      expectBallsOf(centred(series), 0.05);
    }
    const double a = 7.0 * std::numbers::pi / 180.0;
    Series oblique = straight;
    oblique.row_P = std::cos(a) * row + std::sin(a) * column;
    oblique.column_P = std::cos(a) * column - std::sin(a) * row;
    expectBallsOf(centred(oblique), 0.05);
    Series oblong = straight;
    oblong.spacing_mm = {0.7, 0.45};
    expectBallsOf(centred(oblong), 0.045);
  }
}

// PixelSpacing is between rows, then between columns.
TEST(DicomVolume, SpacingIsRowsThenColumns) {
  const on_disk::Folder folder;
  Series series;
  series.spacing_mm = {0.7, 0.45};
  write(folder, series);
  const assets::DicomSurvey survey = assets::surveyDicom(folder.at(""), {});
  EXPECT_NEAR(glm::length(survey.plan->geometry.step_P_mm[0]), 0.45, 1e-12);
  EXPECT_NEAR(glm::length(survey.plan->geometry.step_P_mm[1]), 0.7, 1e-12);
}

std::vector<std::int16_t> greyOf(const assets::DicomPixelFormat& format, double slope, double intercept,
                                 const std::vector<std::uint16_t>& stored) {
  std::vector<std::int16_t> grey(stored.size());
  assets::greyFromStored(stored, format, slope, intercept, grey);
  return grey;
}

TEST(StoredFrame, GreyValuesAreExact) {
  using Greys = std::vector<std::int16_t>;
  assets::DicomPixelFormat format{16, 16, 15, false, false, {}, {}};
  EXPECT_EQ(greyOf(format, 1, -1024, {0, 1024, 4095}), (Greys{-1024, 0, 3071}));
  EXPECT_EQ(greyOf(format, 0.5, -1024, {3, 65535}), (Greys{-1022, 31744}));
  EXPECT_EQ(greyOf(format, 1, 0, {65535}), (Greys{32767}));
  format.is_signed = true;
  EXPECT_EQ(greyOf(format, 1, 0, {0xfc00, 7}), (Greys{-1024, 7}));
  // Twelve bits in sixteen, with rubbish above.
  format.bits_stored = 12, format.high_bit = 11;
  EXPECT_EQ(greyOf(format, 1, 0, {0xf7ff, 0x3800, 0x0001}), (Greys{2047, -2048, 1}));
  format.is_signed = false;
  EXPECT_EQ(greyOf(format, 1, -1024, {0xf400}), (Greys{0}));
  // In the upper bits.
  format.high_bit = 15;
  EXPECT_EQ(greyOf(format, 1, 0, {0x1230}), (Greys{0x123}));
  format = {16, 12, 11, false, true, {}, {}};
  EXPECT_EQ(greyOf(format, 1, -1000, {0, 4095}), (Greys{3095, -1000}));
  format = {16, 16, 15, true, false, 0xf830, {}};
  EXPECT_EQ(greyOf(format, 1, -1024, {0xf830, 0xf831}), (Greys{assets::kNoGrey, -3023}));
  format.padding_limit = 0xf840;
  EXPECT_EQ(greyOf(format, 1, 0, {0xf838, 0xf841}), (Greys{assets::kNoGrey, -1983}));
  // A padding value that 12 bits cannot hold is no pixel's.
  format = {16, 12, 11, false, false, 0xf830, {}};
  EXPECT_EQ(greyOf(format, 1, 0, {0x0830, 0x0831}), (Greys{0x0830, 0x0831}));
  format.padding = 0x0830;
  EXPECT_EQ(greyOf(format, 1, 0, {0x0830, 0x0831}), (Greys{assets::kNoGrey, 0x0831}));
}

TEST(DicomVolume, EverySliceHasItsOwnScale) {
  const on_disk::Folder folder;
  const Series series;
  for (int k = 0; k < series.slices; ++k) {
    Elements file = dicom_on_disk::sliceOf(series, k, [](const glm::dvec3&) { return 100.0; });
    file[0x00281053] = dicom_on_disk::decimals({1.0 + k});
    file[0x00281052] = dicom_on_disk::decimals({-5.0 * k});
    on_disk::write(folder.at("IM" + std::to_string(k)), dicom_on_disk::bytesOf(file));
  }
  const auto grey = assets::readDicomVolume(assets::surveyDicom(folder.at(""), {}));
  for (int k = 0; k < series.slices; ++k) ASSERT_EQ(grey[static_cast<std::size_t>(k) * 64 * 72], 100 + 95 * k) << k;
}

}  // namespace
