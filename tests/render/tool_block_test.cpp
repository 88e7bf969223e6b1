#include "render/tool_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

namespace render {
namespace {

// Of the parts that shade: how far up the shaft they reach.
float reachOf_mm(const ToolBlock& block) {
  float reach_mm = 0.0f;
  for (std::size_t n = 0; n < TOOL_PARTS; ++n)
    if (block.from_P[n].w > 0.05f) reach_mm = std::max(reach_mm, block.to_P[n].z);
  return reach_mm;
}

TEST(ToolBlock, AHandpieceShadesOnlyWhereThereIsOne) {
  Frame frame;
  EXPECT_NEAR(reachOf_mm(toolBlock(frame)), 104.0f, 0.1f);
  frame.has_handpiece = false;
  EXPECT_NEAR(reachOf_mm(toolBlock(frame)), 20.0f, 0.1f) << "the shank";
  frame.tool_shades = false;
  EXPECT_EQ(toolBlock(frame).from_P[0].w, 0.0f);
}

}  // namespace
}  // namespace render
