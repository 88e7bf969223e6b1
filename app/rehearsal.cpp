#include "app/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <span>
#include <utility>

#include "app/brick_upload.h"
#include "app/command_desk.h"
#include "app/dressed_renderer.h"
#include "app/emergency_exit.h"
#include "app/hand_input.h"
#include "app/motion_to_photon.h"
#include "app/operator_seat.h"
#include "app/quality_choice.h"
#include "app/rehearsal_status.h"
#include "app/rehearsal_summary.h"
#include "app/snapshot.h"
#include "app/surgeon_display.h"
#include "app/tool_text.h"
#include "app/trip_teller.h"
#include "app/unplug_watch.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kBurTurnsPerSecond = 7.0;  ///< as drawn: a real bur turns too fast for any display to show
constexpr int kSnapshotSamples = 2;
constexpr double kLongestSilence_s = 10.0;
constexpr double kStatusEvery_s = 0.5, kLatencyNotedEvery_s = 5.0;

volatile std::sig_atomic_t interrupted = 0;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}
double secondsSince(Clock::time_point start) { return secondsBetween(start, Clock::now()); }

double width_mm(const calibration::ScreenCorners& screen) {
  return glm::distance(screen.lower_left.mm, screen.lower_right.mm);
}

SurgeonDisplay::Options displayOf(const RehearsalPlan& plan) {
  return {.windows = {.mode = plan.display,
                      .screen_px = plan.rig.screen.px,
                      .full_screen = plan.full_screen,
                      .monitor = plan.monitor},
          .eyes_swapped = plan.eyes_swapped,
          .backend = plan.backend,
          .headless = plan.headless,
          .needs_window = plan.device == "mouse"};
}

Wish wishOf(haptics::HandAction action) {
  if (action == haptics::HandAction::irrigation) return Wish::irrigation_switch;
  return action == haptics::HandAction::undo ? Wish::undo : Wish::tool_change;
}

/// One rehearsal from the first frame on.
class Rehearsal {
 public:
  explicit Rehearsal(RehearsalPlan plan)
      : plan_(std::move(plan)),
        hand_(handAtWork(plan_.device, plan_.device_options, plan_.patient, plan_.rig,
                         plan_.command.tool.head.radius_mm, std::move(plan_.opened))),
        rate_Hz_(plan_.rate_Hz.value_or(hand_.rate_Hz.value_or(1000.0))),
        duration_s_(plan_.seconds ? plan_.seconds : hand_.duration_s),
        input_(restingTool()),
        desk_(plan_.command, plan_.other_tools, plan_.parameters, hand_.device->capabilities().damping_Ns_per_mm,
              rate_Hz_) {
    if (plan_.recording) plan_.recording->calibration = plan_.calibration;
    // Every output is claimed before any work.
    if (!plan_.snapshot.empty()) closing_pictures_.emplace(plan_.snapshot, plan_.overwrite);
    if (!plan_.first_snapshot.empty()) first_pictures_.emplace(plan_.first_snapshot, plan_.overwrite);
    frame_ = plan_.first_frame;
    frame_.rig = plan_.rig;
    outlineBur();
    frame_.face_window_mm = plan_.face_window_mm;
    frame_.site_P = {plan_.patient.site.third_molar_P_mm};
    frame_.tool_visible = false;
    frame_.X_PT.translation_mm = frame_.site_P.mm;
    if (!plan_.second_hand.device.empty())
      second_hand_.emplace(plan_.second_hand, plan_.device_options, plan_.patient, plan_.rig);
    display_.emplace(
        displayOf(plan_), [this](render::Backend backend) { return newRenderer(backend); },
        [this](const std::string& line) { tell(line); });
    quality_.emplace(*display_, plan_.quality_step);
    if (quality_->rules()) frame_.quality = quality_->quality();
    latency_.emplace(display_->refresh_Hz(), rate_Hz_);
    if (plan_.pedal) pedal_.emplace(*plan_.pedal);
    workstation_.emplace(plan_.patient, std::move(hand_.device),
                         haptics::LoopSettings{.rate_Hz = rate_Hz_,
                                               .X_PD = hand_.X_PD,
                                               .X_HT = hand_.X_HT,
                                               .arm = hand_.arm,
                                               .buttons = {},
                                               .pedal = pedal_ ? &*pedal_ : nullptr},
                         desk_.inForce(), plan_.recording);
    desk_.serve(*workstation_);
    if (plan_.operators_window)
      operator_.emplace(*display_, plan_.rig, plan_.monitor.value_or(0),
                        [this](const std::string& line) { tell(line); });
  }

