#include "render/volume/volume_fields.h"

#include <gtest/gtest.h>

#include <array>

#include "render/gpu/gpu_error.h"
#include "render/volume/appearance_field.h"
#include "render/volume/tissue_appearance.h"
#include "tests/render/ball_volume.h"

namespace render {
namespace {

using testing::Random;

template <class T>
bool equal(const BorderedField<T>& a, const BorderedField<T>& b) {
  return a.layout().size == b.layout().size && std::equal(a.data(), a.data() + a.layout().count(), b.data());
}

std::array<std::uint8_t, 512> bricksOwn(const assets::CtVolume& ct, glm::ivec3 brick) {
  std::array<std::uint8_t, 512> values{};
  std::ranges::copy(testing::brickOf(ct, brick), values.begin());
  return values;
}

glm::vec4 unpacked(std::uint32_t appearance) {
  const auto byte = [appearance](int n) { return static_cast<float>(appearance >> (8 * n) & 255u) / 255.0f; };
  return {byte(0) * byte(0), byte(1) * byte(1), byte(2) * byte(2), byte(3)};
}

TEST(VolumeFields, CarvedBrickByBrickEqualTheFieldsOfWhatIsLeft) {
  Random random(71);
  for (int n = 0; n < 8; ++n) {
    const assets::VolumeGrid grid = testing::smallGrid({37, 43, 50});
    const assets::CtVolume before = testing::ballVolume(grid, {{{0, 0, 0}, 8.0}});
    assets::CtVolume after = before;
    VolumeFields fields(grid, before.solid, before.label);
    for (int stroke = 0; stroke < 5; ++stroke) {
      const glm::dvec3 at = random.inCube(7.0);
      const assets::CtVolume gone = testing::ballVolume(grid, {{at, random.between(0.6, 3.0)}});
      for (std::size_t v = 0; v < after.solid.size(); ++v)
        after.solid[v] = std::min<std::uint8_t>(after.solid[v], static_cast<std::uint8_t>(255 - gone.solid[v]));
      for (int b = 0; b < 5 * 6 * 7; ++b) {
        const glm::ivec3 brick{b % 5, b / 5 % 6, b / 30};
        fields.updateBrick(brick, bricksOwn(after, brick));
      }
      if (stroke % 2 == 0) fields.prepare();
    }
    fields.prepare();
    fields.prepare();
    const VolumeFields fresh(grid, after.solid, after.label);
    EXPECT_TRUE(equal(fields.solid(), fresh.solid()));
    EXPECT_TRUE(equal(fields.smooth(), fresh.smooth()));
    EXPECT_TRUE(equal(fields.ambient(), fresh.ambient()));
    EXPECT_FALSE(std::ranges::equal(after.solid, before.solid));
  }
}

TEST(VolumeFields, ReportExactlyTheBoxesTheyWrote) {
  Random random(72);
  const assets::VolumeGrid grid = testing::smallGrid({40, 33, 48});
  assets::CtVolume ct = testing::ballVolume(grid, {{{0, 0, 0}, 9.0}});
  VolumeFields fields(grid, ct.solid, ct.label);
  BorderedField<std::uint16_t> smooth = fields.smooth(), ambient = fields.ambient();
  BorderedField<std::uint8_t> solid = fields.solid();
  const auto follow = [](const auto& from, const std::vector<VoxelBox>& boxes, auto& to) {
    for (const VoxelBox& box : boxes)
      for (int k = 0; k < box.extent.z; ++k)
        for (int j = 0; j < box.extent.y; ++j)
          std::copy_n(from.at(box.first + glm::ivec3(0, j, k)), box.extent.x, to.at(box.first + glm::ivec3(0, j, k)));
  };
  for (int frame = 0; frame < 20; ++frame) {
    for (int touched = 0; touched < 2; ++touched) {
      const glm::ivec3 voxel = glm::ivec3(random.between(0, 39), random.between(0, 32), random.between(0, 47));
      ct.solid[ct.grid.index(voxel)] = static_cast<std::uint8_t>(random.between(0, 255));
      fields.updateBrick(voxel / 8, bricksOwn(ct, voxel / 8));
    }
    const FieldChanges& changes = fields.prepare();
    follow(fields.solid(), changes.solid, solid);
    follow(fields.smooth(), changes.smooth, smooth);
    follow(fields.ambient(), changes.ambient, ambient);
    ASSERT_TRUE(equal(solid, fields.solid()));
    ASSERT_TRUE(equal(smooth, fields.smooth()));
    ASSERT_TRUE(equal(ambient, fields.ambient()));
  }
}

TEST(VolumeFields, ReportNoChangeWhenNothingChanged) {
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(), {{{0, 0, 0}, 6.0}});
  VolumeFields fields(ct.grid, ct.solid, ct.label);
  fields.updateBrick({3, 3, 3}, bricksOwn(ct, {3, 3, 3}));
  const FieldChanges& changes = fields.prepare();
  EXPECT_TRUE(changes.solid.empty() && changes.smooth.empty() && changes.ambient.empty());
}

TEST(VolumeFields, RefuseValuesThatAreNotOnePerVoxel) {
  const assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(8)), {});
  EXPECT_THROW(VolumeFields(ct.grid, std::span(ct.solid).first(10), ct.label), GpuError);
  EXPECT_THROW(VolumeFields(ct.grid, ct.solid, std::span(ct.label).first(10)), GpuError);
  EXPECT_NO_THROW(VolumeFields(ct.grid, ct.solid, {}));
}

