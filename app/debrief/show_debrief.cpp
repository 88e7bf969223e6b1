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
#include "app/debrief/debrief_player.h"
#include "app/debrief/debrief_steering.h"
#include "app/instructor/instructor_panel.h"
#include "app/text/clock_text.h"
#include "app/text/elapsed.h"
#include "app/text/letters.h"
#include "app/text/message.h"
#include "app/view/renderer_choice.h"
#include "app/view/snapshot.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"
#include "render/gpu/gpu_error.h"
#include "render/gpu/graphics_card.h"
#include "render/gpu/window_image.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSaid_s = 3.0, kClipRate_Hz = 25.0;
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
  DebriefWindow(const DebriefPlan& plan, DebriefGuide* guide) : player_(plan), scene_(player_.scene()) {
    window_.emplace(render::Window::Options{
        .title = "Molar, debrief", .size_px = plan.size_px, .full_screen = plan.full_screen, .monitor = plan.monitor});
    if (!ImGui_ImplOpenGL3_Init("#version 450"))
      throw render::GpuError("debrief: OpenGL cannot draw its panel, use --headless");
    render::RenderOptions options;
    options.backend = rendererForWindow(plan.backend, printMessage);
    player_.open(options, options.backend == render::Backend::cpu || render::currentGraphicsCard().is_software);
    if (guide != nullptr) steering_.emplace(*guide, player_);
    state_.choice = plan.choice;
    scene_.runs().front()->addWords(plan.unsealed);
    updateRuns();
  }
  ~DebriefWindow() {
    window_->makeCurrent();
    ImGui_ImplOpenGL3_Shutdown();
  }
  DebriefWindow(const DebriefWindow&) = delete;
  DebriefWindow& operator=(const DebriefWindow&) = delete;

  int run() {
    Clock::time_point before = Clock::now();
    // Whoever steers it ends it; the display cannot.
    while (steering_ ? !steering_->isOver() : !closing_) {
      // What an event takes, a clip some minutes, is no time of the play.
      const Clock::time_point handled = Clock::now();
      takeEvents();
      if (steering_) steering_->take();
      before += Clock::now() - handled;
      const Clock::time_point now = Clock::now();
      const double passed_s = secondsBetween(std::exchange(before, now), now);
      if (player_.advance(passed_s)) updateRuns();
      draw(now, passed_s);
    }
    if (const std::string jumps = player_.jumpsText(); !jumps.empty()) std::puts(jumps.c_str());
    return 0;
  }

 private:
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
      if (moved->button == render::MouseButton::right) scene_.turn(moved->by_px), player_.changeView();
    } else if (const auto* button = std::get_if<render::ButtonPressed>(&event)) {
      io.MouseDown[button->button == render::MouseButton::right ? 1 : 0] = button->down;
    } else if (const auto* wheel = std::get_if<render::WheelTurned>(&event)) {
      scene_.magnify(wheel->notches > 0.0 ? 1 : -1), player_.changeView();
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
    Transport& transport = player_.transport();
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
    player_.transport().goToNext(times_s, direction);
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
        scene_.backToFirst(), player_.changeView();
        break;
      case DebriefAction::magnify:
        scene_.magnify(1), player_.changeView();
        break;
      case DebriefAction::shrink:
        scene_.magnify(-1), player_.changeView();
        break;
      default:
        break;
    }
  }

  void savePicture() {
    const std::string name = freeName(scene_.runs().front()->path(), player_.transport().position_s(), ".png");
    try {
      calibration::OutputFile file(name, false);
      savePng(player_.fullPicture(picturePx()), file);
      say("picture: " + name);
    } catch (const calibration::CalibrationError& refusal) {
      say(refusal.what());
    }
  }

  /// The window stands still meanwhile, and says how far it is.
  void saveClip() {
    const double from_s = state_.clip_from_s.value_or(0.0),
                 to_s = state_.clip_to_s.value_or(player_.transport().length_s());
    if (!state_.clip_from_s || !(to_s > from_s)) return say("mark the clip first: I at its start, O at its end");
    const std::string name = freeName(scene_.runs().front()->path(), from_s, "-clip");
    const auto count = static_cast<int>((to_s - from_s) * kClipRate_Hz) + 1;
    if (static_cast<std::size_t>(count) > kMostClipPictures)
      return say(fmt::format("a clip has at most {} pictures, {:.0f} min: mark a shorter part", kMostClipPictures,
                             static_cast<double>(kMostClipPictures) / kClipRate_Hz / 60.0));
    try {
      calibration::OutputFolder folder(name, false, {});
      for (int n = 0; n < count && !closing_; ++n) {
        const render::Image image = player_.fullPicture(picturePx(), from_s + n / kClipRate_Hz);
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

  void draw(Clock::time_point now, double passed_s) {
    const glm::ivec2 window_px = window_->framebufferSize_px();
    if (window_px.x <= 0 || window_px.y <= 0) return;
    if (!state_.said.empty() && secondsBetween(said_at_, now) > kSaid_s) state_.said.clear();
    const bool is_new = player_.draw(picturePx(), state_.choice);
    if (is_new) {
      const auto edges_mm = scene_.edges_mm();
      for (std::size_t n = 0; n < state_.runs.size(); ++n) state_.runs[n].edges_mm = edges_mm[n];
    }
    present(passed_s);
    player_.noteShown();
    if (steering_) steering_->tell(is_new);
    // Without a refresh to wait for, a core would be spent on nothing.
    if (!is_new && !player_.transport().isPlaying()) std::this_thread::sleep_for(kIdle);
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
    state_.transport = player_.transport();
    state_.prepared_share = player_.preparedShare();
    const DebriefPanelInput input = drawDebriefPanel(state_, window_px);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    window_->present();
    // Whoever drags elsewhere is not let go by a mouse that does nothing here.
    if (input.go_to_s || scrubs_) player_.setScrubbing(input.go_to_s.has_value());
    scrubs_ = input.go_to_s.has_value();
    if (input.go_to_s) player_.transport().goTo(*input.go_to_s);
    if (input.choice) state_.choice = *input.choice;
    if (input.plays) player_.transport().playOrPause();
  }

  PanelContext context_;
  std::optional<render::Window> window_;  // outlives what is drawn in its context
  DebriefPlayer player_;
  DebriefScene& scene_;
  std::optional<DebriefSteering> steering_;
  DebriefPanelState state_;
  Clock::time_point said_at_{};
  double note_s_ = 0.0;
  std::deque<render::WindowEvent> pending_;
  bool closing_ = false, skips_letter_ = false, scrubs_ = false;
};

}  // namespace

int showDebrief(const DebriefPlan& plan, DebriefGuide* guide) { return DebriefWindow(plan, guide).run(); }

}  // namespace app