  void run() {
    for (const std::string& remark : plan_.remarks) std::fprintf(stderr, "molar: %s\n", remark.c_str());
    drawFrame();
    first_picture_s_ = secondsSince(plan_.begun);
    // Before the hand is there: so many pictures as tell what this machine can.
    quality_->settle([this](const render::Quality& quality) {
      frame_.quality = quality;
      drawFrame();
    });
    if (quality_->rules()) frame_.quality = quality_->quality();
    if (first_pictures_) takePictures(*first_pictures_, plan_.patient.ct.solid);
    workstation_->start();
    if (hand_.library) unplug_watch_.emplace(*workstation_);
    workstation_->note("start", hand_.name);
    for (const std::string& remark : plan_.remarks) workstation_->note("calibration", remark);
    if (second_hand_) second_hand_->start(), workstation_->note("second hand", second_hand_->name());
    for (const std::string& line : told_early_) workstation_->note("display", line);
    noteQuality();
    looping_since_ = Clock::now();
    while (!isOver()) {
      takeInput();
      desk_.lookAtFile();
      followGuide();
      if (desk_.takeOtherBur()) showBur();
      // Nothing is on its way any more: the pose read now is the newest that can be seen.
      waitForDisplay();
      followServo();
      drawFrame();
      chooseQuality();
      showStatus();
      serveOperator();
    }
    loop_s_ = secondsSince(looping_since_);
    finish();
  }

 private:
  /// In the current context, from the bone as it is.
  std::unique_ptr<render::FrameRenderer> newRenderer(render::Backend backend) {
    auto renderer = dressedRenderer(plan_.patient, desk_.inForce().tool, plan_.patient.ct.solid, {.backend = backend});
    if (second_hand_) second_hand_->dress(*renderer);
    if (workstation_) upload_.bringAgain(workstation_->bone(), *renderer);
    return renderer;
  }

  /// While the surgeon's picture is on its way.
  void serveOperator() {
    if (!operator_) return;
    operator_->keepOpen();
    if (!operator_->isDue()) return;
    const OperatorSeat::Heard heard = operator_->serve(status());
    for (const render::WindowEvent& event : heard.keys)
      if (!isForGuide(event)) input_.take(event, 0.0);
    obey(heard.wishes);
  }

  void obey(const OperatorWishes& wishes) {
    if (wishes.layers) frame_.layers = *wishes.layers;
    if (wishes.snapshot) takeWindowSnapshot();
    if (wishes.end) ended_by_user_ = true;
    if (wishes.stop_motors) stopMotors();
    if (wishes.arm_again) desk_.armAgain();
    if (plan_.guide) return;
    if (wishes.drill_switch) desk_.switchDrill();
    if (wishes.law) desk_.switchLaw(*wishes.law);
  }

  /// For the person and, as soon as there is one, for the recording.
  void tell(const std::string& line) {
    std::fprintf(stderr, "molar: %s\n", line.c_str());
    if (workstation_)
      workstation_->note("display", line);
    else
      told_early_.push_back(line);
  }

  bool isOver() {
    const double t_s = newest_.t_s + newest_.dt_s;
    return interrupted || ended_by_user_ || (plan_.guide && plan_.guide->isOver()) ||
           (duration_s_ && t_s >= *duration_s_) || isSilent();
  }

