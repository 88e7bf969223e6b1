#include "app/case/soft_tissue_source.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "app/case/cache_folder.h"
#include "assets/scenery/soft_tissue_distance.h"
#include "tests/scratch_folder.h"

namespace app {
namespace {

class SoftTissueSource : public testing::Test {
 protected:
  SoftTissueSource() {
    if (const char* before = std::getenv("XDG_CACHE_HOME")) before_ = before;
    ::setenv("XDG_CACHE_HOME", folder_.file("cache").c_str(), 1);
    assets::MeshPart part;
    part.name = "Gingiva";
    part.position_mm = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}};
    part.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    gum_.parts = {part};
    field_ = assets::softTissueField(assets::softTissueSurfaces(gum_, {}, region_), region_);
  }
  ~SoftTissueSource() override {
    if (before_.empty())
      ::unsetenv("XDG_CACHE_HOME");
    else
      ::setenv("XDG_CACHE_HOME", before_.c_str(), 1);
  }

  assets::SoftTissueField found() { return softTissueAround(gum_, {}, region_); }
  /// The only file in the cache.
  static std::filesystem::path kept() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(cacheFolder())) files.push_back(entry.path());
    EXPECT_EQ(files.size(), 1u);
    return files.empty() ? "" : files.front();
  }

  tests::ScratchFolder folder_;
  std::string before_;
  assets::MeshModel gum_;
  assets::SoftTissueRegion region_{glm::dvec3(0.0)};
  assets::SoftTissueField field_;
};

TEST_F(SoftTissueSource, KeepsTheFieldAndReadsTheSameBack) {
  EXPECT_EQ(found(), field_);
  const auto written = std::filesystem::last_write_time(kept());
  EXPECT_EQ(found(), field_);
  EXPECT_EQ(std::filesystem::last_write_time(kept()), written) << "read, not made again";
}

TEST_F(SoftTissueSource, MakesADamagedFileAgain) {
  found();
  const std::filesystem::path file = kept();
  const auto bytes = std::filesystem::file_size(file);
  std::filesystem::resize_file(file, bytes / 2);
  EXPECT_EQ(found(), field_);
  EXPECT_EQ(std::filesystem::file_size(file), bytes);
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(70).put('\x55');
  EXPECT_EQ(found(), field_);
}

TEST_F(SoftTissueSource, OtherMeshesHaveAFieldOfTheirOwn) {
  found();
  gum_.parts.front().position_mm[3].z = 12.0f;
  const assets::SoftTissueField taller =
      assets::softTissueField(assets::softTissueSurfaces(gum_, {}, region_), region_);
  EXPECT_NE(taller, field_);
  EXPECT_EQ(found(), taller);
}

TEST_F(SoftTissueSource, DoesWithoutACacheThatCannotBeWritten) {
  std::ofstream(folder_.file("cache")) << "a file where the folder should be";
  EXPECT_EQ(found(), field_);
}

}  // namespace
}  // namespace app
