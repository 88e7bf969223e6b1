// A found jaw corrected, confirmed and saved by mouse and keys: real events through an X server to the program in its
// window. Nothing is timed: each step waits for what the program says.
#include "tests/app/check_page/phantom_patient.h"
#include "tests/app/commands/program.h"
#include "tests/app/commands/real_events.h"

#include "app/check_page/check_run.h"

namespace app {
namespace {

using namespace std::chrono_literals;

constexpr glm::ivec2 kWindow_px{1280, 800};
/// Longer than a busy machine needs between two lines; ends a test that hangs.
constexpr auto kLongestWait = 60s;

class CheckByMouse : public ProgramTest {};

/// The program's next line with these words.
bool hears(RunningProgram& program, const std::string& words) {
  while (const auto line = program.nextLine(kLongestWait))
    if (line->find(words) != std::string::npos) return true;
  return false;
}

TEST_F(CheckByMouse, AToothIsDroppedAnotherConfirmedAndBothAreSaved) {
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = 0.8});
  assets::savePatient(tests::phantomPatient(phantom), at("patient"), false);
  // Where a tooth is on the page: the same page, without a window.
  const auto place_of = [&](int fdi) {
    CheckRun page(at("patient"), [](const std::string&) {});
    page.finish();
    for (int n = 0; n < 40; ++n) {
      const CheckRow& row = page.menu().rows()[page.menu().selected()];
      if (row.fdi == fdi) break;
      page.handle(render::KeyPressed{.key = fdi == 48 ? render::Key::up : render::Key::down, .down = true}, kWindow_px);
    }
    return glm::ivec2(page.placeOf(JawView::axial, page.menu().cursor_P_mm(), kWindow_px));
  };
  const glm::ivec2 of_48 = place_of(48);

  const PrivateScreen screen(kWindow_px);
  ScreenHand hand(screen);
  RunningProgram program("DISPLAY=" + screen.name() + " LIBGL_ALWAYS_SOFTWARE=1 exec " + std::string(MOLAR_PROGRAM) +
                         " check " + at("patient"));
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  // It begins at the operated tooth; confirmed by Enter, and then dropped by a click on it and taken back.
  hand.moveTo(of_48);
  hand.key(XK_Return);
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  hand.key(XK_minus);
  hand.click(ScreenHand::left);
  ASSERT_TRUE(hears(program, "shown: 15 teeth"));
  hand.controlKey(XK_z);
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  hand.controlKey(XK_s);
  ASSERT_TRUE(hears(program, "saved"));
  // The first puts the tool away. A key that had no answer is pressed again.
  for (int n = 0; n < 20 && !program.hasEnded(); ++n) {
    hand.key(XK_Escape);
    program.nextLine(2s);
  }
  ASSERT_TRUE(program.hasEnded());
  EXPECT_EQ(program.exitStatus(), 0);
  const assets::Patient saved = assets::loadPatient(at("patient"));
  ASSERT_TRUE(saved.found);
  EXPECT_TRUE(saved.found->tooth);
  EXPECT_EQ(saved.site->fdi, 48);
}

}  // namespace
}  // namespace app
