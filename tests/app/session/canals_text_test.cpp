// The canals of a treated tooth in a session's setup.
#include "app/session/canals_text.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/session/session_error.h"

namespace app {
namespace {

assets::ToothCanals twoCanals() {
  assets::ToothCanals tooth;
  tooth.fdi = 46;
  tooth.frame.cervix_P_mm = {1.0, 2.0, 3.0};
  tooth.chamber.outline_mm = {{-1.0, -1.0}, {1.0, -1.0}, {0.0, 1.0}};
  tooth.chamber.horns = {{{0.0, 0.0, 0.4}, {0.5, 0.5, 1.4}, 0.4, 0.1}};
  for (const char* const name : {"mesiobuccal", "mesiolingual"}) {
    assets::ToothCanal canal;
    canal.name = name;
    for (int n = 0; n < 5; ++n) canal.places.push_back({{0.1 * n, 0.0, -1.0 * n}, 1.0 * n, 0.3 - 0.03 * n, 0.4});
    canal.schneider_rad = 0.5;
    canal.reference_P_mm = {0.0, 0.0, 6.0};
    tooth.canals.push_back(canal);
  }
  tooth.canals[1].joins = 0;
  return tooth;
}

TEST(CanalsText, ComesBackAsItWas) {
  const assets::ToothCanals tooth = twoCanals();
  const assets::ToothCanals again = canalsFrom(canalsText(tooth));
  EXPECT_EQ(again.fdi, 46);
  EXPECT_EQ(again.frame.cervix_P_mm, tooth.frame.cervix_P_mm);
  EXPECT_EQ(again.frame.axes_P, tooth.frame.axes_P);
  EXPECT_EQ(again.chamber.outline_mm, tooth.chamber.outline_mm);
  ASSERT_EQ(again.chamber.horns.size(), 1u);
  EXPECT_EQ(again.chamber.horns[0].to_mm, tooth.chamber.horns[0].to_mm);
  ASSERT_EQ(again.canals.size(), 2u);
  EXPECT_EQ(again.canals[1].name, "mesiolingual");
  EXPECT_EQ(again.canals[1].joins, std::optional<std::size_t>(0));
  EXPECT_FALSE(again.canals[0].joins);
  ASSERT_EQ(again.canals[0].places.size(), 5u);
  EXPECT_EQ(again.canals[0].places[3].narrow_mm, tooth.canals[0].places[3].narrow_mm);
  EXPECT_EQ(again.canals[0].length_mm(), 4.0);
}

TEST(CanalsText, RefusesWhatCannotBe) {
  const nlohmann::json good = nlohmann::json::parse(canalsText(twoCanals()));
  const auto refused = [&](const auto& damage) {
    nlohmann::json bad = good;
    damage(bad);
    EXPECT_THROW(canalsFrom(bad.dump()), SessionError) << bad.dump().substr(0, 200);
  };
  refused([](auto& j) { j = nlohmann::json::array(); });
  refused([](auto& j) { j.erase("canals"); });
  refused([](auto& j) { j["canals"] = nlohmann::json::array(); });
  refused([](auto& j) { j["fdi"] = 99; });
  refused([](auto& j) { j["canals"][1]["joins"] = 2; });
  refused([](auto& j) { j["canals"][0]["places"][2][3] = 0.5; });
  refused([](auto& j) { j["canals"][0]["places"][2][4] = 0.0; });
  refused([](auto& j) { j["canals"][0]["places"][2][0] = 1e9; });
  refused([](auto& j) { j["canals"][0]["places"][2] = "x"; });
  refused([](auto& j) { j["axes_P"][0] = {2.0, 0.0, 0.0}; });
  refused([](auto& j) { j["chamber"]["outline_mm"] = nlohmann::json::array(); });
  refused([](auto& j) { j["canals"][0]["name"] = std::string(100, 'x'); });
}

/// Any byte changed: it is read as it stands, or refused in one line.
TEST(CanalsText, ReadsNoDamageAsSomethingElse) {
  const std::string good = canalsText(twoCanals());
  std::mt19937 random(5);
  int read = 0, refused = 0;
  for (int n = 0; n < 5000; ++n) {
    std::string text = good;
    for (int k = 0; k <= n % 3; ++k) text[random() % text.size()] = static_cast<char>(32 + random() % 95);
    try {
      const assets::ToothCanals tooth = canalsFrom(text);
      for (const assets::ToothCanal& canal : tooth.canals) EXPECT_TRUE(std::isfinite(canal.length_mm()));
      ++read;
    } catch (const SessionError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace app
