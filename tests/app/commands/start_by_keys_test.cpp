// `molar start` by keys and mouse: real events through an X server to the program in its window. What is chosen begins,
// and the start screen is there again. Nothing is timed: each step waits for what the program says.
#include <nlohmann/json.hpp>

#include "tests/app/commands/program.h"
#include "tests/app/commands/real_events.h"

namespace app {
namespace {

using namespace std::chrono_literals;

constexpr glm::ivec2 kStartScreen_px{1280, 800};
/// Middle of the button that starts, on a window of that size.
constexpr glm::ivec2 kStartButton_px{1128, 736};

class StartByKeys : public ProgramTest {};

/// Until a window is there; a minute at most.
bool awaitWindow(ScreenHand& hand) {
  for (int n = 0; n < 600 && !hand.sees("Molar"); ++n) poll(nullptr, 0, 100);
  return hand.sees("Molar");
}

/// The program's next line with these words; `press`: meanwhile, every two seconds.
template <class Press>
bool awaitWords(RunningProgram& program, const std::string& words, const Press& press) {
  for (int n = 0; n < 60 && !program.hasEnded(); ++n) {
    press();
    while (const auto line = program.nextLine(2s))
      if (line->find(words) != std::string::npos) return true;
  }
  return false;
}

TEST_F(StartByKeys, TheTreatmentOfTheChosenToothBegins) {
  const PrivateScreen screen(kStartScreen_px);
  ScreenHand hand(screen);
  RunningProgram program("DISPLAY=" + screen.name() + " LIBGL_ALWAYS_SOFTWARE=1 exec " + std::string(MOLAR_PROGRAM) +
                         " start");
  ASSERT_TRUE(awaitWindow(hand));
  hand.moveTo(kStartButton_px);
  hand.takeKeys();
  // Case, operation: root canal with its cavity open; tooth: 45, which is before 46.
  for (const KeySym symbol : {XK_Tab, XK_Down, XK_Down, XK_Tab, XK_Up}) hand.key(symbol);
  hand.click(ScreenHand::left);
  EXPECT_TRUE(awaitWords(program, "no graphics card", [] {})) << "the rehearsal has drawn";
  const auto escape = [&] {
    hand.takeKeys();
    hand.key(XK_Escape);
  };
  EXPECT_TRUE(awaitWords(program, "lower right second premolar (45), root canals", escape));
  awaitWords(program, "nothing", [&] { escape(); });
  EXPECT_TRUE(program.hasEnded());
  EXPECT_EQ(program.exitStatus(), 0);
  const ProgramOutput measured = molar("metrics last --json");
  ASSERT_EQ(measured.status, 0) << measured.err;
  EXPECT_EQ(nlohmann::json::parse(measured.out).at("root_canals").at("fdi"), 45);
}

}  // namespace
}  // namespace app
