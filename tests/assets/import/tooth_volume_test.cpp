// One tooth as a volume of densities: what is judged, what it becomes, what is refused.
#include <gmock/gmock.h>

#include <numbers>

#include "assets/import/tooth_volume.h"
#include "assets/load_error.h"
#include "assets/tooth.h"
#include "tests/assets/density_tooth.h"
#include "tests/refusal.h"

namespace assets {
namespace {

using density_tooth::Form;
using density_tooth::usualScan;
using on_disk::Scan;
using testing::HasSubstr;

VolumeGrid gridOf(const Scan& scan) { return {scan.size, scan.step[0].x, scan.origin}; }

ToothVolume made(const Scan& scan, const Form& form = {}, int parts = 3, const ToothVolumeOptions& options = {}) {
  return toothVolume(gridOf(scan), density_tooth::densities(scan, form, parts), options, "tooth.nrrd");
}

double volume_mm3(const CtVolume& ct, Tissue tissue) {
  double sum = 0.0;
  for (std::size_t v = 0; v < ct.label.size(); ++v)
    if (Tissue{ct.label[v]} == tissue) sum += tissue == Tissue::pulp ? 1.0 : ct.solid[v] / 255.0;
  return sum * ct.grid.voxelVolume_mm3();
}

/// What lies beyond the last voxels of a tissue included.
double solid_mm3(const CtVolume& ct) {
  double sum = 0.0;
  for (const std::uint8_t solid : ct.solid) sum += solid / 255.0;
  return sum * ct.grid.voxelVolume_mm3();
}

/// By points, fine.
double trueVolume_mm3(int density, const Form& form = {}) {
  constexpr double kStep_mm = 0.1;
  double sum = 0.0;
  for (double z = -13.0; z < 7.0; z += kStep_mm)
    for (double y = -6.0; y < 6.0; y += kStep_mm)
      for (double x = -6.0; x < 6.0; x += kStep_mm)
        sum += density_tooth::densityAt({x, y, z}, form) == density ? kStep_mm * kStep_mm * kStep_mm : 0.0;
  return sum;
}

TEST(ToothVolume, KeepsTheVolumesOfItsTissues) {
  for (const int parts : {1, 3}) {
    const ToothVolume tooth = made(usualScan(0.15), {}, parts);
    EXPECT_NEAR(solid_mm3(tooth.ct) / (trueVolume_mm3(150) + trueVolume_mm3(255)), 1.0, 0.02) << parts;
    EXPECT_NEAR(volume_mm3(tooth.ct, Tissue::enamel) / trueVolume_mm3(255), 1.0, 0.12) << parts;
    EXPECT_NEAR(volume_mm3(tooth.ct, Tissue::pulp) / trueVolume_mm3(100), 1.0, 0.15) << parts;
    EXPECT_TRUE(tooth.has_pulp);
    for (std::size_t v = 0; v < tooth.ct.label.size(); ++v)
      ASSERT_EQ(tooth.ct.tooth[v], isToothPart(tooth.ct.label[v]) ? 46 : 0);
    EXPECT_THAT(tooth.remarks.at(0), HasSubstr("air 0, pulp 100, dentine 150, enamel 255"));
  }
}

TEST(ToothVolume, APartialVoxelAtTheOutsideIsNoPulp) {
  // Two thirds of dentine look like pulp, three fifths of enamel like dentine.
  const ToothVolume tooth = made(usualScan(), {.has_pulp = false});
  EXPECT_EQ(volume_mm3(tooth.ct, Tissue::pulp), 0.0);
  EXPECT_FALSE(tooth.has_pulp);
  EXPECT_THAT(tooth.remarks.back(), HasSubstr("no pulp"));
}

TEST(ToothVolume, IsReadAtEveryPublishedSize) {
  for (const glm::ivec3 size : {glm::ivec3(109, 84, 97), glm::ivec3(103, 94, 161), glm::ivec3(128, 128, 256)}) {
    const double spacing_mm =
        19.5 / size.z < 11.0 / 84 ? std::max(19.5 / size.z, 11.0 / std::min(size.x, size.y)) : 0.21;
    const ToothVolume tooth = made(density_tooth::scanOf(size, spacing_mm), {}, 1);
    EXPECT_NEAR(volume_mm3(tooth.ct, Tissue::dentine) / trueVolume_mm3(150), 1.0, 0.05) << size.x;
  }
}

TEST(ToothVolume, OtherLevelsAreTakenWhenTheyAreGiven) {
  const Scan scan = usualScan();
  std::vector<std::uint8_t> values = density_tooth::densities(scan, {}, 1);
  for (std::uint8_t& value : values) value = value == 255 ? 200 : value == 150 ? 120 : value == 100 ? 60 : 10;
  const auto read = [&](const ToothVolumeOptions& options) {
    return toothVolume(gridOf(scan), values, options, "tooth.nrrd");
  };
  EXPECT_THAT(tests::refusalOf<LoadError>([&] { read({}); }), HasSubstr("--levels"));
  EXPECT_NEAR(volume_mm3(read({.levels = {10, 60, 120, 200}}).ct, Tissue::enamel),
              volume_mm3(made(scan, {}, 1).ct, Tissue::enamel), 1e-9);
}

/// The volume with its axes exchanged and turned: +1, +2, +3 are x, y, z of the tooth along the new axis.
std::pair<Scan, std::vector<std::uint8_t>> seenAlong(const Scan& scan, const std::vector<std::uint8_t>& values,
                                                     std::array<int, 3> way) {
  Scan turned = scan;
  for (int a = 0; a < 3; ++a) turned.size[a] = scan.size[std::abs(way[static_cast<std::size_t>(a)]) - 1];
  std::vector<std::uint8_t> out(values.size());
  forVoxels(glm::ivec3(0), turned.size, [&](glm::ivec3 ijk) {
    glm::ivec3 from(0);
    for (int a = 0; a < 3; ++a) {
      const int axis = std::abs(way[static_cast<std::size_t>(a)]) - 1;
      from[axis] = way[static_cast<std::size_t>(a)] > 0 ? ijk[a] : turned.size[a] - 1 - ijk[a];
    }
    out[indexIn(turned.size, ijk)] = values[indexIn(scan.size, from)];
  });
  return {turned, out};
}

TEST(ToothVolume, ALyingOrReversedToothIsRefusedOrTurnedAsItWas) {
  const Scan scan = usualScan();
  const std::vector<std::uint8_t> upright = density_tooth::densities(scan, {}, 3);
  const ToothVolume wanted = toothVolume(gridOf(scan), upright, {}, "tooth.nrrd");
  for (const std::array<int, 3> way : {std::array{1, -2, -3}, {3, 2, -1}, {-3, 2, 1}, {1, 3, -2}, {1, -3, 2}}) {
    const auto [turned, values] = seenAlong(scan, upright, way);
    const auto read = [&, &turned = turned, &values = values](bool turns) {
      return toothVolume(gridOf(turned), values, {.turns_upright = turns}, "tooth.nrrd");
    };
    EXPECT_THAT(tests::refusalOf<LoadError>([&] { read(false); }),
                HasSubstr(way[2] == -3 ? "stands upside down" : "lies on its side"));
    const ToothVolume tooth = read(true);
    EXPECT_EQ(tooth.ct.grid.size, wanted.ct.grid.size);
    EXPECT_TRUE(tooth.ct.label == wanted.ct.label) << way[0] << way[1] << way[2];
    EXPECT_TRUE(tooth.ct.solid == wanted.ct.solid);
    EXPECT_THAT(tooth.remarks.at(1), HasSubstr("was turned"));
  }
  // An upper tooth stands the other way.
  EXPECT_THAT(tests::refusalOf<LoadError>([&] { toothVolume(gridOf(scan), upright, {.fdi = 16}, "tooth.nrrd"); }),
              HasSubstr("an upper tooth's points down"));
}

TEST(ToothVolume, RefusesWhatIsNoToothInOneLine) {
  const Scan scan = usualScan();
  const auto refusal = [&](const auto& change, const Scan& of) {
    std::vector<std::uint8_t> values = density_tooth::densities(of, {}, 1);
    for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(change(value));
    return tests::refusalOf<LoadError>([&] { toothVolume(gridOf(of), values, {}, "tooth.nrrd"); });
  };
  EXPECT_THAT(refusal([](int) { return 150; }, scan), HasSubstr("every voxel is 150"));
  EXPECT_THAT(refusal([](int v) { return v / 2; }, scan), HasSubstr("no density levels"));
  EXPECT_THAT(refusal([](int v) { return v == 255 ? 150 : v; }, scan), HasSubstr("hardly any of it is enamel"));
  EXPECT_THAT(refusal([](int v) { return v == 0 ? 100 : v; }, scan), HasSubstr("no voxel is air"));
  Scan small = scan, coarse = scan;
  small.step = glm::dmat3(0.03), coarse.step = glm::dmat3(1.0);
  const auto as_large = [&](const Scan& of) {
    return tests::refusalOf<LoadError>(
        [&] { toothVolume(gridOf(of), density_tooth::densities(scan, {}, 1), {}, "tooth.nrrd"); });
  };
  EXPECT_THAT(as_large(small), HasSubstr("it would be a tooth of"));
  EXPECT_THAT(as_large(coarse), HasSubstr("check the spacing"));
  // Two of them.
  Scan wide = scan;
  wide.size.x *= 2;
  const std::vector<std::uint8_t> one = density_tooth::densities(scan, {}, 1);
  std::vector<std::uint8_t> two(countIn(wide.size));
  forVoxels(glm::ivec3(0), wide.size, [&](glm::ivec3 ijk) {
    two[indexIn(wide.size, ijk)] = one[indexIn(scan.size, {ijk.x % scan.size.x, ijk.y, ijk.z})];
  });
  EXPECT_THAT(tests::refusalOf<LoadError>([&] { toothVolume(gridOf(wide), two, {}, "tooth.nrrd"); }),
              HasSubstr("several pieces"));
}

TEST(ToothVolume, RefusesFilesInOneLine) {
  const on_disk::Folder folder;
  const Scan scan = usualScan();
  const auto refusal = [&](const std::string& bytes) {
    on_disk::write(folder.at("tooth.nrrd"), bytes);
    return tests::refusalOf<LoadError>([&] { readToothVolume(folder.at("tooth.nrrd"), {}); });
  };
  const std::string good = density_tooth::nrrd(scan);
  EXPECT_EQ(refusal(good), "accepted");
  const std::vector<std::int16_t> shorts(countIn(scan.size), 150);
  EXPECT_THAT(refusal(on_disk::nrrd(scan, "short", on_disk::bytesOf(shorts))), HasSubstr("not plain bytes"));
  EXPECT_THAT(refusal(on_disk::nrrd({{4, 4, 4}, glm::dmat3(0.2), {}}, "uchar", std::string(64, 'x'))),
              HasSubstr("a tooth needs 16"));
  const std::size_t at = good.find("space directions"), end = good.find('\n', at);
  EXPECT_THAT(refusal(std::string(good).erase(at, end + 1 - at)), HasSubstr("spac"));
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)), "accepted");
}

}  // namespace
}  // namespace assets
