// A found jaw corrected, confirmed and saved by mouse and keys: real events through an X server to the program in its
// window. Nothing is timed: each step waits for what the program says.
#include <thread>

#include "tests/app/check_page/phantom_patient.h"
#include "tests/app/commands/program.h"
#include "tests/app/commands/real_events.h"

#include "app/check_page/check_run.h"
#include "app/check_page/import_page.h"

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

/// The same hand on a page without a window and on the program's: what is clicked, drawn and typed.
class TwoPages {
 public:
  TwoPages(const std::string& twin_folder, const PrivateScreen& screen)
      : twin_(twin_folder, [](const std::string&) {}), hand_(screen) {
    twin_.finish();
  }
  CheckRun& twin() { return twin_; }

  void key(KeySym symbol, char32_t letter) {
    hand_.key(symbol);
    twin_.handle(render::LetterTyped{letter}, kWindow_px);
  }
  void key(KeySym symbol, render::Key key) {
    hand_.key(symbol);
    press(key, false);
  }
  void controlKey(KeySym symbol, char letter) {
    hand_.controlKey(symbol);
    press(render::keyOf(letter), true);
  }
  void moveTo(glm::ivec2 px) {
    hand_.moveTo(px);
    twin_.handle(render::PointerMoved{px, px - at_px_, held_}, kWindow_px);
    at_px_ = px;
  }
  void click(glm::ivec2 px) { drag({px}); }
  void drag(const std::vector<glm::ivec2>& way_px) {
    moveTo(way_px.front());
    button(true);
    for (std::size_t n = 1; n < way_px.size(); ++n) moveTo(way_px[n]);
    button(false);
  }
  /// Through the slices.
  void wheel(int notches) {
    for (int n = 0; n < std::abs(notches); ++n) {
      hand_.click(notches > 0 ? ScreenHand::wheel_up : ScreenHand::wheel_down);
      twin_.handle(render::WheelTurned{notches > 0 ? 1.0 : -1.0}, kWindow_px);
    }
  }
  glm::ivec2 placeOf(const glm::dvec3& p_P_mm) const {
    return glm::ivec2(twin_.placeOf(JawView::axial, p_P_mm, kWindow_px));
  }
  /// To the slice parallel to the bite through a point; with any tool in hand.
  void lookAt(const glm::dvec3& p_P_mm) {
    moveTo(placeOf(p_P_mm));
    const JawViews::Plane plane = twin_.views().planeOf(JawView::axial, twin_.menu().cursor_P_mm(), {}, {100, 100});
    wheel(static_cast<int>(std::lround(plane.of(p_P_mm).z / twin_.views().grid().spacing_mm)));
  }

 private:
  void press(render::Key key, bool control) {
    twin_.handle(render::KeyPressed{.key = key, .down = true, .control = control}, kWindow_px);
  }
  void button(bool down) {
    hand_.press(ScreenHand::left, down);
    held_ = down ? render::MouseButton::left : render::MouseButton::none;
    twin_.handle(render::ButtonPressed{render::MouseButton::left, down}, kWindow_px);
  }

  CheckRun twin_;
  ScreenHand hand_;
  glm::ivec2 at_px_{0};
  render::MouseButton held_ = render::MouseButton::none;
};

/// Esc until it is left. A key that had no answer is pressed again.
int leave(RunningProgram& program, const PrivateScreen& screen) {
  ScreenHand hand(screen);
  for (int n = 0; n < 40 && !program.hasEnded(); ++n) {
    hand.takeKeys();
    hand.key(XK_Escape);
    program.nextLine(2s);
  }
  return program.hasEnded() ? program.exitStatus() : -1;
}

std::string onScreen(const PrivateScreen& screen) {
  return "DISPLAY=" + screen.name() + " LIBGL_ALWAYS_SOFTWARE=1 exec " + std::string(MOLAR_PROGRAM);
}

TEST(RunningProgramTest, EndsWhatDoesNotEndByItself) {
  RunningProgram hangs("trap '' TERM; echo begun; sleep 1000; sleep 1000", 200ms);
  ASSERT_TRUE(hears(hangs, "begun"));
  EXPECT_FALSE(hangs.nextLine(50ms));
  EXPECT_FALSE(hangs.hasEnded());
  EXPECT_EQ(hangs.exitStatus(), 128 + SIGKILL);
  // More words than a pipe holds do not keep it from ending.
  RunningProgram talks("head -c 300000 /dev/zero | tr '\\0' 'a'; exit 3");
  EXPECT_EQ(talks.exitStatus(), 3);
  // Left without asking for its end, it does not outlive its owner.
  const auto left_at = std::chrono::steady_clock::now();
  { const RunningProgram left("exec sleep 1000"); }
  EXPECT_LT(std::chrono::steady_clock::now() - left_at, kLongestWait);
}

