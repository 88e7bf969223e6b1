// Real jaws, faces and foreign files, which lie beside the project and not in it: `$MOLAR_SHARED`, else ../shared.
// Suites that need them have RealData in their name (the label `realdata` goes by it) and skip where there are none.
// Suites of Mutants take them as further seeds.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tests {

inline std::filesystem::path sharedData(const std::string& below) {
  const std::string suite = testing::UnitTest::GetInstance()->current_test_info()->test_suite_name();
  EXPECT_TRUE(suite.find("RealData") != suite.npos || suite.find("Mutants") != suite.npos)
      << suite << " reads the shared data: name it …RealData";
  const char* given = std::getenv("MOLAR_SHARED");
  return std::filesystem::weakly_canonical(given != nullptr ? given : MOLAR_SHARED_DEFAULT) / "data" / below;
}

}  // namespace tests

/// Skips the test where `path` is not.
#define MOLAR_NEEDS(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "NO SHARED DATA at " << (path) << ": set MOLAR_SHARED"
