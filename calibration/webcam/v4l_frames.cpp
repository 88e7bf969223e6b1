#include "calibration/webcam/v4l_frames.h"

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "calibration/webcam/image_matrix.h"

namespace calibration {
namespace {

// V4L2: UVC cameras count exposure in 0.1 ms; 1 is manual.
constexpr double kStepsPerMs = 10.0, kManualExposure = 1.0;

class V4lFrames final : public FrameGrabber {
 public:
  V4lFrames(const std::string& path, const WebcamSettings& wanted) {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    const auto refuse = [&](const std::string& what) { throw CalibrationError("webcam " + path + ": " + what); };
    try {
      if (!camera_.open(path, cv::CAP_V4L2)) refuse("it is busy, close the program that uses it");
      camera_.set(cv::CAP_PROP_FOURCC, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'));
      camera_.set(cv::CAP_PROP_FRAME_WIDTH, wanted.size_px.x);
      camera_.set(cv::CAP_PROP_FRAME_HEIGHT, wanted.size_px.y);
      camera_.set(cv::CAP_PROP_BUFFERSIZE, 1);
      // Automatic first; the values found for this room are then fixed.
      cv::Mat frame;
      if (!camera_.read(frame) || frame.empty()) refuse("it delivers no image, unplug it and plug it in again");
      if (frame.cols != wanted.size_px.x || frame.rows != wanted.size_px.y)
        refuse("it gives " + std::to_string(frame.cols) + " x " + std::to_string(frame.rows) + ", ask for that size");
      hold(wanted);
    } catch (const cv::Exception&) {
      refuse("it cannot be used by OpenCV, try another camera");
    }
  }

  bool next() override {
    try {
      return camera_.grab();
    } catch (const cv::Exception&) {
      return false;
    }
  }
  GreyImage decoded() override {
    cv::Mat frame, grey;
    try {
      if (!camera_.retrieve(frame) || frame.empty()) return {};
      if (frame.channels() == 1) {
        grey = frame;
      } else {
        cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
      }
    } catch (const cv::Exception&) {
      return {};
    }
    return greyImageOf(grey);
  }
  std::string remarks() override { return remarks_; }

 private:
  void hold(const WebcamSettings& wanted) {
    const auto ask = [&](int what, double value, const char* remark) {
      if (!camera_.set(what, value)) remarks_ += (remarks_.empty() ? "" : "; ") + std::string(remark);
    };
    // Values found automatically.
    const double found_exposure = camera_.get(cv::CAP_PROP_EXPOSURE), found_focus = camera_.get(cv::CAP_PROP_FOCUS);
    ask(cv::CAP_PROP_AUTOFOCUS, 0.0, "focus cannot be fixed: use a fixed-focus lens or tape it");
    if (wanted.focus || found_focus > 0.0)
      ask(cv::CAP_PROP_FOCUS, wanted.focus.value_or(found_focus), "focus cannot be set");
    ask(cv::CAP_PROP_AUTO_EXPOSURE, kManualExposure, "exposure cannot be fixed: keep the room's light even");
    const double exposure = wanted.exposure_ms ? *wanted.exposure_ms * kStepsPerMs : found_exposure;
    if (exposure > 0.0) ask(cv::CAP_PROP_EXPOSURE, exposure, "exposure cannot be set");
  }

  cv::VideoCapture camera_;
  std::string remarks_;
};

}  // namespace

std::unique_ptr<FrameGrabber> openV4lFrames(const std::string& path, const WebcamSettings& wanted) {
  return std::make_unique<V4lFrames>(path, wanted);
}

}  // namespace calibration