TEST_F(CheckByMouse, BrushCanalPointsAndTheThirdMolarAreSavedAsTheyWereDrawn) {
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = 0.8});
  assets::savePatient(tests::phantomPatient(phantom), at("patient"), false);
  std::filesystem::copy(at("patient"), at("twin"));
  const PrivateScreen screen(kWindow_px);
  RunningProgram program(onScreen(screen) + " check " + at("patient"));
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  TwoPages pages(at("twin"), screen);
  CheckRun& twin = pages.twin();
  const auto of_48 = [&] { return std::ranges::count(twin.found().tooth, std::uint8_t{48}); };
  const auto before = of_48();

  // This is 48: the click gives it its number.
  const glm::dvec3 molar_P_mm = twin.menu().rows()[twin.menu().selected()].at_P_mm;
  const glm::ivec2 molar_px = pages.placeOf(molar_P_mm);
  pages.key(XK_8, U'8');
  pages.click(molar_px);
  ASSERT_EQ(twin.menu().edits().done(), 1u) << twin.menu().message();
  twin.finish();
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));

  // The brush erases in the tooth, paints beside it, and a third stroke is taken back.
  pages.key(XK_b, U'b'), pages.key(XK_g, U'g'), pages.key(XK_0, U'0');
  pages.drag({molar_px, molar_px + glm::ivec2(8, 3), molar_px + glm::ivec2(16, 0)});
  const auto erased = of_48();
  EXPECT_LT(erased, before);
  pages.key(XK_8, U'8'), pages.key(XK_bracketright, U']');
  pages.drag({molar_px + glm::ivec2(0, -60), molar_px + glm::ivec2(14, -66)});
  const auto painted = of_48();
  EXPECT_GT(painted, erased);
  pages.drag({molar_px + glm::ivec2(0, 60), molar_px + glm::ivec2(0, 80)});
  EXPECT_GT(of_48(), painted);
  pages.controlKey(XK_z, 'Z');
  EXPECT_EQ(of_48(), painted);
  ASSERT_EQ(twin.menu().edits().done(), 3u) << twin.menu().message();

  // Four points of the right canal: both ends by clicks beside the proposal, two by dragging the line.
  const auto canal = [&twin] {
    return *std::ranges::find(twin.found().canals, true, &assets::CanalProposal::is_right);
  };
  pages.key(XK_c, U'c');
  const std::vector<glm::dvec3> proposed = canal().line_P_mm;
  for (const glm::dvec3& end : {proposed.front(), proposed.back()}) {
    pages.lookAt(end);
    pages.click(pages.placeOf(end) + glm::ivec2(12, 12));
  }
  for (std::size_t third = 1; third <= 3; ++third) {
    twin.finish();
    ASSERT_TRUE(hears(program, "shown: 16 teeth")) << twin.menu().message();
    const std::vector<glm::dvec3> line = canal().line_P_mm;
    if (third == 3) break;
    const glm::dvec3 on = line[third * line.size() / 3];
    pages.lookAt(on);
    pages.drag({pages.placeOf(on), pages.placeOf(on) + glm::ivec2(1, 2), pages.placeOf(on) + glm::ivec2(2, 3)});
  }
  ASSERT_EQ(twin.menu().edits().done(), 6u) << twin.menu().message();
  ASSERT_NE(twin.menu().edits().canalOn(true), nullptr);
  EXPECT_EQ(twin.menu().edits().canalOn(true)->at_P_mm.size(), 4u);

  pages.controlKey(XK_s, 'S');
  ASSERT_TRUE(hears(program, "saved"));
  twin.finish();
  EXPECT_EQ(twin.menu().message(), "saved");
  EXPECT_EQ(leave(program, screen), 0);
  EXPECT_EQ(read("patient/clicks.json"), read("twin/clicks.json"));
  const assets::JawClicks clicks = readJawClicks(at("patient/clicks.json"));
  EXPECT_EQ(clicks.voxels.size(), 2u) << "the third stroke was taken back";
  ASSERT_EQ(clicks.teeth.size(), 1u);
  EXPECT_EQ(clicks.teeth[0].fdi, 48);
  ASSERT_EQ(clicks.canals.size(), 1u);
  EXPECT_EQ(clicks.canals[0].size(), 4u);
  const assets::Patient saved = assets::loadPatient(at("patient")), drawn = assets::loadPatient(at("twin"));
  EXPECT_TRUE(saved.ct.label == drawn.ct.label);
  EXPECT_TRUE(saved.ct.tooth == drawn.ct.tooth);
  EXPECT_EQ(std::ranges::count(saved.ct.tooth, std::uint8_t{48}), painted);
  EXPECT_EQ(saved.mandibular_canal_P_mm, drawn.mandibular_canal_P_mm);
  ASSERT_TRUE(saved.found);
  EXPECT_TRUE(saved.found->tooth);
  EXPECT_TRUE(saved.found->canal);
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
  RunningProgram program(onScreen(screen) + " check " + at("patient"));
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
  EXPECT_EQ(leave(program, screen), 0);
  const assets::Patient saved = assets::loadPatient(at("patient"));
  ASSERT_TRUE(saved.found);
  EXPECT_TRUE(saved.found->tooth);
  EXPECT_EQ(saved.site->fdi, 48);
}

