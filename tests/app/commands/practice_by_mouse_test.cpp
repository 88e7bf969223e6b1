// A whole practice calibration by a mouse alone: real events through an X server to the program in its window, as its
// pages ask for them, from the first page to the report. Nothing is timed: each step waits for what the program says.
#include <cmath>

#include "tests/app/commands/program.h"
#include "tests/app/commands/real_events.h"

#include "app/calibrate/stylus_source.h"
#include "calibration/fit/target_plan.h"
#include "calibration/geometry/units.h"
#include "calibration/rig.h"

namespace app {
namespace {

using namespace std::chrono_literals;

constexpr glm::ivec2 kScreen_px{1920, 1080}, kMiddle_px = kScreen_px / 2;
/// Longer than a busy machine needs between two lines; ends a test that hangs.
constexpr auto kPatience = 60s;
/// A press that had no answer is made again.
constexpr auto kAgain = 3s;

/// Reads the pages' lines and has a mouse with three buttons and a wheel.
class Practiser {
 public:
  Practiser(RunningProgram& program, ScreenHand& hand) : program_(program), hand_(hand) {}

  /// Until the program ends or says nothing more.
  void practise() {
    auto heard_at = std::chrono::steady_clock::now();
    while (!program_.hasEnded() && std::chrono::steady_clock::now() - heard_at < kPatience) {
      const auto line = program_.nextLine(kAgain);
      if (line) {
        heard_at = std::chrono::steady_clock::now();
        hear(*line);
      } else if (is_refused_ || !choice_.empty()) {
        answer();
      }
    }
  }

  const std::string& heard() const { return heard_; }
  int pits() const { return pits_; }

 private:
  void hear(const std::string& line) {
    heard_ += line + "\n";
    const auto said = [&](const char* head) {
      const std::string whole = std::string("molar: ") + head + ": ";
      return line.starts_with(whole) ? std::optional(line.substr(whole.size())) : std::nullopt;
    };
    if (const auto page = said("page")) {
      turnedTo(*page);
    } else if (const auto choice = said("choice")) {
      choice_ = *choice;
      answer();
    } else if (const auto next = said("next")) {
      choice_.clear(), is_refused_ = false;
      touch(static_cast<std::size_t>(std::stoi(*next)) - 1);
    } else if (const auto message = said("said")) {
      pits_ += message->starts_with("Taken: pit") ? 1 : 0;
      is_refused_ = message->find("Press again") != std::string::npos;
    }
  }

  void turnedTo(const std::string& page) {
    release();
    choice_.clear(), is_refused_ = false;
    const struct { const char *title, *method; } kRounds[] = {{"Touch the pits", "jig8"}, {"Verify", "verify8"}};
    for (const auto& round : kRounds)
      if (page.starts_with(round.title)) targets_ = calibration::targetPlan(round.method)->targets;
    if (page.starts_with("Crosses in depth"))
      targets_ = {{1, {{-35.0, 20.0, 25.0}}, calibration::kRestingStylus_W},
                  {2, {{35.0, 20.0, -25.0}}, calibration::kRestingStylus_W},
                  {3, {{35.0, -20.0, 25.0}}, calibration::kRestingStylus_W},
                  {4, {{-35.0, -20.0, -25.0}}, calibration::kRestingStylus_W}};
    if (page.find("Push the stylus into") != std::string::npos || page.find("Take the stylus out") != std::string::npos)
      hand_.click(ScreenHand::middle);
  }

  /// A short press marks the next choice or takes a touch, a held one chooses.
  void answer() {
    release();
    bool is_wanted = false;
    for (const char* good : {"all correct", "yes", "confirm", "go on", "take it", "done"})
      is_wanted = is_wanted || choice_.starts_with(good);
    hand_.press(ScreenHand::right, true);
    is_held_ = is_wanted && !is_refused_;
    if (!is_held_) hand_.press(ScreenHand::right, false);
  }
  void release() {
    if (is_held_) hand_.press(ScreenHand::right, false);
    is_held_ = false;
  }

