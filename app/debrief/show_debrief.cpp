#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "app/debrief/debrief_keys.h"
#include "app/debrief/debrief_panel.h"
#include "app/debrief/debrief_plan.h"
#include "app/debrief/debrief_scene.h"
#include "app/debrief/debrief_voice.h"
#include "app/instructor/instructor_panel.h"
#include "app/text/clock_text.h"
#include "app/text/elapsed.h"
#include "app/text/letters.h"
#include "app/text/message.h"
#include "app/view/renderer_choice.h"
#include "app/view/snapshot.h"
#include "assets/load_error.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"
#include "render/gpu/window_image.h"
#include "render/quality_ladder.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSaid_s = 3.0, kStill_s = 0.25, kClipRate_Hz = 25.0;
constexpr double kPrepareFor_s = 0.15;  ///< wall time between two drawings
constexpr double kPart_s = 0.2;         ///< of the session
constexpr glm::ivec2 kLeastPicture_px{64, 64};
constexpr std::chrono::milliseconds kIdle{12};

/// A free name beside the session: "NAME 0m12.5s.png".
std::string freeName(const std::string& session, double t_s, const std::string& ending) {
  std::filesystem::path path(session);
  const std::string stem = (path.parent_path() / path.stem()).string() +
                           fmt::format("-{:.0f}m{:04.1f}s", std::floor(t_s / 60.0), std::fmod(t_s, 60.0));
  for (int n = 1;; ++n) {
    std::string name = stem + (n > 1 ? fmt::format("-{}", n) : "") + ending;
    if (!std::filesystem::exists(name)) return name;
  }
}

class DebriefWindow {
 public:
  explicit DebriefWindow(const DebriefPlan& plan) : scene_(plan) {
    window_.emplace(render::Window::Options{.title = "Molar, debrief", .size_px = plan.size_px});
    if (!ImGui_ImplOpenGL3_Init("#version 450"))
      throw render::GpuError("debrief: OpenGL cannot draw its panel, use --headless");
    render::RenderOptions options;
    options.backend = rendererForWindow(plan.backend, printMessage);
    on_processor_ = options.backend == render::Backend::cpu || render::currentGraphicsCard().is_software;
    scene_.open(options);
    ladder_.emplace(1.0 / 20.0, on_processor_ ? static_cast<int>(render::kQualitySteps.size()) - 1 : 0);
    state_.transport.setLength(scene_.length_s());
    state_.choice = plan.choice;
    first_s_ = plan.at_s;
    updateRuns();
  }
  ~DebriefWindow() {
    window_->makeCurrent();
    ImGui_ImplOpenGL3_Shutdown();
  }
  DebriefWindow(const DebriefWindow&) = delete;
  DebriefWindow& operator=(const DebriefWindow&) = delete;

  int run() {
    const Clock::time_point begun = Clock::now();
    Clock::time_point before = begun;
    while (!closing_) {
      // What an event takes, a clip some minutes, is no time of the play.
      const Clock::time_point handled = Clock::now();
      takeEvents();
      before += Clock::now() - handled;
      const Clock::time_point now = Clock::now();
      const double passed_s = secondsBetween(std::exchange(before, now), now);
      if (!scene_.isPrepared())
        prepare(begun);
      else
        state_.transport.advance(passed_s);
      followVoice();
      draw(now, passed_s);
    }
    tellJumps();
    return 0;
  }

 private:
  void prepare(Clock::time_point begun) {
    const Clock::time_point from = Clock::now();
    while (secondsBetween(from, Clock::now()) < kPrepareFor_s && scene_.prepare(kPart_s)) {
    }
    state_.prepared_share = scene_.isPrepared() ? 1.0 : std::min(0.999, scene_.preparedShare());
    if (!scene_.isPrepared()) return;
    std::size_t bytes = 0, keyframes = 0;
    for (const auto& run : scene_.runs()) {
      bytes += run->moments().bytes(), keyframes += run->moments().keyframes();
      for (const std::string& remark : run->remarks()) printMessage(run->name() + ": " + remark);
    }
    printMessage(fmt::format("run again in {:.1f} s: {} keyframes, {:.0f} MB", secondsBetween(begun, Clock::now()),
                             keyframes, static_cast<double>(bytes) / 1e6));
    state_.transport.setLength(scene_.length_s());
    state_.transport.goTo(first_s_);
    openVoice();
    shown_.reset();
    updateRuns();
  }

