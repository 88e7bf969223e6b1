#include "app/debrief/debrief_keys.h"

#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(DebriefKeys, NoneMeansTwoThings) {
  std::set<std::pair<render::Key, bool>> keys;
  std::set<DebriefAction> actions;
  for (const DebriefKey& one : kDebriefKeys) {
    EXPECT_TRUE(keys.insert({one.key, one.shift}).second) << one.name;
    actions.insert(one.action);
    EXPECT_EQ(actionOf({one.key, true, false, one.shift, false}), one.action);
  }
  EXPECT_EQ(actions.size(), static_cast<std::size_t>(DebriefAction::close) + 1) << "an action has no key";
}

TEST(DebriefKeys, CountWhenPressedAlone) {
  EXPECT_FALSE(actionOf({render::Key::space, false}));
  EXPECT_FALSE(actionOf({render::keyOf('P'), true, false, false, true}));
  EXPECT_EQ(actionOf({render::Key::left, true, true, true, false}), DebriefAction::back_far);
  for (const char letter : {'P', 'C', 'T', 'G'})
    EXPECT_FALSE(actionOf({render::keyOf(letter), true, true, false, false})) << letter << " held";
  EXPECT_FALSE(actionOf({render::Key::space, true, true, false, false}));
  EXPECT_NE(debriefKeyHelp().find("J K L"), std::string::npos);
}

}  // namespace
}  // namespace app