TEST(VolumeFields, APlacedPieceAddsItsMatterToTheShadeAndTakesItAwayAgain) {
  // By a whole number of cells: the piece's own means, moved.
  const assets::VolumeGrid grid = testing::smallGrid(glm::ivec3(48));
  const assets::CtVolume jaw = testing::ballVolume(grid, {{{0, 0, -9}, 6.0}}),
                         tooth = testing::ballVolume(testing::smallGrid(glm::ivec3(24)), {{{0, 0, 0}, 4.0}});
  VolumeFields fields(grid, jaw.solid, jaw.label);
  const VolumeFields piece(tooth.grid, tooth.solid, {}), alone(grid, jaw.solid, jaw.label);
  const glm::ivec3 cells(2, -1, 3);
  const double cell_mm = 2.0 * grid.spacing_mm;
  const PlacedFields placed{&piece, {{1, 0, 0, 0}, cell_mm * glm::dvec3(cells)}};
  const glm::ivec3 first = (grid.size - tooth.grid.size) / 4 + cells;
  const auto expect_shaded = [&](const char* what) {
    double worst = 0.0;
    forEachIn({glm::ivec3(0), fields.ambient().layout().size}, [&](glm::ivec3 cell) {
      const glm::ivec3 own = cell - first;
      const bool inside = glm::all(glm::greaterThanEqual(own, glm::ivec3(0))) &&
                          glm::all(glm::lessThan(own, piece.ambient().layout().size));
      const int sum = *alone.ambient().at(cell) + (inside ? *piece.ambient().at(own) : 0);
      worst = std::max(worst, std::abs(static_cast<double>(*fields.ambient().at(cell) - std::min(65535, sum))));
    });
    EXPECT_LE(worst, 1.0) << what;
  };
  fields.place({&placed, 1}, false);
  EXPECT_FALSE(fields.prepare().ambient.empty());
  expect_shaded("placed");
  EXPECT_FALSE(equal(fields.ambient(), alone.ambient()));
  fields.place({&placed, 1}, false);
  EXPECT_TRUE(fields.prepare().ambient.empty()) << "nothing is done for a piece that does not move";

  // Turned, it holds as much matter; bone that is carved beneath it keeps its shade.
  const PlacedFields turned{&piece, {glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))), {0, 1, 5}}};
  fields.place({&turned, 1}, false);
  fields.prepare();
  double matter = 0.0, expected = 0.0;
  forEachIn({glm::ivec3(0), fields.ambient().layout().size},
            [&](glm::ivec3 cell) { matter += *fields.ambient().at(cell) - *alone.ambient().at(cell); });
  forEachIn({glm::ivec3(0), piece.ambient().layout().size},
            [&](glm::ivec3 cell) { expected += *piece.ambient().at(cell); });
  EXPECT_NEAR(matter / expected, 1.0, 0.02);
  fields.place({&placed, 1}, false);
  fields.updateBrick({2, 2, 2}, std::array<std::uint8_t, 512>{});
  fields.updateBrick({2, 2, 2}, bricksOwn(jaw, {2, 2, 2}));
  fields.prepare();
  expect_shaded("carved and back");

  fields.place({}, false);
  fields.prepare();
  EXPECT_TRUE(equal(fields.ambient(), alone.ambient()));
}

