#include "app/instructor/window_place.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace app {
namespace {

using render::DesktopBox;

TEST(WindowPlace, IsBesideThePictureAndOnTheMonitor) {
  const DesktopBox monitor{{100, 50}, {2560, 1440}};
  for (const glm::ivec2 at : {glm::ivec2(100, 50), glm::ivec2(1380, 50), glm::ivec2(100, 690), glm::ivec2(1380, 690),
                              glm::ivec2(0, 0), glm::ivec2(740, 370)}) {
    const DesktopBox surgeons{at, {1280, 800}};
    const auto place = placeBeside(surgeons, monitor);
    ASSERT_TRUE(place) << at.x << "," << at.y;
    EXPECT_TRUE(areApart(*place, surgeons));
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(place->at_px, monitor.at_px)));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(place->at_px + place->size_px, monitor.at_px + monitor.size_px)));
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(place->size_px, kLeastInstructor_px)));
  }
  EXPECT_FALSE(placeBeside({{0, 0}, {1280, 800}}, {{0, 0}, {1400, 1000}})) << "no room";
  EXPECT_FALSE(placeBeside(monitor, monitor)) << "full screen";
}

TEST(WindowPlace, IsRememberedUnlessTheFileIsOfNoUse) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("molar_place_" + std::to_string(getpid()));
  const std::string file = (folder / "molar" / "instructor_window.toml").string();
  EXPECT_FALSE(rememberedPlace(file));
  const DesktopBox place{{-1280, 40}, {900, 700}};
  rememberPlace(file, place);
  EXPECT_EQ(rememberedPlace(file), place);
  std::ofstream(file) << "at_px = [1, 2]\nsize_px = \"large\"\n";
  EXPECT_FALSE(rememberedPlace(file));
  std::ofstream(file) << "at_px = [1, 2]\nsize_px = [3, 4]\n";
  EXPECT_FALSE(rememberedPlace(file)) << "too small to use";
  std::filesystem::remove_all(folder);
  rememberPlace("/proc/none/molar/window.toml", place);  // nothing happens
}

}  // namespace
}  // namespace app
