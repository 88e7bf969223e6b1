#include "assets/patient/plain_volume.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assets/load_error.h"
#include "assets/tooth.h"
#include "tests/assets/scan_on_disk.h"
#include "tests/refusal.h"
#include "tests/scratch_folder.h"

namespace assets {
namespace {

using testing::HasSubstr;

CtVolume smallVolume(bool numbered = true) {
  CtVolume volume;
  volume.grid = {{7, 5, 3}, 0.25, {-3.25, 1.0 / 3.0, 40.0}};
  for (std::size_t v = 0; v < volume.grid.voxelCount(); ++v) {
    volume.hounsfield.push_back(static_cast<std::int16_t>(41 * static_cast<int>(v) - 1000));
    volume.label.push_back(static_cast<std::uint8_t>(v % kScanTissueCount));
    volume.solid.push_back(static_cast<std::uint8_t>(7 * v));
    if (numbered) volume.tooth.push_back(v % 2 == 0 ? 0 : 48);
  }
  return volume;
}

std::string refusalToRead(const std::string& path) {
  return tests::refusalOf<LoadError>([&] { readPlainVolume(path); });
}

TEST(PlainVolume, RoundTripsWithAndWithoutToothNumbers) {
  const tests::ScratchFolder folder;
  for (const bool numbered : {true, false}) {
    const CtVolume volume = smallVolume(numbered);
    writePlainVolume(volume, folder.file("v"));
    const CtVolume read = readPlainVolume(folder.file("v"));
    EXPECT_EQ(read.grid, volume.grid);
    EXPECT_EQ(read.hounsfield, volume.hounsfield);
    EXPECT_EQ(read.label, volume.label);
    EXPECT_EQ(read.solid, volume.solid);
    EXPECT_EQ(read.tooth, volume.tooth);
  }
}

TEST(PlainVolume, RefusesAnyChangedOrMissingByte) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("v");
  EXPECT_THAT(refusalToRead(path), HasSubstr("no such file"));
  writePlainVolume(smallVolume(), path);
  const std::string good = on_disk::read(path);
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    on_disk::write(path, bad);
    EXPECT_NE(refusalToRead(path), "accepted") << at;
    on_disk::write(path, good.substr(0, at));
    EXPECT_NE(refusalToRead(path), "accepted") << at;
  }
  on_disk::write(path, good + "x");
  EXPECT_NE(refusalToRead(path), "accepted");
}

/// With a checksum that fits, so that the values themselves are judged.
TEST(PlainVolume, RefusesValuesOutOfRange) {
  const tests::ScratchFolder folder;
  const std::string path = folder.file("v");
  const auto refusal = [&](const auto& change) {
    CtVolume volume = smallVolume();
    change(volume);
    writePlainVolume(volume, path);
    return refusalToRead(path);
  };
  EXPECT_EQ(refusal([](CtVolume&) {}), "accepted");
  EXPECT_THAT(refusal([](CtVolume& v) { v.label[5] = kScanTissueCount; }), HasSubstr("out of range"));
  EXPECT_THAT(refusal([](CtVolume& v) { v.tooth[5] = 49; }), HasSubstr("out of range"));
  EXPECT_THAT(refusal([](CtVolume& v) { v.grid.size.x = 0; }), HasSubstr("out of range"));

  EXPECT_THAT(refusal([](CtVolume& v) { v.grid.spacing_mm = std::nan(""); }), HasSubstr("out of range"));
  EXPECT_THAT(refusal([](CtVolume& v) { v.grid.origin_P_mm.y = 1e30; }), HasSubstr("out of range"));
}

}  // namespace
}  // namespace assets
