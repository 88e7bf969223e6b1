#include "calibration/webcam/live_pictures.h"

#include <gtest/gtest.h>

#include <atomic>

namespace calibration {
namespace {

using namespace std::chrono_literals;

/// Numbers its frames; hangs in decoding the first one until told.
struct Camera {
  std::atomic<int> frames{0};
  std::atomic<bool> hangs{true}, hanging{false};
};

class NumberedFrames final : public FrameGiver {
 public:
  explicit NumberedFrames(Camera& camera) : camera_(camera) {}
  bool next() override {
    std::this_thread::sleep_for(100us);
    ++camera_.frames;
    return true;
  }
  GreyPicture decoded() override {
    const int frame = camera_.frames;
    camera_.hanging.store(true);
    while (camera_.hangs.load()) std::this_thread::sleep_for(100us);
    GreyPicture picture;
    picture.size_px = {frame, 1};
    picture.grey.resize(static_cast<std::size_t>(frame));
    return picture;
  }
  std::string remarks() override { return {}; }

 private:
  Camera& camera_;
};

TEST(LivePictures, NeverHandOutOneThatIsOlderThanTheCall) {
  Camera camera;
  LivePictures pictures("camera", [&] { return std::make_unique<NumberedFrames>(camera); }, {20s, 200ms});
  // Nobody waits any more for the picture that is still being decoded.
  while (!camera.hanging.load()) EXPECT_THROW(pictures.take(), CalibrationError);

  std::thread release([&] {
    std::this_thread::sleep_for(50ms);
    camera.hangs.store(false);
  });
  for (bool has_one = false; !has_one;) {
    const int before = camera.frames;
    try {
      EXPECT_GT(pictures.take().size_px.x, before);
      has_one = true;
    } catch (const CalibrationError&) {
      // The machine was busy for longer than anybody waits: the next one.
    }
  }
  release.join();
}

}  // namespace
}  // namespace calibration