TEST(VolumeFields, OfAFillingHaveItsTissueUntilItIsGone) {
  const assets::VolumeGrid grid = testing::smallGrid({37, 43, 50});
  const assets::CtVolume before = testing::ballVolume(grid, {{{0, 0, 0}, 8.0}});
  assets::CtVolume filled = before;
  const assets::CtVolume laid = testing::ballVolume(grid, {{{1.0, -2.0, 3.0}, 2.5}});
  constexpr auto kComposite = static_cast<std::uint8_t>(assets::Tissue::composite);
  for (std::size_t v = 0; v < laid.solid.size(); ++v)
    if (laid.solid[v] > 127) filled.label[v] = kComposite;
  VolumeFields fields(grid, before.solid, before.label);
  const auto tell = [&](bool is_there) {
    for (int b = 0; b < 5 * 6 * 7; ++b) {
      const glm::ivec3 brick{b % 5, b / 5 % 6, b / 30};
      std::array<std::uint8_t, 512> tissue = bricksOwn(laid, brick);
      for (std::uint8_t& one : tissue) one = is_there && one > 127 ? kComposite : std::uint8_t{0};
      fields.updateTissue(brick, tissue);
    }
    return fields.prepare();
  };
  EXPECT_FALSE(tell(true).tissue.empty());
  const VolumeFields fresh(grid, filled.solid, filled.label);
  EXPECT_TRUE(equal(fields.label(), fresh.label()));
  EXPECT_TRUE(equal(fields.appearance(), fresh.appearance()));
  EXPECT_TRUE(tell(true).tissue.empty()) << "nothing is new";
  EXPECT_FALSE(tell(false).tissue.empty());
  const VolumeFields again(grid, before.solid, before.label);
  EXPECT_TRUE(equal(fields.label(), again.label()));
  EXPECT_TRUE(equal(fields.appearance(), again.appearance()));
  EXPECT_FALSE(equal(fresh.appearance(), again.appearance()));
}

TEST(AppearanceField, IsThatOfTheTissueDeepInside) {
  assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(20)), {});
  std::ranges::fill(ct.solid, std::uint8_t{255});
  std::ranges::fill(ct.label, static_cast<std::uint8_t>(assets::Tissue::enamel));
  const glm::vec4 appearance = unpacked(*appearanceField(testing::borderedSolid(ct), ct.label).at({9, 10, 11}));
  const TissueAppearance& enamel = kTissueAppearance[static_cast<std::size_t>(assets::Tissue::enamel)];
  EXPECT_NEAR(glm::distance(glm::vec3(appearance), enamel.albedo), 0.0, 0.006) << "8 bits of a root";
  EXPECT_EQ(appearance.a, 1.0f);
}

TEST(AppearanceField, BlendsEquallyAtABoundaryAndIgnoresAirNextToASurface) {
  assets::CtVolume ct = testing::ballVolume(testing::smallGrid(glm::ivec3(24)), {});
  for (int n = 0; n < static_cast<int>(ct.solid.size()); ++n) {
    const int i = n % 24, k = n / (24 * 24);
    ct.solid[static_cast<std::size_t>(n)] = k < 12 ? 255 : 0;
    ct.label[static_cast<std::size_t>(n)] = static_cast<std::uint8_t>(k >= 12  ? assets::Tissue::unlabelled
                                                                      : i < 12 ? assets::Tissue::enamel
                                                                               : assets::Tissue::dentine);
  }
  const BorderedField<std::uint32_t> field = appearanceField(testing::borderedSolid(ct), ct.label);
  const auto finishAt = [&](glm::ivec3 v) { return unpacked(*field.at(v)).a; };
  EXPECT_NEAR(finishAt({11, 12, 5}), kEnamel + (kDull - kEnamel) / 8.0f, 0.004);
  EXPECT_NEAR(finishAt({12, 12, 5}), kDull + (kEnamel - kDull) / 8.0f, 0.004);
  EXPECT_NEAR(finishAt({5, 12, 11}), kEnamel, 0.004);
  EXPECT_NEAR(finishAt({5, 12, 12}), kEnamel, 0.004) << "the air just above takes the colour of what it covers";
}

}  // namespace
}  // namespace render
