// ITK's readers as reference: same voxels and geometry for valid files.
#include <gtest/gtest.h>
#include <itkImageIOBase.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <cstring>
#include <random>

#include "assets/scan/image_header.h"
#include "assets/scan/voxel_bytes.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/shared_data.h"

namespace {

using Values = std::vector<std::int16_t>;

on_disk::Scan turnedScan(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  on_disk::Scan scan;
  const glm::dvec3 angle(number(-3, 3), number(-3, 3), number(-3, 3));
  const glm::dvec3 c = glm::cos(angle), s = glm::sin(angle);
  const glm::dmat3 about_x(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x), about_y(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y),
      about_z(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
  scan.step = seed % 3 == 0 ? glm::dmat3(1.0) : about_x * about_y * about_z;
  if (seed % 4 == 1) scan.step[2] *= -1.0;
  for (int a = 0; a < 3; ++a) {
    scan.size[a] = static_cast<int>(2 + random() % 4);
    scan.step[a] *= number(0.2, 2.0);
    scan.origin[a] = number(-200, 200);
  }
  return scan;
}

Values noise(const on_disk::Scan& scan, std::uint32_t seed) {
  std::mt19937 random(seed);
  Values values(static_cast<std::size_t>(scan.size.x * scan.size.y * scan.size.z));
  for (auto& value : values) value = static_cast<std::int16_t>(random() % 4000 - 1000);
  return values;
}

void expectAsItk(const std::string& path, itk::ImageIOBase& itk_reader) {
  itk_reader.SetFileName(path);
  itk_reader.ReadImageInformation();
  const assets::ImageHeader header = assets::readImageHeader(path);
  itk::ImageIORegion whole(itk_reader.GetNumberOfDimensions());
  for (unsigned int a = 0; a < itk_reader.GetNumberOfDimensions(); ++a) whole.SetSize(a, itk_reader.GetDimensions(a));
  for (unsigned int a = 0; a < 3; ++a) {
    const int i = static_cast<int>(a);
    EXPECT_EQ(itk_reader.GetDimensions(a), static_cast<std::size_t>(header.geometry.size[i])) << path;
    EXPECT_NEAR(itk_reader.GetOrigin(a), header.geometry.origin_P_mm[i], 1e-4) << path;
    for (int p = 0; p < 3; ++p)
      EXPECT_NEAR(itk_reader.GetSpacing(a) * itk_reader.GetDirection(a).at(static_cast<std::size_t>(p)),
                  header.geometry.step_P_mm[i][p], 2e-5)
          << path << ' ' << a << p;
  }
  ASSERT_EQ(itk_reader.GetComponentSize(), assets::bytesOf(header.type));
  std::string theirs(itk_reader.GetImageSizeInBytes(), '\0'), ours;
  itk_reader.SetIORegion(whole);
  itk_reader.Read(theirs.data());
  assets::forEachVoxelBlock(header, [&](std::span<const char> bytes) { ours.append(bytes.begin(), bytes.end()); });
  EXPECT_EQ(ours, theirs) << path;
}

TEST(ItkTwin, ReadsTheSameVoxelsAndGeometry) {
  const on_disk::Folder folder;
  int nifti_compared = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const on_disk::Scan scan = turnedScan(seed);
    const std::string data = on_disk::bytesOf(noise(scan, seed));
    on_disk::write(folder.at("lps.nrrd"), on_disk::nrrd(scan, "short", data));
    on_disk::write(folder.at("ras.nrrd"), on_disk::nrrd(scan, "short", data, "RAS", {-1, -1, 1}));
    on_disk::write(folder.at("a.mha"), on_disk::meta(scan, "MET_SHORT", data));
    on_disk::write(folder.at("a.nii"), on_disk::nifti(scan, 4, 16, data));
    expectAsItk(folder.at("lps.nrrd"), *itk::NrrdImageIO::New());
    expectAsItk(folder.at("ras.nrrd"), *itk::NrrdImageIO::New());
    expectAsItk(folder.at("a.mha"), *itk::MetaImageIO::New());
    try {
      expectAsItk(folder.at("a.nii"), *itk::NiftiImageIO::New());
      ++nifti_compared;
    } catch (const itk::ExceptionObject&) {
      // ITK finds some sforms of single precision not square.
    }
  }
  EXPECT_GE(nifti_compared, 20);
}

TEST(ItkTwin, ReadsTheSameQform) {
  const on_disk::Folder folder;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> part(-0.55F, 0.55F);
  for (int n = 0; n < 40; ++n) {
    const on_disk::Scan scan{{3, 4, 5}, glm::dmat3(0.7), {0, 0, 0}};
    std::string file = on_disk::nifti(scan, 4, 16, on_disk::bytesOf(noise(scan, 1)), 0);
    file[252] = 1;
    const auto put = [&](std::size_t at, float value) { std::memcpy(file.data() + at, &value, sizeof value); };
    put(76, n % 3 == 0 ? -1.0F : n % 3 == 1 ? 0.0F : 1.0F);
    for (std::size_t q = 0; q < 3; ++q) put(256 + 4 * q, part(random));
    for (std::size_t q = 0; q < 3; ++q) put(268 + 4 * q, 100.0F * part(random));
    on_disk::write(folder.at("q.nii"), file);
    expectAsItk(folder.at("q.nii"), *itk::NiftiImageIO::New());
  }
}

TEST(ItkTwin, HasTheDefaultsOfItk) {
  const on_disk::Folder folder;
  const on_disk::Scan scan{{3, 4, 5}, glm::dmat3(0.7), {0, 0, 0}};
  const std::string data = on_disk::bytesOf(noise(scan, 1));
  on_disk::write(folder.at("bare.mha"),
                 "NDims = 3\nDimSize = 3 4 5\nElementSpacing = 0.7 0.8 0.9\nElementType = "
                 "MET_SHORT\nElementDataFile = LOCAL\n" +
                     data);
  expectAsItk(folder.at("bare.mha"), *itk::MetaImageIO::New());
  const std::string head = "NRRD0001\ntype: short\ndimension: 3\nsizes: 3 4 5\nspacings: 0.7 0.8 0.9\n";
  const std::string end = "endian: little\nencoding: raw\n\n" + data;
  on_disk::write(folder.at("bare.nrrd"), head + end);
  expectAsItk(folder.at("bare.nrrd"), *itk::NrrdImageIO::New());
  on_disk::write(folder.at("cell.nrrd"), head + "axis mins: 10 20 30\ncenters: cell cell cell\n" + end);
  expectAsItk(folder.at("cell.nrrd"), *itk::NrrdImageIO::New());
  on_disk::write(folder.at("node.nrrd"), head + "axis mins: 10 20 30\ncenters: node node node\n" + end);
  expectAsItk(folder.at("node.nrrd"), *itk::NrrdImageIO::New());
}

TEST(ItkTwinRealData, ReadsTheSameJaws) {
  const auto folder = tests::sharedData("patients");
  MOLAR_NEEDS(folder);
  expectAsItk((folder / "right_third_molar/ct.nrrd").string(), *itk::NrrdImageIO::New());
  expectAsItk((folder / "right_third_molar/labels.nrrd").string(), *itk::NrrdImageIO::New());
  expectAsItk((folder / "cbct_segmentation/PostDentalSurgery_Segmentation.nii.gz").string(), *itk::NiftiImageIO::New());
  expectAsItk((folder / "mandible_mask/patient_MAND_Seg_Or.nii.gz").string(), *itk::NiftiImageIO::New());
}

}  // namespace
