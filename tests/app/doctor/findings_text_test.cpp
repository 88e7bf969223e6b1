#include "app/doctor/findings_text.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/doctor/haptic_usb.h"
#include "app/text/wrapped_text.h"

namespace app {
namespace {

const std::vector<Finding> kFindings = {
    {"graphics", Health::ok, "OpenGL 4.5."},
    {"openhaptics", Health::missing, "It is \"not\" there.", "Install it."},
    {"pedal", Health::not_needed, "None."},
    {"wake-up", Health::warn, std::string(300, 'x') + " then a word that is short.", "Mend it."},
};

TEST(FindingsText, LinesUpWordsAndCountsThem) {
  const std::string text = asText(kFindings, {80, false});
  EXPECT_NE(text.find("  ok       graphics     OpenGL 4.5.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  MISSING  openhaptics  It is \"not\" there.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n                        → Install it.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("1 in order, 1 to look at, 1 missing, 1 not needed."), std::string::npos) << text;
  EXPECT_EQ(text.find('\033'), std::string::npos) << "a file gets no colours";
  EXPECT_NE(asText(kFindings, {80, true}).find("\033[31;1mMISSING\033[0m"), std::string::npos);
}

TEST(FindingsText, IsTheSameForPrograms) {
  const auto json = nlohmann::json::parse(asJson(kFindings));
  ASSERT_EQ(json["checks"].size(), kFindings.size());
  EXPECT_EQ(json["missing"], 1);
  EXPECT_EQ(json["checks"][1]["id"], "openhaptics");
  EXPECT_EQ(json["checks"][1]["state"], "missing");
  EXPECT_EQ(json["checks"][1]["sentence"], "It is \"not\" there.");
  EXPECT_EQ(json["checks"][1]["next_step"], "Install it.");
  EXPECT_EQ(json["checks"][2]["state"], "not-needed");
  EXPECT_NO_THROW(asJson({{"x", Health::ok, "a name with \xff in it"}}));
}

TEST(WrappedText, KeepsItsMarginsAndEveryWord) {
  const std::string said = "a servo of 1 kHz woke 12 µs late in the middle, und so weiter bis zum Ende der Zeile";
  for (std::size_t width = 20; width < 110; width += 7) {
    const std::string wrapped = wrappedText(said, 10, width);
    std::istringstream lines(wrapped), words(wrapped);
    std::string joined, word;
    while (words >> word) joined += (joined.empty() ? "" : " ") + word;
    EXPECT_EQ(joined, said);
    bool first = true;
    for (std::string line; std::getline(lines, line); first = false) {
      EXPECT_TRUE(first || line.find_first_not_of(' ') == 10u) << line;
      const auto columns = std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; });
      EXPECT_LE(static_cast<std::size_t>(columns) + (first ? 10 : 0), width) << line;
    }
  }
  EXPECT_EQ(wrappedText("", 4, 80), "");
}

TEST(UdevRules, GiveAccessToTheUserAndKeepModemManagerOut) {
  std::istringstream rules(udevRules());
  int for_usb = 0, for_modems = 0;
  for (std::string line; std::getline(rules, line);) {
    if (line.empty() || line[0] == '#') continue;
    EXPECT_TRUE(line.starts_with("SUBSYSTEM==\"")) << line;
    EXPECT_NE(line.find("TAG+=\"uaccess\""), std::string::npos) << line;
    EXPECT_EQ(std::ranges::count(line, '"') % 2, 0) << line;
    for_usb += line.starts_with("SUBSYSTEM==\"usb\"") ? 1 : 0;
    for_modems += line.find("ID_MM_DEVICE_IGNORE") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(for_usb, 4);
  EXPECT_EQ(for_modems, 8);
}

}  // namespace
}  // namespace app
