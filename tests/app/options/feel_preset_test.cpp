#include "app/options/feel_preset.h"

#include <gtest/gtest.h>

#include "haptics/contact/law.h"
#include "tests/haptics/phantom.h"

namespace app {
namespace {

TEST(FeelPreset, WeighsTheStiffnessByTheDensityOverTheLastHundredTicks) {
  haptics::LawSettings law;
  useFeelPreset(feelPresets().front(), law);
  const haptics::phantom::Phantom bone = haptics::phantom::halfSpace(2.0, 0.2);
  const auto of = [&](assets::Tissue tissue) {
    const std::vector<std::uint8_t> label(bone.solid.size(), static_cast<std::uint8_t>(tissue));
    return haptics::Cubelets(bone.grid, bone.solid, label);
  };
  const haptics::Cubelets enamel = of(assets::Tissue::enamel), dentine = of(assets::Tissue::dentine);
  haptics::LawState state;
  const auto press = [&](const haptics::Cubelets& tooth) {
    const haptics::SolidField field = tooth.field();
    const haptics::ToolInBone at{
        field, {haptics::ShapeKind::sphere, 0.8, 0.0}, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.5}}, law.tissue, {}};
    const haptics::Contact contact = haptics::contactOf(law, at, state);
    haptics::updateLawState(law, at, contact, state);
    return glm::length(contact.force_P_N.xyz);
  };
  double in_enamel = 0.0;
  for (int n = 0; n < 100; ++n) in_enamel = press(enamel);
  press(dentine);
  EXPECT_NEAR(press(dentine) / in_enamel, (99.0 + 150.0 / 255.0) / 100.0, 1e-9);
  for (int n = 0; n < 100; ++n) press(dentine);
  EXPECT_NEAR(press(dentine) / in_enamel, 150.0 / 255.0, 1e-9);
}

TEST(FeelPreset, LeavesCariesAsMuchSofterThanDentineAsItIs) {
  haptics::LawSettings law;
  const auto shares = [&] {
    const auto of = [&](assets::Tissue tissue) { return law.tissue.factor[static_cast<std::size_t>(tissue)]; };
    const double dentine = of(assets::Tissue::dentine);
    return std::array{of(assets::Tissue::caries_soft) / dentine, of(assets::Tissue::caries_firm) / dentine};
  };
  const auto is_as_published = [](const std::array<double, 2>& share) {
    EXPECT_NEAR(share[0], 0.25, 1e-9);
    EXPECT_NEAR(share[1], 0.6, 1e-9);
  };
  is_as_published(shares());
  useFeelPreset(feelPresets().front(), law);
  is_as_published(shares());
}

}  // namespace
}  // namespace app