  /// Of the first session.
  void openVoice() {
    const DebriefRun& run = *scene_.runs().front();
    try {
      voice_.emplace(run.path(), run.moments().start().dt_s);
    } catch (const assets::LoadError& damage) {
      printMessage(damage.what());
    }
  }
  void followVoice() {
    const Transport& transport = state_.transport;
    if (voice_)
      voice_->follow(transport.position_s(),
                     transport.isPlaying() && !transport.isBackwards() && transport.speed() == 1.0);
  }

  void updateRuns() {
    state_.runs.clear();
    for (const auto& run : scene_.runs()) {
      run->bookmarks();
      state_.runs.push_back(
          {run->name(), run->length_s(), run->marks(), run->story().samples(), run->story().mostForce_N(), {}});
    }
  }

  void say(const std::string& line) { state_.said = line, said_at_ = Clock::now(); }

  /// A click between two drawings still counts: its release waits for the next one.
  void takeEvents() {
    for (const render::WindowEvent& event : window_->takeEvents()) pending_.push_back(event);
    bool pressed = false;
    while (!pending_.empty()) {
      const auto* button = std::get_if<render::ButtonPressed>(&pending_.front());
      if (button != nullptr && !button->down && pressed) return;
      pressed = pressed || (button != nullptr && button->down);
      take(pending_.front());
      pending_.pop_front();
    }
  }

  void take(const render::WindowEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    if (const auto* moved = std::get_if<render::PointerMoved>(&event)) {
      io.MousePos = {static_cast<float>(moved->to_px.x), static_cast<float>(moved->to_px.y)};
      if (moved->button == render::MouseButton::right) scene_.turn(moved->by_px), view_changed_ = true;
    } else if (const auto* button = std::get_if<render::ButtonPressed>(&event)) {
      io.MouseDown[button->button == render::MouseButton::right ? 1 : 0] = button->down;
    } else if (const auto* wheel = std::get_if<render::WheelTurned>(&event)) {
      scene_.magnify(wheel->notches > 0.0 ? 1 : -1), view_changed_ = true;
    } else if (const auto* typed = std::get_if<render::LetterTyped>(&event)) {
      if (state_.note && !std::exchange(skips_letter_, false)) addLetter(*state_.note, typed->letter);
    } else if (const auto* key = std::get_if<render::KeyPressed>(&event)) {
      state_.note ? writeNote(*key) : act(*key);
    } else if (std::holds_alternative<render::CloseRequested>(event)) {
      closing_ = true;
    }
  }

  void writeNote(const render::KeyPressed& key) {
    if (!key.down) return;
    if (key.key == render::Key::backspace) removeLetter(*state_.note);
    if (key.key == render::Key::escape) state_.note.reset();
    if (key.key == render::Key::enter) keepBookmark(*std::exchange(state_.note, std::nullopt));
  }

  void keepBookmark(const std::string& note) {
    Bookmarks& bookmarks = scene_.runs().front()->bookmarks();
    if (!bookmarks.set(note_s_, note)) return say("there are as many bookmarks as a session can have");
    saveBookmarks(bookmarks, "bookmark kept");
  }

  void saveBookmarks(const Bookmarks& bookmarks, const std::string& done) {
    try {
      bookmarks.save();
      say(done);
    } catch (const calibration::CalibrationError& refusal) {
      say(refusal.what());
    }
    updateRuns();
  }

