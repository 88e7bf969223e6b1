#include "app/start_screen/start_page.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/start_screen/start_lists.h"

namespace app {
namespace {

StartMenu menuOf(std::size_t sessions) {
  std::vector<SessionListing> list(sessions);
  for (std::size_t n = 0; n < sessions; ++n) {
    list[n].path = std::to_string(n) + ".molar";
    list[n].verdict = SessionVerdict::complete;
  }
  return StartMenu(startLists({.patients = {}, .devices = {}, .calibrations = {}, .sessions = list, .teeth = {}}));
}

TEST(StartPage, PlacesLieOnThePageApartFromEachOther) {
  const std::vector<StartPlace> places = startPlaces(menuOf(40));
  for (std::size_t a = 0; a < places.size(); ++a) {
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(places[a].corner, glm::dvec2(0.0))));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(places[a].corner + places[a].size, kStartPage)));
    for (std::size_t b = 0; b < a; ++b) {
      const glm::dvec2 low = glm::max(places[a].corner, places[b].corner);
      const glm::dvec2 high = glm::min(places[a].corner + places[a].size, places[b].corner + places[b].size);
      EXPECT_FALSE(high.x - low.x > 1e-9 && high.y - low.y > 1e-9) << a << " over " << b;
    }
  }
}

TEST(StartPage, AClickMeansTheChoiceUnderItInWindowsOfEveryShape) {
  const StartMenu menu = menuOf(40);
  for (const glm::ivec2 window : {glm::ivec2(1280, 800), glm::ivec2(800, 1200), glm::ivec2(1920, 400)}) {
    const double scale = std::min(window.x / kStartPage.x, window.y / kStartPage.y);
    const glm::dvec2 corner = 0.5 * (glm::dvec2(window) - scale * kStartPage);
    for (const StartPlace& place : startPlaces(menu)) {
      const auto found = startPlaceAt(menu, corner + scale * (place.corner + 0.5 * place.size), window);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->list, place.list);
      EXPECT_EQ(found->choice, place.choice);
      EXPECT_EQ(found->starts, place.starts);
    }
    EXPECT_FALSE(startPlaceAt(menu, corner + glm::dvec2(1.0), window));
  }
}

TEST(StartPage, TheChoiceOfALongListIsAlwaysShown) {
  StartMenu menu = menuOf(40);
  constexpr auto kSessions = static_cast<std::size_t>(StartListName::sessions);
  for (std::size_t n = 0; n < menu.lists()[kSessions].choices.size(); ++n) {
    menu.choose(kSessions, n);
    const std::vector<StartPlace> places = startPlaces(menu);
    EXPECT_TRUE(std::ranges::any_of(places, [&](const StartPlace& place) {
      return !place.starts && place.list == kSessions && place.choice == n;
    })) << n;
  }
}

TEST(StartPage, FillsTheWindowAndChangesWithTheChoice) {
  StartMenu menu = menuOf(3);
  const render::Image before = startPage(menu, {640, 400});
  EXPECT_EQ(before.rgba.size(), 4u * 640 * 400);
  menu.take({.key = render::Key::down, .down = true, .repeated = false, .shift = false, .control = false});
  EXPECT_NE(startPage(menu, {640, 400}).rgba, before.rgba);
  EXPECT_EQ(startPage(menu, {500, 700}).rgba.size(), 4u * 500 * 700);
}

}  // namespace
}  // namespace app
