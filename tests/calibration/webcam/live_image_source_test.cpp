#include "calibration/webcam/live_image_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "tests/refusal.h"

namespace calibration {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// Controls and observes the camera behind the frames.
struct PlayedCamera {
  std::atomic<int> frames{0}, last{1'000'000'000};
  std::atomic<bool> waits_with_frames{false}, waits_in_decoding{false};  ///< until changed
  std::atomic<bool> is_decoding{false};
};

/// Its images are as wide as their number.
class NumberedFrames final : public FrameGrabber {
 public:
  explicit NumberedFrames(PlayedCamera& camera) : camera_(camera) {}
  bool next() override {
    do {
      std::this_thread::sleep_for(100us);
    } while (camera_.waits_with_frames);
    return ++camera_.frames <= camera_.last;
  }
  GreyImage decoded() override {
    const int frame = camera_.frames;
    camera_.is_decoding = true;
    while (camera_.waits_in_decoding) std::this_thread::sleep_for(100us);
    GreyImage image;
    image.size_px = {frame, 1};
    image.grey.resize(static_cast<std::size_t>(frame));
    return image;
  }
  std::string remarks() override { return "no focus"; }

 private:
  PlayedCamera& camera_;
};

LiveImageSource liveImages(PlayedCamera& camera, std::chrono::milliseconds frame_timeout = 250s) {
  return {"webcam", [&] { return std::make_unique<NumberedFrames>(camera); }, {250s, frame_timeout}};
}

std::string refusal(const std::function<void()>& act) {
  return tests::refusalOf<CalibrationError>([&] { act(); });
}

TEST(LiveImageSource, ReturnsAnImageExposedAfterTheCall) {
  PlayedCamera camera;
  LiveImageSource live = liveImages(camera);
  EXPECT_EQ(live.remarks(), "no focus");
  for (int i = 0; i < 3; ++i) {
    const int before = camera.frames;
    EXPECT_GE(live.take().size_px.x, before + 2);
  }
}

TEST(LiveImageSource, WaitsNoLongerThanItsTimeout) {
  PlayedCamera camera;
  camera.waits_with_frames = true;
  LiveImageSource live = liveImages(camera, 50ms);
  EXPECT_THAT(refusal([&] { live.take(); }), HasSubstr("in time"));
  camera.waits_with_frames = false;
}

TEST(LiveImageSource, ReportsALostCamera) {
  PlayedCamera camera;
  camera.last = 1;
  LiveImageSource live = liveImages(camera);
  for (int i = 0; i < 2; ++i) EXPECT_THAT(refusal([&] { live.take(); }), HasSubstr("no more images"));
}

TEST(LiveImageSource, ReportsWhyTheCameraDoesNotOpen) {
  const auto fails = []() -> std::unique_ptr<FrameGrabber> { throw CalibrationError("webcam: busy"); };
  EXPECT_EQ(refusal([&] { LiveImageSource("webcam", fails, {250s, 250s}); }), "webcam: busy");
  const auto runs_out = []() -> std::unique_ptr<FrameGrabber> { throw std::bad_alloc(); };
  EXPECT_THAT(refusal([&] { LiveImageSource("webcam", runs_out, {250s, 250s}); }), HasSubstr("does not answer"));
  // Longer than the timeout; on a busy machine it may return empty by then.
  const auto sleeps = []() -> std::unique_ptr<FrameGrabber> {
    std::this_thread::sleep_for(200ms);
    return nullptr;
  };
  EXPECT_THAT(refusal([&] { LiveImageSource("webcam", sleeps, {20ms, 250s}); }), HasSubstr("does not answer"));
}

TEST(LiveImageSource, NeverReturnsAnImageOlderThanTheCall) {
  PlayedCamera camera;
  camera.waits_in_decoding = true;
  LiveImageSource live = liveImages(camera, 200ms);
  // The waiting call has ended while the image is still being decoded.
  while (!camera.is_decoding) EXPECT_THROW(live.take(), CalibrationError);

  std::thread release([&] {
    std::this_thread::sleep_for(50ms);
    camera.waits_in_decoding = false;
  });
  for (bool has_one = false; !has_one;) {
    const int before = camera.frames;
    try {
      EXPECT_GT(live.take().size_px.x, before);
      has_one = true;
    } catch (const CalibrationError&) {
      // The machine was busy for longer than the timeout: use the next one.
    }
  }
  release.join();
}

}  // namespace
}  // namespace calibration
