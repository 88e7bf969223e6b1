#include "app/session/bite_event.h"

#include <gtest/gtest.h>

#include <random>

namespace app {
namespace {

BiteRecord someBite() {
  return {.t_s = 12.3455,
          .paper_um = 40.0,
          .is_made = true,
          .high_um = 112.0,
          .clearance_um = 0.0,
          .first = "mesiobuccal",
          .contacts = {{"mesiobuccal", 0.498, 0.0}, {"middle", 0.125, 31.0}}};
}

TEST(BiteEvent, ReadsBackWhatItWrote) {
  EXPECT_EQ(biteFrom(biteText(someBite())), someBite());
  BiteRecord nothing;
  nothing.paper_um = 8.0;
  EXPECT_EQ(biteFrom(biteText(nothing)), nothing) << "nothing opposes the tooth";
  EXPECT_DOUBLE_EQ(someBite().area_mm2(), 0.623);
  for (const char* const closing : {"hinge", "balance"}) {
    BiteRecord bite = someBite();
    bite.is_made = false, bite.closing = closing, bite.is_balanced = bite.closing == "balance";
    EXPECT_EQ(biteFrom(biteText(bite)), bite) << closing;
  }
}

TEST(BiteEvent, IsNotReadFromOtherWords) {
  for (
      const char* const text :
      {"", "{}", "[]", "null", R"({"t_s": 1, "paper_um": 40, "antagonist": "made", "high_um": 0, "first": ""})",
       R"({"t_s": 1, "paper_um": 40, "antagonist": "bought", "high_um": 0, "clearance_um": 1, "first": "", "contacts": []})",
       R"({"t_s": -1, "paper_um": 40, "antagonist": "made", "high_um": 0, "clearance_um": 1, "first": "", "contacts": []})",
       R"({"t_s": 1, "paper_um": 40, "antagonist": "made", "high_um": 0, "clearance_um": "1", "first": "", "contacts": []})",
       R"({"t_s": 1, "paper_um": 40, "antagonist": "made", "high_um": 0, "clearance_um": 1, "first": "", "contacts": [1]})",
       R"({"t_s": 1, "paper_um": 40, "antagonist": "made", "high_um": 0, "clearance_um": 1, "first": "", "contacts": {}})",
       R"({"t_s": 1, "paper_um": 40, "antagonist": "made", "high_um": 0, "clearance_um": 1, "first": "", "contacts": [], "closing": "sideways", "balanced": true})",
       R"({"t_s": 1, "paper_um": 40, "antagonist": "made", "high_um": 0, "clearance_um": 1, "first": "", "contacts": [], "closing": "hinge"})"})
    EXPECT_FALSE(biteFrom(text)) << text;
}

TEST(BiteEvent, OfChangedBytesIsABiteOrNone) {
  std::mt19937 random(3);
  const std::string text = biteText(someBite());
  int read = 0;
  for (int n = 0; n < 4000; ++n) {
    std::string changed = text;
    for (int k = 0; k <= n % 3; ++k) changed[random() % changed.size()] = static_cast<char>(random() % 256);
    if (n % 5 == 0) changed.resize(random() % changed.size());
    if (const auto bite = biteFrom(changed)) {
      ++read;
      EXPECT_GE(bite->high_um, 0.0);
      EXPECT_LE(bite->contacts.size(), 2u);
    }
  }
  EXPECT_LT(read, 2000);
}

}  // namespace
}  // namespace app
