// Blocks for practising tooth preparation, against their closed form.
#include "assets/synthetic/preparation_block.h"

#include <gtest/gtest.h>

#include <numbers>

#include "assets/tissue.h"

namespace assets {
namespace {

TEST(PreparationBlock, IsFoundByItsKey) {
  for (const PreparationBlock& block : kPreparationBlocks) EXPECT_EQ(preparationBlockOf(block.key), &block);
  EXPECT_EQ(preparationBlockOf("block-plate"), nullptr);
  EXPECT_EQ(preparationBlockOf(""), nullptr);
}

TEST(PreparationBlock, HasTheVolumeAndTissuesOfItsForm) {
  const Patient patient = preparationBlock(kPreparationBlocks[0], 0.16);
  ASSERT_TRUE(patient.prepared);
  EXPECT_EQ(patient.prepared->ideal, "class-1");
  const ToothFrame& frame = patient.prepared->frame;
  EXPECT_LT(glm::length(frame.inP({0.0, 0.0, kBlockCrown_mm})), 1e-9) << "its face is at the origin";
  double crown_mm3 = 0.0, enamel_mm3 = 0.0;
  const VolumeGrid& grid = patient.ct.grid;
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (frame.local(grid.centre_P_mm(ijk)).z < 0.0) return;
    const double mm3 = patient.ct.solid[v] / 255.0 * grid.voxelVolume_mm3();
    crown_mm3 += mm3;
    if (Tissue{patient.ct.label[v]} == Tissue::enamel) enamel_mm3 += mm3;
    // Nothing is so far from the whole that a bur would find another tissue there.
    ASSERT_TRUE(patient.ct.solid[v] == 0 || Tissue{patient.ct.label[v]} != Tissue::unlabelled);
  });
  // A square of 10 by 9 with corners of 2 mm, 7 mm high, less its round edge: (1 - pi/4) 0.5² along 34.6 mm.
  const double face_mm2 = 90.0 - (4.0 - std::numbers::pi) * 4.0;
  EXPECT_NEAR(crown_mm3, 7.0 * face_mm2 - 1.85, 4.0);
  const double core_mm2 = 42.0 - (4.0 - std::numbers::pi) * 0.25;
  EXPECT_NEAR(enamel_mm3, crown_mm3 - 5.5 * core_mm2, 6.0);
}

}  // namespace
}  // namespace assets
