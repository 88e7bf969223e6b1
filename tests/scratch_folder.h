// A folder of one running test, whatever other tests run beside it: made empty, removed with everything in it.
#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tests {

class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::random_device entropy;
    folder_ = std::filesystem::temp_directory_path() /
              ("molar_" + std::string(test->test_suite_name()) + test->name() + std::to_string(entropy()));
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() {
    std::error_code failed;
    std::filesystem::remove_all(folder_, failed);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.push_back(entry.path().filename());
    return names;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace tests