  void act(const render::KeyPressed& key) {
    const auto action = actionOf(key);
    if (!action) return;
    if (*action == DebriefAction::close) {
      if (!std::exchange(state_.keys_shown, false)) closing_ = true;
      return;
    }
    if (*action == DebriefAction::keys) {
      state_.keys_shown = !state_.keys_shown;
      return;
    }
    if (scene_.isPrepared() && actOnTime(*action)) return;
    actOnPicture(*action);
  }

  bool actOnTime(DebriefAction action) {
    constexpr double kLittle_s = 1.0, kFar_s = 10.0;
    Transport& transport = state_.transport;
    switch (action) {
      case DebriefAction::play:
        transport.playOrPause();
        break;
      case DebriefAction::back_little:
        transport.jump(-kLittle_s);
        break;
      case DebriefAction::on_little:
        transport.jump(kLittle_s);
        break;
      case DebriefAction::back_far:
        transport.jump(-kFar_s);
        break;
      case DebriefAction::on_far:
        transport.jump(kFar_s);
        break;
      case DebriefAction::shuttle_back:
        transport.shuttle(-1);
        break;
      case DebriefAction::shuttle_stop:
        transport.pause();
        break;
      case DebriefAction::shuttle_on:
        transport.shuttle(1);
        break;
      case DebriefAction::faster:
        transport.changeSpeed(1);
        break;
      case DebriefAction::slower:
        transport.changeSpeed(-1);
        break;
      case DebriefAction::to_start:
        transport.goTo(0.0);
        break;
      case DebriefAction::to_end:
        transport.goTo(transport.length_s());
        break;
      case DebriefAction::next_mark:
        goToMark(1);
        break;
      case DebriefAction::former_mark:
        goToMark(-1);
        break;
      case DebriefAction::bookmark:
        transport.pause();
        note_s_ = transport.position_s();
        state_.note.emplace();
        skips_letter_ = true;  // the key's own
        break;
      case DebriefAction::remove_bookmark:
        if (scene_.runs().front()->bookmarks().removeAt(transport.position_s()))
          saveBookmarks(scene_.runs().front()->bookmarks(), "bookmark removed");
        else
          say("no bookmark is here: N goes to the next mark");
        break;
      case DebriefAction::clip_from:
        state_.clip_from_s = transport.position_s();
        break;
      case DebriefAction::clip_to:
        state_.clip_to_s = transport.position_s();
        break;
      case DebriefAction::save_clip:
        saveClip();
        break;
      case DebriefAction::picture:
        savePicture();
        break;
      default:
        return false;
    }
    return true;
  }

  void goToMark(int direction) {
    std::vector<double> times_s;
    for (const SessionMark& mark : state_.runs.front().marks) times_s.push_back(mark.t_s);
    state_.transport.goToNext(times_s, direction);
  }

  void actOnPicture(DebriefAction action) {
    PictureChoice& choice = state_.choice;
    switch (action) {
      case DebriefAction::trail:
        choice.trail = static_cast<TrailColour>((static_cast<int>(choice.trail) + 1) % 3);
        break;
      case DebriefAction::ghost:
        choice.layers.ghost_tool = !choice.layers.ghost_tool;
        break;
      case DebriefAction::other_ghost:
        if (scene_.runs().size() < 2) return say("there is no other session: molar debrief S S2");
        choice.other_ghost = !choice.other_ghost;
        say(choice.other_ghost ? "ghost: the other session's tool" : "no ghost of the other session");
        break;
      case DebriefAction::edges:
        choice.edges = !choice.edges;
        break;
      case DebriefAction::line:
        choice.has_line = !choice.has_line;
        break;
      case DebriefAction::first_view:
        scene_.backToFirst(), view_changed_ = true;
        break;
      case DebriefAction::magnify:
        scene_.magnify(1), view_changed_ = true;
        break;
      case DebriefAction::shrink:
        scene_.magnify(-1), view_changed_ = true;
        break;
      default:
        break;
    }
  }

