#include <gtest/gtest.h>

#include "render/gpu/framebuffer.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/offscreen_context.h"
#include "render/gpu/program.h"

namespace render {
namespace {

TEST(OffscreenContext, NeedsNoDisplayAndReportsNoError) {
  OffscreenContext context;
  EXPECT_NO_THROW(throwIfGlError("start"));
}

TEST(OffscreenContext, CanBeCreatedAgain) {
  for (int n = 0; n < 3; ++n) {
    const OffscreenContext context;
    Framebuffer target(glm::ivec2(4, 4), std::array{TexelFormat::rgba8}, false);
    target.clear();
    EXPECT_EQ(target.readRgba8(0), std::vector<std::uint8_t>(64, 0));
  }
}

TEST(GlError, IsOneLineAndReportedOnce) {
  OffscreenContext context;
  Texture texture = Texture::volume(glm::ivec3(2), TexelFormat::r16);
  const std::vector<std::byte> texels(16);
  texture.upload({5, 5, 5}, {2, 2, 2}, texels);
  try {
    throwIfGlError("uploading outside the texture");
    FAIL() << "no error seen";
  } catch (const GpuError& error) {
    EXPECT_NE(std::string(error.what()).find("uploading outside the texture"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  EXPECT_NO_THROW(throwIfGlError("afterwards"));
}

TEST(Program, BuildsEveryPairOfShaders) {
  const OffscreenContext context;
  for (const char* fragment : {"background.frag", "volume.frag", "output.frag"})
    EXPECT_NO_THROW((Program{"screen.vert", fragment})) << fragment;
  EXPECT_NO_THROW((Program{"mesh.vert", "mesh.frag"}));
}
TEST(Program, RefusesAnUnknownShader) {
  const OffscreenContext context;
  EXPECT_THROW(Program{"fog.frag"}, GpuError);
}

TEST(Texture, RefusesAVolumeLargerThanTheDriverTakes) {
  const OffscreenContext context;
  EXPECT_THROW(Texture::volume(glm::ivec3(1, 1, 1 << 20), TexelFormat::r8ui), GpuError);
}

}  // namespace
}  // namespace render
