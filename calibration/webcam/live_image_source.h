// The newest image of a camera that delivers at its own rate: a thread of its own drains it, so that no old image is
// queued, and take() waits no longer than its timeout. take(): one thread at a time. The destructor waits for the
// grabber's current call, which must not block for ever.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "calibration/webcam/image_source.h"

namespace calibration {

/// Used by one thread.
class FrameGrabber {
 public:
  virtual ~FrameGrabber() = default;
  virtual bool next() = 0;            ///< waits for the next frame; false: the stream has ended
  virtual GreyImage decoded() = 0;    ///< the frame of the last next()
  virtual std::string remarks() = 0;  ///< settings it refused, one line; empty: none
};

class LiveImageSource final : public ImageSource {
 public:
  struct Timeouts {
    std::chrono::milliseconds open{8000}, frame{3000};
  };

  /// `open` runs on the new thread; its CalibrationError is rethrown here.
  LiveImageSource(std::string name, const std::function<std::unique_ptr<FrameGrabber>()>& open,
                  const Timeouts& timeouts);
  ~LiveImageSource() override;

  GreyImage take() override;
  std::string name() const override { return name_; }
  const std::string& remarks() const { return remarks_; }

 private:
  void run(const std::function<std::unique_ptr<FrameGrabber>()>& open);

  std::string name_, remarks_;
  Timeouts timeouts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool opened_ = false, stop_ = false, ended_ = false;
  int wanted_in_ = 0;       ///< frames until the requested one; 0: none requested
  std::uint64_t call_ = 0;  ///< the take() that requested it
  std::string trouble_;
  std::optional<GreyImage> taken_;
  std::thread thread_;
};

}  // namespace calibration