  /// A device that does not tick any more ends nothing by itself.
  bool isSilent() {
    if (newest_.index != index_seen_ || ticked_at_ == Clock::time_point{}) ticked_at_ = Clock::now();
    index_seen_ = newest_.index;
    if (secondsSince(ticked_at_) < kLongestSilence_s) return false;
    tell("the device has not ticked for 10 s, so the rehearsal ends; check its cable and driver");
    return true;
  }

  void takeInput() {
    if (const render::Window* const window = display_->window()) {
      const double mm_per_px = width_mm(plan_.rig.screen) / std::max(1, window->framebufferSize_px().x);
      for (const render::WindowEvent& event : display_->takeEvents())
        if (!isForGuide(event)) input_.take(event, mm_per_px);
    }
    if (hand_.mouse) hand_.mouse->setTarget({{input_.X_WT().rotation, input_.X_WT().translation_mm}, input_.pedal()});
    for (const haptics::HandAction action : workstation_->takeActions()) obey(wishOf(action));
    for (const KeyWish& wish : input_.takeWishes()) {
      if (const auto* law = std::get_if<LawWish>(&wish)) {
        if (!plan_.guide && law->number < static_cast<int>(haptics::kLaws.size()))
          desk_.switchLaw(haptics::kLaws[static_cast<std::size_t>(law->number)].kind);
      } else {
        obey(std::get<Wish>(wish));
      }
    }
  }

  /// Under a guide, what is felt is the guide's.
  void obey(Wish wish) {
    if (wish == Wish::end) ended_by_user_ = true;
    if (wish == Wish::snapshot) takeWindowSnapshot();
    if (wish == Wish::emergency_stop) stopMotors();
    if (wish == Wish::arm_again) desk_.armAgain();
    if (wish == Wish::set_home) workstation_->setHome();
    if (plan_.guide) return;
    if (wish == Wish::drill_switch) desk_.switchDrill();
    if (wish == Wish::tool_change) desk_.changeTool();
    if (wish == Wish::irrigation_switch) desk_.switchIrrigation();
    if (wish == Wish::undo) desk_.undoStroke();
  }

  void stopMotors() {
    workstation_->emergencyStop();
    workstation_->note("emergency stop", "motors off for good");
    std::fprintf(stderr, "molar: emergency stop: the motors are off; end and start again to feel\n");
  }

  bool isForGuide(const render::WindowEvent& event) const {
    const auto* key = std::get_if<render::KeyPressed>(&event);
    if (!plan_.guide || !key || !key->down || key->repeated) return false;
    const int code = static_cast<int>(key->key);
    return code > ' ' && code <= 'Z' && plan_.guide->press(static_cast<char>(code));
  }

  void followGuide() {
    if (!plan_.guide) return;
    if (const auto wanted = plan_.guide->follow(newest_)) desk_.obey(*wanted);
  }

  void outlineBur() {
    const haptics::BurShape& head = desk_.inForce().tool.head;
    frame_.bur_radius_mm = head.radius_mm;
    frame_.bur_length_mm = head.length_mm;
    frame_.bur_form = static_cast<assets::BurForm>(head.kind);
  }

  void showBur() {
    outlineBur();
    showInstrument(display_->renderer(), desk_.inForce().tool);
  }

  void waitForDisplay() {
    display_->waitUntilShown();
    if (display_->window() != nullptr && pose_read_ != Clock::time_point{})
      latency_->add(secondsBetween(pose_read_, display_->handedOver()));
  }

  /// The tick first, then the bricks: what that tick cut is in this very frame.
  void followServo() {
    pose_read_ = Clock::now();
    newest_ = workstation_->newestTick();
    frame_.tool_visible = newest_.dt_s > 0.0;
    // The servo holds the bur where it last believed the hand; so does the picture.
    if (!haptics::has(newest_.faults, haptics::Fault::bad_pose)) frame_.X_PT.rotation = newest_.hand.X_PT.rotation;
    frame_.X_PT.translation_mm = newest_.proxy_P.mm;
    frame_.X_PT_at_hand = {frame_.X_PT.rotation, newest_.hand.X_PT.translation_mm};
    if (newest_.drilling)
      frame_.bur_angle_rad = std::fmod(newest_.t_s * kBurTurnsPerSecond, 1.0) * 2.0 * calibration::kPi;
    if (second_hand_) second_hand_->place(frame_);
    upload_.bring(workstation_->bone(), display_->renderer());
  }

