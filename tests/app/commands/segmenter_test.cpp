#include "app/commands/segmenter.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "assets/load_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

namespace fs = std::filesystem;

TEST(Segmenter, ACommandThatTakesTooLongIsEndedWithAllThatItStarted) {
  const fs::path temporary = fs::temp_directory_path() / ("molar_segmenter_" + std::to_string(getpid()));
  fs::create_directories(temporary);
  setenv("TMPDIR", temporary.c_str(), 1);
  const assets::VolumeGrid grid{{4, 4, 4}, 1.0, {0.0, 0.0, 0.0}};
  const std::vector<std::int16_t> grey(64, 0);
  const auto begun = std::chrono::steady_clock::now();
  {
    // Its child would leave a mark where it outlived the limit.
    Segmenter late("sh -c '(sleep 4; touch \"" + (temporary / "mark").string() + "\") & wait; : {ct} {labels}'");
    const std::string said =
        tests::refusalOf<assets::LoadError>([&] { late.labels(grid, grey, std::chrono::seconds(1)); });
    EXPECT_NE(said.find("took longer than"), std::string::npos) << said;
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60));
  sleep(5);
  EXPECT_TRUE(fs::is_empty(temporary)) << "nothing of the scan stays, and nothing it started goes on";
  unsetenv("TMPDIR");
  fs::remove_all(temporary);
}

}  // namespace
}  // namespace app