  /// What is shown, at full quality.
  render::Image fullPicture() {
    scene_.draw(picturePx(), render::kQualitySteps.front().quality);
    shown_.reset();
    return scene_.image();
  }

  void savePicture() {
    scene_.goTo(state_.transport.position_s());  // a dragging hand left it at a keyframe
    const std::string name = freeName(scene_.runs().front()->path(), state_.transport.position_s(), ".png");
    try {
      calibration::OutputFile file(name, false);
      savePng(fullPicture(), file);
      say("picture: " + name);
    } catch (const calibration::CalibrationError& refusal) {
      say(refusal.what());
    }
  }

  /// The window stands still meanwhile, and says how far it is.
  void saveClip() {
    const double from_s = state_.clip_from_s.value_or(0.0),
                 to_s = state_.clip_to_s.value_or(state_.transport.length_s());
    if (!state_.clip_from_s || !(to_s > from_s)) return say("mark the clip first: I at its start, O at its end");
    const std::string name = freeName(scene_.runs().front()->path(), from_s, "-clip");
    const auto count = static_cast<int>((to_s - from_s) * kClipRate_Hz) + 1;
    if (static_cast<std::size_t>(count) > kMostClipPictures)
      return say(fmt::format("a clip has at most {} pictures, {:.0f} min: mark a shorter part", kMostClipPictures,
                             static_cast<double>(kMostClipPictures) / kClipRate_Hz / 60.0));
    try {
      calibration::OutputFolder folder(name, false, {});
      for (int n = 0; n < count && !closing_; ++n) {
        scene_.goTo(from_s + n / kClipRate_Hz);
        const render::Image image = fullPicture();
        calibration::writePng(fmt::format("{}/frame_{:05}.png", folder.temporaryPath(), n), {image.w, image.h},
                              image.rgba);
        say(fmt::format("clip: {} of {} pictures", n + 1, count));
        present(0.1);
        // What is pressed meanwhile does nothing, but what is let go is let go.
        for (const render::WindowEvent& event : window_->takeEvents()) {
          const auto* const button = std::get_if<render::ButtonPressed>(&event);
          if (std::holds_alternative<render::CloseRequested>(event) || (button != nullptr && !button->down))
            take(event);
        }
      }
      if (closing_) return;
      folder.commit();
      say(fmt::format("{} pictures, 25 a second: {}", count, name));
    } catch (const calibration::CalibrationError& refusal) {
      say(refusal.what());
    }
  }

  glm::ivec2 picturePx() const {
    const glm::ivec2 window_px = window_->framebufferSize_px();
    return glm::max(kLeastPicture_px,
                    window_px - glm::ivec2(0, kDebriefHeader_px + debriefPanelHeight_px(state_.runs.size())));
  }

  struct Shown {
    double position_s = -1.0, prepared_share = -1.0;
    glm::ivec2 px{0};
    PictureChoice choice;
    bool is_refined = false, is_near = false;  ///< at full quality; of a moment beside it
  };

  void draw(Clock::time_point now, double passed_s) {
    const glm::ivec2 window_px = window_->framebufferSize_px();
    if (window_px.x <= 0 || window_px.y <= 0) return;
    if (!state_.said.empty() && secondsBetween(said_at_, now) > kSaid_s) state_.said.clear();
    const bool is_new = drawPictures(now);
    present(passed_s);
    // Without a refresh to wait for, a core would be spent on nothing.
    if (!is_new && !state_.transport.isPlaying()) std::this_thread::sleep_for(kIdle);
    if (jump_at_) jumps_ms_.push_back(1e3 * secondsBetween(*std::exchange(jump_at_, std::nullopt), Clock::now()));
  }