  void drawFrame() {
    display_->show(frame_);
    ++frames_;
  }

  void chooseQuality() {
    if (!quality_->follow(newest_.drilling || newest_.depth_mm > 0.0)) return;
    frame_.quality = quality_->quality();
    noteQuality();
  }
  void noteQuality() { workstation_->note("quality", quality_->text()); }

  RehearsalStatus status() {
    RehearsalStatus s;
    s.patient_title = plan_.patient.title;
    s.bur = textOf(desk_.inForce().tool.head);
    s.display = std::string(render::nameOf(display_->mode()));
    s.tick = newest_;
    s.command = desk_.inForce();
    s.servo = workstation_->figures();
    s.device = hand_.name;
    s.calibration = plan_.calibration;
    s.remarks = plan_.remarks;
    s.trips = trips_;
    s.servo_rate_Hz = rate_Hz_;
    s.drawing_ms = 1000.0 * display_->drawing_s();
    s.pictures_per_s = pictures_per_s_;
    s.refresh_Hz = display_->refresh_Hz();
    s.budget_ms = 1000.0 * quality_->budget_s();
    s.latency = latency_->now();
    s.quality = quality_->text();
    s.quality_step = quality_->step();
    s.quality_is_held = quality_->isHeld();
    s.layers = frame_.layers;
    if (plan_.recording) {
      s.recording = recording_ended_ ? RecordingState::ended_early : RecordingState::running;
      s.recording_path = plan_.recording->path;
    }
    return s;
  }

  void showStatus() {
    const double since_s = secondsSince(status_shown_);
    if (since_s < kStatusEvery_s) return;
    pictures_per_s_ = static_cast<double>(frames_ - frames_counted_) / since_s;
    frames_counted_ = frames_;
    status_shown_ = Clock::now();
    noteTrouble();
    if (display_->window() == nullptr) return;
    if (secondsSince(latency_noted_) > kLatencyNotedEvery_s && latency_->pictures() > 0) {
      latency_noted_ = Clock::now();
      workstation_->note("latency", photonText(latency_->now()));
    }
    display_->window()->setTitle(plan_.guide ? plan_.guide->words() : statusLine(status()));
  }

  /// Says and records, once, that the recording ended early or the device can not be believed.
  void noteTrouble() {
    if (unplug_watch_)
      if (const auto news = unplug_watch_->takeNews()) tell(*news);
    if (second_hand_)
      if (const auto news = second_hand_->takeNews()) tell(*news);
    if (const auto trouble = workstation_->recordingTrouble(); trouble && !recording_ended_) {
      recording_ended_ = true;
      std::fprintf(stderr, "molar: recording ended: %s\n", trouble->c_str());
    }
    if (const std::string words = workstation_->deviceTrouble(); std::exchange(device_trouble_, words) != words)
      if (!words.empty()) tell(words);
    if (newest_.dt_s <= 0.0) return;  // not a tick yet
    trips_ = workstation_->trips();
    for (const std::string& line : trip_teller_.look(trips_, newest_.state)) {
      std::fprintf(stderr, "molar: %s\n", line.c_str());
      workstation_->note("safety", line);
    }
  }

  /// Both eyes at full quality: `name_left.png`, `name_right.png`.
  void takePictures(EyePictures& pictures, std::span<const std::uint8_t> solid) {
    const auto renderer = dressedRenderer(plan_.patient, desk_.inForce().tool, solid,
                                          {.backend = display_->backend(), .samples = kSnapshotSamples});
    if (second_hand_) second_hand_->dress(*renderer);
    render::Frame frame = frame_;
    frame.quality = {};
    frame.rig.screen.px = plan_.snapshot_px;
    pictures.take(*renderer, frame);
  }

