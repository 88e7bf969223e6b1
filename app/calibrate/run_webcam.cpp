#include "app/calibrate/run_webcam.h"

#include <deque>
#include <thread>

#include "app/calibrate/button_press.h"
#include "app/calibrate/webcam_technician.h"
#include "app/calibrate/wizard_pages.h"
#include "app/text/usage_error.h"
#include "calibration/median.h"

namespace app {
namespace {

using namespace calibration;

/// Until a screen shows what it was given, its own delay and two frames.
constexpr auto kShown = std::chrono::milliseconds(120);
constexpr double kMedian_s = 0.2;

class WebcamShow : GuidedProcedure {
 public:
  explicit WebcamShow(const WebcamRun& run)
      : GuidedProcedure(run, run.plan.rig.screen.px, run.robot),
        run_(run),
        procedure_(run.plan),
        pages_(run.plan.rig.mirror) {
    if (run.device != nullptr && run.images == nullptr)
      throw UsageError("calibrate: the webcam procedure needs a webcam, give --camera");
    if (run.practice) technician_.emplace(*run.practice, run.practice_px, run.practice->seed);
  }

  std::optional<WebcamObservations> run() {
    while (procedure_.expects() != WebcamInput::nothing) {
      takeEvents(run_.plan.rig);
      if (left_) return std::nullopt;
      const auto began = Clock::now();
      showPage();
      if (run_.robot) {
        showForCamera();
        technician_->act(procedure_);
      } else {
        update();
        if (procedure_.expects() == WebcamInput::image) takePicture();
        std::this_thread::sleep_until(began + kPageTime);
      }
      tellNews();
    }
    return procedure_.observations();
  }

 private:
  /// Presses lead on; the last joints are kept for the image.
  void update() {
    samples_.clear();
    source_->takeInto(samples_, view_);
    for (const StylusSample& sample : samples_) {
      if (!sample.valid) continue;
      recent_.push_back(sample);
      while (recent_.back().t_s - recent_.front().t_s > kMedian_s) recent_.pop_front();
      const Press press = button_.update(sample.t_s, sample.button);
      if (procedure_.expects() != WebcamInput::press) continue;
      if (press == Press::long_press) procedure_.undo();
      if (press != Press::short_press) continue;
      if (technician_ && run_.images == nullptr) technician_->placeWebcamFor(procedure_);
      procedure_.press();
    }
  }

  /// The median of each joint.
  RawJoints joints() const {
    RawJoints median{};
    for (std::size_t axis = 0; axis < median.size() && !recent_.empty(); ++axis) {
      std::vector<double> angles;
      for (const StylusSample& sample : recent_) angles.push_back(sample.raw_rad[axis]);
      median[axis] = medianOf(angles);
    }
    return median;
  }

  void takePicture() {
    showForCamera();
    std::this_thread::sleep_for(kShown);
    update();
    if (recent_.empty()) return;
    const auto seen = source_->seen();
    const bool lit = procedure_.step() == WebcamStep::tips && seen;
    const GreyImage image = run_.images != nullptr
                                ? run_.images->take()
                                : technician_->image(procedure_, lit ? std::optional(seen->tip_W) : std::nullopt);
    procedure_.see(image, joints());
  }

  void showForCamera() {
    if (!screen_ || procedure_.expects() != WebcamInput::image) return;
    const auto draw = [&](const render::StereoLayout& layout) { return patternForCamera(procedure_.shown(), layout); };
    screen_->show(draw, true);
  }

  /// The instruction, hidden while a pattern is on the screen.
  void showPage() {
    view_ = WizardView{};
    if (isPractisedByHand()) view_.practice_keys = kPracticeKeys;
    view_.title = "Webcam";
    view_.sentence = procedure_.sentence();
    view_.message = {procedure_.answer(), WizardView{}.message.tone};
    if (!procedure_.answer().empty()) view_.message.tone = Tone::reject;
    view_.button = {"go on", procedure_.step() == WebcamStep::tips ? "take the last one again" : "", ""};
    view_.progress = procedure_.progress();
    view_.screen = run_.plan.rig.screen;
    view_.left_eye = run_.plan.rig.left_eye;
    view_.right_eye = run_.plan.rig.right_eye;
    view_.target_kind = TargetKind::webcam_place;
    if (const auto target = procedure_.target())
      view_.targets = {{target->position_W, target->stylus_W, TargetState::next, std::to_string(target->id)}};
    if (!screen_ || procedure_.expects() != WebcamInput::press) return;
    const double t_s = shownFor_s();
    screen_->show([&](const render::StereoLayout& layout) { return pages_.output(view_, trueStylus(), layout, t_s); });
  }

  void tellNews() {
    if (!sounds_ || procedure_.progress() == progress_) return;
    sounds_->play(procedure_.expects() == WebcamInput::nothing ? WizardSound::done : WizardSound::ok);
    progress_ = procedure_.progress();
  }

  const WebcamRun& run_;
  WebcamProcedure procedure_;
  WizardPages pages_;
  std::optional<WebcamTechnician> technician_;
  ButtonPress button_;
  std::deque<StylusSample> recent_;
  double progress_ = 0.0;
};

}  // namespace

std::optional<WebcamObservations> runWebcam(const WebcamRun& run) { return WebcamShow(run).run(); }

}  // namespace app
