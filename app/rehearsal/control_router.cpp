#include "app/rehearsal/control_router.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>

#include <fmt/core.h>

#include "app/options/picture_option.h"
#include "app/procedure/root_canal/canal_tip.h"
#include "app/rehearsal/file_sight.h"
#include "app/rehearsal/frame_builder.h"
#include "app/rehearsal/ruler.h"
#include "app/session/assessment_event.h"
#include "app/session/data_folder.h"
#include "app/session/session_writer.h"
#include "app/text/message.h"
#include "app/view/snapshot.h"
#include "calibration/output_file.h"

namespace app {

static constexpr const char* kDrawFileOut = "draw the file out of the tooth first";

ControlRouter::ControlRouter(const RehearsalPlan& plan, Equipment& equipment, ActiveCommand& active_command,
                             RunMonitor& monitor, LiveView& view, HeadUp& head_up, EventLog& event_log)
    : plan_(plan),
      equipment_(equipment),
      active_command_(active_command),
      monitor_(monitor),
      view_(view),
      head_up_(head_up),
      event_log_(event_log),
      input_(restingTool(plan.rig, plan.patient, plan.cut)),
      desk_view_(plan.rig, plan.rig.X_WP * calibration::Point<calibration::Patient>{plan.patient.focus_P_mm()}),
      script_(equipment.scriptedRequests(), active_command.tray(), equipment.rate_Hz()) {
  if (plan.procedure_steps && plan.procedure_steps->asks) prediction_.open();
  if (SecondHand* const other = equipment.secondHand())
    if (const auto start = other->startOfMouse()) other_hand_.emplace(*start, equipment.mouse() == nullptr);
}

void ControlRouter::handleInput(const haptics::Tick& newest, render::Frame& frame) {
  const haptics::Tool& in_hand = active_command_.inForce().tool;
  std::optional<double> gap_mm = frame.gap ? std::optional(frame.gap->mm) : std::nullopt;
  // A notch moves a file in its canal by 0.4 mm.
  constexpr double kInCanal_mm = 1.0;
  if (in_hand.isFile() && plan_.patient.canals && newest.file.stay != haptics::FileStay::none)
    gap_mm = std::max(kInCanal_mm, fromOrifice_mm(*plan_.patient.canals, newest.file.tip_P_mm));
  input_.setGap(gap_mm);
  input_.setAlongTool(plan_.patient.canals || plan_.patient.prepared);
  input_.setTwisting(in_hand.isElevator() || in_hand.isFile());
  readWindow(frame);
  executeScript(newest, frame);
  for (const ControlRequest& request : equipment_.takeRequests()) execute(request, frame);
  followToolButton(newest, frame);
  executeKeys(frame, plan_.verbose);
  ring_.moveTo(handOnScreen(frame));
}

/// A short press changes the tool, a long one opens the ring until it is let go.
void ControlRouter::followToolButton(const haptics::Tick& newest, render::Frame& frame) {
  const Workstation::ToolButton button = equipment_.toolButton();
  const HeldPress::Seen seen = tool_press_.look(button.presses, button.held, newest.t_s);
  for (std::uint32_t n = 0; n < seen.taps; ++n) execute({Control::tool}, frame);
  if (seen.ended && ring_.isOpen()) execute({Control::ring, 0}, frame);
  if (seen.began) execute({Control::ring, 1}, frame);
}

/// As the viewer sees it: of the pointer where a mouse moves the tool, else of the tool at the hand.
glm::dvec2 ControlRouter::handOnScreen(const render::Frame& frame) {
  if (equipment_.mouse() != nullptr && view_.window() != nullptr &&
      view_.display().mode() == render::DisplayMode::mono) {
    const glm::dvec2 window_px = glm::max(view_.window()->framebufferSize_px(), 1);
    return pointer_px_ / window_px.y;
  }
  const glm::ivec2 seen_px = render::screenOrientation(frame.rig).viewerSize(frame.rig.screen.px);
  return placeOnScreen(frame.rig, {frame.X_PT_at_hand.translation_mm}) / static_cast<double>(std::max(1, seen_px.y));
}

/// The next instrument works where this one does: in the canal.
bool ControlRouter::isFileInTooth() {
  const haptics::Tick tick = equipment_.workstation().newestTick();
  if (!equipment_.isHeldByEnd() || !plan_.patient.canals || tick.file.stay == haptics::FileStay::none) return false;
  return tick.file.stay != haptics::FileStay::free || canalTip(*plan_.patient.canals, tick.file.tip_P_mm).has_value();
}

void ControlRouter::closeRing() {
  ring_.cancel();
  active_command_.takeHandsOff(false);
}

void ControlRouter::switchRing(bool open, const render::Frame& frame) {
  if (open == ring_.isOpen()) return;
  if (!open) {
    ring_.moveTo(handOnScreen(frame));
    const auto taken = ring_.take();
    if (taken) active_command_.execute({Control::tool, static_cast<int>(*taken)});
    return closeRing();
  }
  const std::size_t tools = active_command_.tray().size();
  const haptics::Tick tick = equipment_.workstation().newestTick();
  if (tick.dt_s == 0.0) return;  // no hand yet
  if (equipment_.led() != nullptr) return head_up_.say("the shown hand chooses its instruments itself");
  if (tools < 2) return head_up_.say("there is one tool only");
  if (isFileInTooth()) return head_up_.say(kDrawFileOut);
  if (tools > kMostInRing) return head_up_.say("the tray holds too many tools for the ring: T changes them");
  if (tick.gripped != 0) return head_up_.say("open the forceps first");
  if (tick.lever.piece != 0) return head_up_.say("take the elevator off the tooth first");
  ring_.open(tools, active_command_.inHand(), handOnScreen(frame));
  if (equipment_.mouse() != nullptr)
    head_up_.say("point at an instrument and click; in the middle the hand keeps its own");
  active_command_.takeHandsOff(true);
}

/// A learner's left hand does not change physics.
void ControlRouter::executeKeys(render::Frame& frame, bool may_choose_law) {
  for (const ControlRequest& request : input_.takeRequests())
    if (request.control == Control::law && !may_choose_law && !plan_.procedure)
      head_up_.say("The instructor chooses the force law");
    else
      execute(request, frame);
}

void ControlRouter::handleInstructorInput(const InstructorWindow::Input& input, render::Frame& frame) {
  for (const render::WindowEvent& event : input.keys) {
    const auto* key = std::get_if<render::KeyPressed>(&event);
    const bool escape = key != nullptr && key->key == render::Key::escape;
    if (!escape && !isTakenByProcedure(event)) input_.take(event, 0.0);
  }
  executeKeys(frame, true);
  for (const ControlRequest& request : input.requests) execute(request, frame);
}

void ControlRouter::readWindow(render::Frame& frame) {
  if (const render::Window* const window = view_.window()) {
    const calibration::ScreenCorners& screen = frame.rig.screen;
    const double width_mm = glm::distance(screen.lower_left.mm, screen.lower_right.mm);
    const double mm_per_px = width_mm / std::max(1, window->framebufferSize_px().x);
    for (const render::WindowEvent& event : view_.display().takeEvents()) {
      if (const auto* const moved = std::get_if<render::PointerMoved>(&event)) pointer_px_ = moved->to_px;
      if (isTakenByRing(event, frame)) continue;
      if (isTakenByEndQuestion(event) || isTakenByPrediction(event) || isTakenByProcedure(event) ||
          scrollSlice(event, frame))
        continue;
      const auto* const moved = std::get_if<render::PointerMoved>(&event);
      if (plan_.view_can_turn && moved != nullptr && moved->button == render::MouseButton::right) {
        desk_view_.turn(moved->by_px);
        showDeskView(frame);
      }
      if (!other_hand_ || !other_hand_->take(event, mm_per_px)) input_.take(event, mm_per_px);
    }
  }
  if (other_hand_) equipment_.secondHand()->moveMouse(other_hand_->X_WO());
  if (haptics::MouseDevice* const mouse = equipment_.mouse())
    mouse->setTarget({{input_.X_WT().rotation, input_.X_WT().translation_mm}, input_.pedal()});
}

void ControlRouter::placeHandAt(const glm::dvec3& position_W_mm) {
  input_.moveTo(position_W_mm);
  if (haptics::MouseDevice* const mouse = equipment_.mouse())
    mouse->placeAt({{input_.X_WT().rotation, input_.X_WT().translation_mm}, false});
}

/// Requests due at the next tick; after the last tick, those due until then.
void ControlRouter::executeScript(const haptics::Tick& newest, render::Frame& frame) {
  const std::uint64_t made = newest.dt_s > 0.0 ? newest.index + 1 : 0;
  const std::uint64_t due = made > 0 && monitor_.isTimeOver(newest) ? made - 1 : made;
  for (const ScriptedRequest& scripted : script_.takeDue(due)) execute(scripted.request, frame, scripted.where);
}

/// `where`: file and row of a scripted request, for messages.
void ControlRouter::execute(const ControlRequest& request, render::Frame& frame, const std::string& where) {
  if (request.control == Control::stop) return stopMotors();
  if (head_up_.execute(request)) return;
  if (request.control == Control::end) return monitor_.endByUser();
  if (plan_.procedure && plan_.procedure->take(request)) return;
  if (isHelpRefused(request)) return;
  if (plan_.evaluation && !plan_.evaluation->allows(request))
    return head_up_.say(std::string(meaningOf(request.control).name) + ": not in this evaluation");
  if (request.control == Control::tool && ring_.isOpen()) closeRing();
  if (request.control == Control::tool && isFileInTooth()) return head_up_.say(kDrawFileOut);
  if (active_command_.execute(request, where)) return;
  if (request.control == Control::ring)
    switchRing(request.value == kNoValue ? !ring_.isOpen() : request.value != 0, frame);
  frame.layers = layersAfter(frame.layers, request);
  changeView(request, frame);
  if (request.control == Control::clear_tooth)
    head_up_.say(!plan_.patient.canals      ? "it is for a root canal treatment"
                 : frame.layers.clear_tooth ? "the tooth is clear while a file is in the hand"
                                            : "the tooth is as the eye sees it");
  if (request.control == Control::deviation || request.control == Control::insertion) tellPaint(request, frame.layers);
  if (request.control == Control::slice_up || request.control == Control::slice_down)
    frame.slices_beside_bur_P_mm =
        scrolledSlices(frame, render::SlicePlane::axial, request.control == Control::slice_up ? 1.0 : -1.0);
  if (request.control == Control::snapshot) takeSnapshot(frame);
  if (request.control == Control::ruler) markRuler(frame);
  if (request.control == Control::draw) drawn_.push_back(touched_P_mm(frame));
  if (request.control == Control::draw_next) drawn_.push_back(std::nullopt);
  if (request.control == Control::step) ++steps_;
  if (request.control == Control::bite && !plan_.patient.prepared) head_up_.say("it is for a tooth preparation");
  if (request.control == Control::bite) ++bites_;
  if (request.control == Control::way) asks_way_ = true;
  if (request.control == Control::sound) sound_ = request.value;
  if (request.control == Control::home) {
    equipment_.workstation().setHome();
    head_up_.say("the handle is at home");
  }
}

void ControlRouter::tellPaint(const ControlRequest& request, const render::Layers& layers) {
  const bool is_deviation = request.control == Control::deviation;
  const bool shown = is_deviation ? layers.deviation : layers.insertion;
  head_up_.say(!plan_.patient.prepared ? "it is for a tooth preparation"
               : !shown                ? "the tooth as the eye sees it"
               : is_deviation          ? "colours: how far the tooth is off its ideal"
                                       : "arrow: way of insertion; purple: undercut");
}

/// In an assessment; who asked is recorded.
bool ControlRouter::isHelpRefused(const ControlRequest& request) {
  if (!plan_.is_assessed) return false;
  const bool is_layer = request.control == Control::layer && request.value >= 0 &&
                        static_cast<std::size_t>(request.value) < kPictureLayers.size();
  const PictureLayer* const layer = is_layer ? &kPictureLayers[static_cast<std::size_t>(request.value)] : nullptr;
  const std::string help = request.control == Control::undo          ? "undo"
                           : request.control == Control::redo        ? "redo"
                           : request.control == Control::way         ? "what keeps the tooth in"
                           : request.control == Control::clear_tooth ? "a clear tooth"
                           : request.control == Control::deviation   ? "distances to the ideal"
                           : request.control == Control::insertion   ? "the way of insertion"
                           : layer != nullptr && isHelp(*layer)      ? "layer " + std::string(layer->name)
                                                                     : "";
  if (help.empty()) return false;
  head_up_.say(help + ": not in an assessment");
  event_log_.note(kAssessmentEvent, std::string(kHelpRefused) + help);
  return true;
}

/// The wheel over a CT slice; in mono, where the pointer is on the picture that both eyes see.
bool ControlRouter::scrollSlice(const render::WindowEvent& event, render::Frame& frame) {
  const auto* const wheel = std::get_if<render::WheelTurned>(&event);
  if (wheel == nullptr || view_.display().mode() != render::DisplayMode::mono) return false;
  const glm::dvec2 window_px = glm::max(view_.window()->framebufferSize_px(), 1);
  const auto plane = view_.display().renderer().sliceAt(frame, pointer_px_ / window_px);
  if (!plane) return false;
  frame.slices_beside_bur_P_mm = scrolledSlices(frame, *plane, wheel->notches);
  return true;
}

/// On a desk; with a measured rig the view is that of the eyes.
void ControlRouter::changeView(const ControlRequest& request, render::Frame& frame) {
  if (request.control < Control::magnify || request.control > Control::first_view) return;
  if (!plan_.view_can_turn) return head_up_.say("this view stays as it is: --loupes sets the loupes");
  if (request.control == Control::magnify) desk_view_.magnify(1);
  if (request.control == Control::shrink) desk_view_.magnify(-1);
  if (request.control == Control::first_view) desk_view_.backToFirst();
  if (request.control == Control::first_view)
    head_up_.say("the first view");
  else if (!plan_.patient.canals)
    head_up_.say(fmt::format("loupes {:.1f} times as strong as at first", desk_view_.magnified()));
  showDeskView(frame);
  const double shown_mm = glm::distance(frame.rig.screen.lower_left.mm, frame.rig.screen.lower_right.mm);
  if (plan_.patient.canals && request.control != Control::first_view)
    head_up_.say(fmt::format("microscope {:.0f}×", calibration::kDeskMonitorWidth_mm / shown_mm));
}

void ControlRouter::showDeskView(render::Frame& frame) {
  const glm::ivec2 px = frame.rig.screen.px;
  frame.rig = desk_view_.rig();
  frame.rig.screen.px = px;
  frame.face_window_mm = std::max(plan_.face_window_mm, desk_view_.faceWindow_mm());
  input_.setView(desk_view_.rotation());
  if (other_hand_) other_hand_->setView(desk_view_.rotation());
}

bool ControlRouter::isTakenByPrediction(const render::WindowEvent& event) {
  const auto* key = std::get_if<render::KeyPressed>(&event);
  return key != nullptr && prediction_.take(*key);
}

/// A procedure has its own way to end.
bool ControlRouter::isTakenByEndQuestion(const render::WindowEvent& event) {
  const auto* key = std::get_if<render::KeyPressed>(&event);
  if (!key) return false;
  // What is open is closed first.
  if (key->key == render::Key::escape && key->down && !end_question_.isOpen()) {
    if (head_up_.closeKeys()) return true;
    if (ring_.isOpen()) return closeRing(), true;
  }
  if (plan_.procedure) return false;
  const EndQuestion::Answer answer = end_question_.take(*key);
  if (answer == EndQuestion::Answer::end) monitor_.endByUser();
  return answer != EndQuestion::Answer::not_concerned;
}

/// Nothing without motors.
void ControlRouter::stopMotors() {
  if (!equipment_.hasMotors()) return;
  equipment_.workstation().emergencyStop();
  event_log_.note("emergency stop", "motors off for good");
  printMessage("emergency stop: the motors are off; end and start again to feel");
}

/// Into the data folder, never over another picture. A stepped rehearsal has not opened its view yet.
void ControlRouter::takeSnapshot(const render::Frame& frame) {
  if (plan_.ticking == Ticking::stepped) {
    view_.display().renderer();
    view_.uploadBone(frame);
    view_.showInstrument();
  }
  try {
    const std::filesystem::path folder = usualPictureFolder();
    makeDataFolder(folder);
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    const int fdi = plan_.patient.site ? plan_.patient.site->fdi : 0;
    const std::string path = newPicturePath(folder, now.time_since_epoch().count(), fdi);
    calibration::OutputFile file(path, false);
    savePng(view_.fullPicture(frame), file);
    event_log_.note("snapshot", path);
    printMessage("picture saved as " + path);
    head_up_.say("picture saved as " + path);
  } catch (const std::exception& error) {
    printMessage(error.what());
    head_up_.say(error.what());
  }
}

/// On the bone as it is drawn; a stepped rehearsal brings its view up to date for it.
glm::dvec3 ControlRouter::touched_P_mm(render::Frame& frame) {
  if (plan_.ticking == Ticking::stepped) {
    view_.display();
    view_.uploadBone(frame);
    frame.gap = view_.gapOf(frame);
  }
  return markedPoint(frame, active_command_.inForce().tool.head).mm;
}

void ControlRouter::markRuler(render::Frame& frame) {
  frame.ruler = rulerAfterMark(frame.ruler, calibration::Point<calibration::Patient>{touched_P_mm(frame)});
  event_log_.note(kRulerEvent, rulerEvent(frame.ruler));
  if (!frame.ruler)
    head_up_.say("ruler put away");
  else if (!frame.ruler->to_P)
    head_up_.say("first point marked: go to the second and press M again");
  else
    head_up_.say(rulerText(frame.ruler));
}

/// A click takes what the pointer has chosen, and moves nothing.
bool ControlRouter::isTakenByRing(const render::WindowEvent& event, const render::Frame& frame) {
  const auto* const pressed = std::get_if<render::ButtonPressed>(&event);
  if (!ring_.isOpen() || pressed == nullptr || !pressed->down || pressed->button != render::MouseButton::left)
    return false;
  switchRing(false, frame);
  return true;
}

bool ControlRouter::isTakenByProcedure(const render::WindowEvent& event) const {
  const auto* key = std::get_if<render::KeyPressed>(&event);
  if (!plan_.procedure || !key || !key->down || key->repeated) return false;
  const int code = static_cast<int>(key->key);
  return code > ' ' && code <= 'Z' && plan_.procedure->takeKey(static_cast<char>(code));
}

}  // namespace app