  /// The window's own picture.
  void takeWindowSnapshot() {
    try {
      const std::string path = saveNextSnapshot(display_->renderer().readPicture());
      workstation_->note("snapshot", path);
      std::fprintf(stderr, "molar: snapshot %s\n", path.c_str());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "molar: %s\n", error.what());
    }
  }

  void finish() {
    if (latency_->pictures() > 0) workstation_->note("latency", "median " + photonText(latency_->median()));
    workstation_->note("end", interrupted ? "interrupted" : ended_by_user_ ? "by the user" : "time over");
    workstation_->note("servo", punctualityText(workstation_->figures()));
    workstation_->note("safety", "trips: " + tripsText(workstation_->trips()));
    const RecordingSummary recorded = workstation_->stop();
    // One more picture of what the bone has become.
    followServo();
    // A scripted hand that has withdrawn only hides its work.
    frame_.tool_visible = frame_.tool_visible && (hand_.mouse || newest_.depth_mm > 0.0);
    if (closing_pictures_) takePictures(*closing_pictures_, workstation_->bone().solidInGridOrder());
    RehearsalFigures figures;
    figures.patient_title = plan_.patient.title;
    figures.calibration = plan_.calibration;
    figures.bur = textOf(desk_.inForce().tool.head);
    figures.duration_s = newest_.t_s + newest_.dt_s;
    figures.removed_mm3 = workstation_->bone().removedByTissue_mm3();
    figures.frames = frames_;
    figures.frame_ms = 1000.0 * loop_s_ / static_cast<double>(std::max<std::uint64_t>(1, frames_ - 1));
    figures.first_picture_s = first_picture_s_;
    figures.display = std::string(render::nameOf(display_->mode()));
    figures.quality = quality_->text();
    if (latency_->pictures() > 0) {
      figures.latency = latency_->median();
      figures.slow_latency = latency_->slow();
    }
    figures.servo = workstation_->figures();
    figures.trips = workstation_->trips();
    figures.rate_Hz = rate_Hz_;
    if (plan_.recording) figures.recording = recorded;
    std::fputs(summaryText(figures).c_str(), plan_.guide ? stderr : stdout);
  }

  Clock::time_point looping_since_, status_shown_ = Clock::now(), latency_noted_ = Clock::now(), pose_read_;
  RehearsalPlan plan_;
  HandAtWork hand_;
  double rate_Hz_;
  std::optional<double> duration_s_;
  std::optional<SecondHand> second_hand_;
  HandInput input_;
  CommandDesk desk_;
  std::optional<EyePictures> first_pictures_, closing_pictures_;
  std::vector<std::string> told_early_;
  std::optional<SurgeonDisplay> display_;
  std::optional<QualityChoice> quality_;
  std::optional<MotionToPhoton> latency_;
  std::optional<OperatorSeat> operator_;  // goes before the surgeon's window, which it shares with
  std::optional<haptics::FootPedal> pedal_;
  std::optional<Workstation> workstation_;
  std::optional<UnplugWatch> unplug_watch_;
  std::string device_trouble_;
  TripTeller trip_teller_;
  haptics::TripLedger trips_;
  BrickUpload upload_;
  render::Frame frame_;
  haptics::Tick newest_;
  Clock::time_point ticked_at_;
  std::uint64_t index_seen_ = 0;
  std::uint64_t frames_ = 0, frames_counted_ = 0;
  double first_picture_s_ = 0.0, loop_s_ = 0.0, pictures_per_s_ = 0.0;
  bool recording_ended_ = false, ended_by_user_ = false;
};

}  // namespace

void rehearse(RehearsalPlan plan) {
  // The second time at the latest something hangs: the force goes without it.
  for (int asked : {SIGINT, SIGTERM, SIGHUP})
    std::signal(asked, [](int) {
      if (interrupted) forbidForceNow();
      interrupted = 1;
    });
  plan.device_options.given_up = [] { return interrupted != 0; };
  Rehearsal(std::move(plan)).run();
}

}  // namespace app