/// A scan that nobody has labelled, as a file.
std::string scanFile(const std::string& path, double spacing_mm = 0.8) {
  const tests::ArchPhantom phantom = tests::archPhantom({.spacing_mm = spacing_mm});
  std::ofstream file(path, std::ios::binary);
  const glm::ivec3 size = phantom.grid.size;
  const glm::dvec3 origin = phantom.grid.origin_P_mm;
  file << "NRRD0004\ntype: short\ndimension: 3\nsizes: " << size.x << ' ' << size.y << ' ' << size.z
       << "\nspace: left-posterior-superior\nspace directions: (" << spacing_mm << ",0,0) (0," << spacing_mm
       << ",0) (0,0," << spacing_mm << ")\nspace origin: (" << origin.x << ',' << origin.y << ',' << origin.z
       << ")\nendian: little\nencoding: raw\n\n";
  file.write(reinterpret_cast<const char*>(phantom.hounsfield.data()),
             static_cast<std::streamsize>(2 * phantom.hounsfield.size()));
  return path;
}

/// On a terminal of its own.
std::string onTerminal(const PrivateScreen& screen, const std::string& arguments) {
  return "DISPLAY=" + screen.name() + " LIBGL_ALWAYS_SOFTWARE=1 exec script -qefc '" + std::string(MOLAR_PROGRAM) +
         " " + arguments + "' /dev/null";
}

TEST_F(CheckByMouse, AnImportOpensTheCheckPageByItself) {
  const PrivateScreen screen(kWindow_px);
  RunningProgram program(onTerminal(screen, "import " + scanFile(at("ct.nrrd")) + " --no-face --out " + at("patient")));
  // A line for each stage, then the page.
  ASSERT_TRUE(hears(program, "lower jaw"));
  ASSERT_TRUE(hears(program, "100 % of all"));
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  ScreenHand hand(screen);
  hand.key(XK_Return);
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  hand.controlKey(XK_s);
  ASSERT_TRUE(hears(program, "saved"));
  EXPECT_EQ(leave(program, screen), 0);
  EXPECT_TRUE(assets::loadPatient(at("patient")).found->tooth);
}

TEST_F(CheckByMouse, WithoutTheCheckPageAnImportSaysHowToOpenIt) {
  const PrivateScreen screen(kWindow_px);
  RunningProgram program(
      onTerminal(screen, "import " + scanFile(at("ct.nrrd")) + " --no-face --no-check --out " + at("patient")));
  EXPECT_TRUE(hears(program, "look at what was found: molar check patient"));
  EXPECT_FALSE(program.nextLine(kLongestWait));
  EXPECT_EQ(program.exitStatus(), 0);
}

TEST_F(CheckByMouse, AnImportIsCancelledInItsWindowAndLeavesNothing) {
  // Long enough for a window to open meanwhile.
  scanFile(at("ct.nrrd"), 0.45);
  // By the button, by Esc.
  for (const bool by_button : {true, false}) {
    const PrivateScreen screen(kWindow_px);
    RunningProgram program(onTerminal(screen, "import " + at("ct.nrrd") + " --no-face --out " + at("patient")));
    ScreenHand hand(screen);
    ASSERT_TRUE(hears(program, "files"));
    glm::ivec2 button(0);
    while (!isCancelAt(button, kWindow_px))
      button = button.x < kWindow_px.x ? button + glm::ivec2(9, 0) : glm::ivec2(0, button.y + 9);
    // Until it is seen: the window opens meanwhile.
    bool is_stopped = false;
    for (int n = 0; n < 4000 && !program.hasEnded(); ++n) {
      hand.moveTo(button + glm::ivec2(n % 2, 0));
      by_button ? hand.click(ScreenHand::left) : hand.key(XK_Escape);
      while (const auto line = program.nextLine(5ms))
        is_stopped = is_stopped || line->find("import: stopped, nothing was imported") != std::string::npos;
    }
    EXPECT_TRUE(is_stopped);
    EXPECT_EQ(program.exitStatus(), 128 + SIGINT);
    EXPECT_EQ(fileCount(), 1u) << "the scan alone";
  }
}

TEST_F(CheckByMouse, APatientThatNobodyCheckedIsCheckedFromTheStartScreen) {
  const std::string folder = dataFolder() + "/molar/patients";
  std::filesystem::create_directories(folder);
  assets::savePatient(tests::phantomPatient(tests::archPhantom({.spacing_mm = 0.8})), folder + "/mine", false);
  const PrivateScreen screen(kWindow_px);
  RunningProgram program(onScreen(screen) + " start");
  ScreenHand hand(screen);
  // Up to the first of the cases, which is the patient; until the window that answers is there.
  const auto until = std::chrono::steady_clock::now() + kLongestWait;
  while (!hand.sees("Molar: check") && std::chrono::steady_clock::now() < until) {
    hand.key(XK_Home);
    hand.key(XK_Return);
    std::this_thread::sleep_for(50ms);
  }
  ASSERT_TRUE(hears(program, "shown: 16 teeth"));
  EXPECT_EQ(leave(program, screen), 0);
}

}  // namespace
}  // namespace app
