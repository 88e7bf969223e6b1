// The newest image of something that gives them at its own pace, on a thread of its own: it is emptied all the time,
// so that no old image waits in it, and whoever takes one waits no longer than told. take(): one thread at a time.
// The destructor waits for the giver's own call to end: a giver must not hang for ever.
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

/// Of one thread.
class FrameGrabber {
 public:
  virtual ~FrameGrabber() = default;
  virtual bool next() = 0;            ///< waits for the next frame; false: it gives none any more
  virtual GreyImage decoded() = 0;    ///< the frame that next() came back with
  virtual std::string remarks() = 0;  ///< what it would not do, one line; empty: all as asked
};

class LiveImageSource final : public ImageSource {
 public:
  struct Timeouts {
    std::chrono::milliseconds open{8000}, frame{3000};
  };

  /// `open` runs on the new thread and may throw CalibrationError, which comes out here.
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
  int wanted_in_ = 0;       ///< frames until the one that is wanted; 0: none is
  std::uint64_t call_ = 0;  ///< which take() it is wanted by
  std::string trouble_;
  std::optional<GreyImage> taken_;
  std::thread thread_;
};

}  // namespace calibration
