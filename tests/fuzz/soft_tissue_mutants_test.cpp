// A kept soft tissue field changed, with a new checksum, so that its own checks are what refuses it.
#include <gtest/gtest.h>

#include "assets/load_error.h"
#include "assets/patient/soft_tissue_file.h"
#include "assets/scan/file_checksum.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/mutants.h"
#include "tests/refusal.h"

namespace {

TEST(SoftTissueMutants, AForgedFieldIsReadWithinItsRangeOrRefused) {
  const on_disk::Folder folder;
  constexpr std::uint64_t kFingerprint = 7;
  constexpr std::size_t kSeal_bytes = 24;
  assets::SoftTissueField field;
  field.grid = {{24, 17, 20}, 1.5, {1, 2, 3}};
  for (std::size_t v = 0; v < field.grid.voxelCount(); ++v) {
    field.distance.push_back(static_cast<std::int16_t>(static_cast<int>(7 * v % 3584) - 1024));
    field.tissue.push_back(static_cast<std::uint8_t>(v / 5 % assets::kSoftTissueCount));
  }
  const std::string path = folder.at("soft");
  assets::writeSoftTissue(field, kFingerprint, path);
  const std::string sealed = on_disk::read(path);
  std::uint64_t tried = 0, refused = 0;
  mutants::forEachMutant({sealed.substr(0, sealed.size() - kSeal_bytes)}, 400,
                         [&](const std::string& mutant, std::size_t, std::uint64_t) {
                           on_disk::write(path, mutant);
                           assets::appendChecksum(path);
                           const std::string refusal = tests::refusalOf<assets::LoadError>([&] {
                             const auto read = assets::readSoftTissue(path, kFingerprint);
                             EXPECT_EQ(read.distance.size(), read.isEmpty() ? 0 : read.grid.voxelCount());
                             EXPECT_EQ(read.tissue.size(), read.distance.size());
                             for (const double at_mm : {-1e30, 0.0, 7.3, 1e30})
                               EXPECT_LE(read.at(glm::dvec3(at_mm)).distance_mm, assets::SoftTissueField::kOutside_mm);
                           });
                           ++tried;
                           refused += refusal == "accepted" ? 0 : 1;
                         });
  if (tried >= mutants::kEnoughToJudge) {
    EXPECT_GT(refused, tried / 2);
  }
}

}  // namespace