  /// To the target and held still there, which takes it.
  void touch(std::size_t n) {
    release();
    ASSERT_LT(n, targets_.size()) << heard_;
    const calibration::Target& target = targets_[n];
    const calibration::Rig desk = calibration::desktopRig(kScreen_px);
    const glm::dvec3 by_mm = target.position_W.mm - tip_W_mm_;
    const double px_mm = glm::distance(desk.screen.lower_right.mm, desk.screen.lower_left.mm) / kScreen_px.x;
    const glm::ivec2 by_px{std::lround(by_mm.x / px_mm), std::lround(-by_mm.y / px_mm)};
    hand_.drag(ScreenHand::left, kMiddle_px, by_px);
    const auto notches = static_cast<int>(std::lround(-by_mm.z));
    for (int i = 0; i < std::abs(notches); ++i)
      hand_.click(notches > 0 ? ScreenHand::wheel_up : ScreenHand::wheel_down);
    tip_W_mm_ += glm::dvec3(px_mm * by_px.x, -px_mm * by_px.y, -notches);
    for (int i = 0; i < 8; ++i) tiltTowards(target.stylus_W.xyz);
  }

  /// Two rotations at a time converge for leaning styluses.
  void tiltTowards(const glm::dvec3& wanted) {
    const double px_rad = calibration::radFromDegrees(0.3);
    const auto px = [&](double angle_rad) { return static_cast<int>(std::lround(angle_rad / px_rad)); };
    const int yaw_px = px(std::atan2(wanted.x, wanted.z) - std::atan2(along_W_.x, along_W_.z));
    const glm::dvec3 turned = glm::angleAxis(px_rad * yaw_px, glm::dvec3(0, 1, 0)) * along_W_;
    const int pitch_px = px(std::atan2(turned.y, turned.z) - std::atan2(wanted.y, wanted.z));
    along_W_ = glm::angleAxis(px_rad * pitch_px, glm::dvec3(1, 0, 0)) * turned;
    // A middle click without a drag would put it into the inkwell.
    if (yaw_px != 0 || pitch_px != 0) hand_.drag(ScreenHand::middle, kMiddle_px, {yaw_px, pitch_px});
  }

  RunningProgram& program_;
  ScreenHand& hand_;
  std::vector<calibration::Target> targets_;
  glm::dvec3 tip_W_mm_ = kPracticeStart_mm, along_W_ = calibration::kRestingStylus_W.xyz;
  std::string heard_, choice_;
  bool is_refused_ = false, is_held_ = false;
  int pits_ = 0;
};

using PracticeByMouse = ProgramTest;

TEST_F(PracticeByMouse, LeadsFromTheFirstPageThroughAllPitsToTheReport) {
  PrivateScreen screen(kScreen_px);
  ScreenHand hand(screen);
  hand.moveTo(kMiddle_px);
  RunningProgram program("DISPLAY=" + screen.name() + " " + MOLAR_PROGRAM +
                         " calibrate collect --device practice:D:7 --method jig8 --windowed --quiet --verbose --keep "
                         "--observations " +
                         at("touches.yaml"));
  Practiser person(program, hand);
  person.practise();
  const int status = program.exitStatus();
  EXPECT_EQ(status, 0) << person.heard();
  EXPECT_EQ(person.pits(), 8 + 16) << "those of the fit and those held back\n" << person.heard();

  std::string rig;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dataFolder()))
    if (entry.path().filename().string().ends_with("Z.yaml")) rig = entry.path().string();
  ASSERT_FALSE(rig.empty()) << person.heard();
  const ProgramOutput report = molar("calibrate report " + rig + " --out " + at("report.html"));
  EXPECT_EQ(report.status, 0) << report.err;
  EXPECT_NE(read("report.html").find("jig8"), std::string::npos);
  EXPECT_NE(read("touches.yaml").find("jig8"), std::string::npos);
}

}  // namespace
}  // namespace app
