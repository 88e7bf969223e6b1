#include "app/options/settings_text.h"

#include <gtest/gtest.h>

#include "app/text/usage_error.h"

namespace app {
namespace {

TEST(SettingsText, SetsTheGivenKeys) {
  double stiffness = 0.8, damping = 0.0;
  applySettings({"stiffness_N_per_mm=1.25"}, {{"stiffness_N_per_mm", {&stiffness, 0, 10, "N/mm"}},
                                              {"damping_Ns_per_mm", {&damping, 0, 1, "Ns/mm"}}});
  EXPECT_EQ(stiffness, 1.25);
  EXPECT_EQ(damping, 0.0);
}

TEST(SettingsText, RefusesUnknownDuplicateAndOutOfRange) {
  double k = 1.0;
  const SettingMap settings{{"k", {&k, 0, 10, "N/mm"}}};
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{
           {"q=1"}, {"k"}, {"k="}, {"k=1x"}, {"k=nan"}, {"k=-1"}, {"k=11"}, {"k=1", "k=2"}, {""}, {"=1"}})
    EXPECT_THROW(applySettings(bad, settings), UsageError);
}

TEST(SettingsText, AcceptsAFormerKeyButNotTogetherWithTheNewOne) {
  double factor = 0.1;
  const SettingMap settings{{"factor_mandibular_canal", {&factor, 0, 10}}};
  applySettings({"factor_canal=2"}, settings);
  EXPECT_EQ(factor, 2.0);
  EXPECT_THROW(applySettings({"factor_canal=2", "factor_mandibular_canal=3"}, settings), UsageError);
}

TEST(SettingsText, NamesTheRangeWithItsUnit) {
  double k = 1.0;
  try {
    applySettings({"k=11"}, {{"k", {&k, 0, 10, "N/mm"}}});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("0 to 10 N/mm"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace app