  /// Only when something has changed; roughly where it jumps, better when nothing has changed for a while. False: the
  /// picture was kept.
  bool drawPictures(Clock::time_point now) {
    const glm::ivec2 px = picturePx();
    const double position_s = state_.transport.position_s();
    const bool is_same = shown_ && shown_->position_s == position_s && shown_->px == px &&
                         shown_->choice == state_.choice && !view_changed_ &&
                         (scene_.isPrepared() || now - drawn_at_ < std::chrono::seconds(2));
    if (is_same && (shown_->is_refined || secondsBetween(drawn_at_, now) < kStill_s)) return false;
    // A hand on the time line is followed at once and roughly; where it rests comes the moment itself.
    if (is_same && scrubs_ && !shown_->is_near) return false;
    const bool jumps = !is_same && shown_ && !state_.transport.isPlaying() && shown_->position_s != position_s;
    const bool is_near = scrubs_ && !is_same, refines = is_same && !scrubs_ && scene_.isPrepared();
    if (scene_.isPrepared() && (!refines || shown_->is_near)) {
      if (jumps) jump_at_ = now;
      is_near ? scene_.goNear(position_s) : scene_.goTo(position_s);
    }
    scene_.choice = state_.choice;
    const Clock::time_point begun = Clock::now();
    const bool is_rough = on_processor_ && (is_near || jumps);
    const auto look = refines                                               ? DebriefRun::Look::now
                      : state_.transport.isPlaying() && scene_.isPrepared() ? DebriefRun::Look::each_second
                                                                            : DebriefRun::Look::never;
    scene_.draw(px,
                refines    ? render::kQualitySteps.front().quality
                : is_rough ? kScrubQuality
                           : ladder_->quality(),
                look);
    const auto edges_mm = scene_.edges_mm();
    for (std::size_t n = 0; n < state_.runs.size(); ++n) state_.runs[n].edges_mm = edges_mm[n];
    if (!refines && !is_near && !is_rough) ladder_->add(secondsBetween(begun, Clock::now()), true);
    shown_ = Shown{position_s, state_.prepared_share, px, state_.choice, refines, is_near};
    view_changed_ = false;
    drawn_at_ = Clock::now();
    return true;
  }

  void present(double passed_s) {
    const glm::ivec2 window_px = window_->framebufferSize_px();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = static_cast<float>(std::clamp(passed_s, 1e-3, 1.0));
    io.DisplaySize = {static_cast<float>(window_px.x), static_cast<float>(window_px.y)};
    render::clearWindow();
    scene_.showOnWindow({0, kDebriefHeader_px}, window_px);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    const DebriefPanelInput input = drawDebriefPanel(state_, window_px);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    window_->present();
    scrubs_ = input.go_to_s.has_value();
    if (input.go_to_s) state_.transport.goTo(*input.go_to_s);
    if (input.choice) state_.choice = *input.choice;
    if (input.plays) state_.transport.playOrPause();
  }

  void tellJumps() {
    if (jumps_ms_.empty()) return;
    std::ranges::sort(jumps_ms_);
    std::printf("%zu jumps: median %.0f ms, longest %.0f ms until shown\n", jumps_ms_.size(),
                jumps_ms_[jumps_ms_.size() / 2], jumps_ms_.back());
  }

  PanelContext context_;
  std::optional<render::Window> window_;  // outlives what is drawn in its context
  DebriefScene scene_;
  bool on_processor_ = false;
  std::optional<render::QualityLadder> ladder_;
  DebriefPanelState state_;
  std::optional<DebriefVoice> voice_;
  std::optional<Shown> shown_;
  Clock::time_point drawn_at_{}, said_at_{};
  std::optional<Clock::time_point> jump_at_;
  std::vector<double> jumps_ms_;
  double first_s_ = 0.0, note_s_ = 0.0;
  std::deque<render::WindowEvent> pending_;
  bool view_changed_ = false, closing_ = false, skips_letter_ = false, scrubs_ = false;
};

}  // namespace

int showDebrief(const DebriefPlan& plan) { return DebriefWindow(plan).run(); }

}  // namespace app
