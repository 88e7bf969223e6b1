// The newest picture of something that gives them at its own pace, on a thread of its own: it is emptied all the time,
// so that no old picture waits in it, and whoever takes one waits no longer than told. take(): one thread at a time.
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

#include "calibration/webcam/picture_source.h"

namespace calibration {

/// Of one thread.
class FrameGiver {
 public:
  virtual ~FrameGiver() = default;
  virtual bool next() = 0;            ///< waits for the next frame; false: it gives none any more
  virtual GreyPicture decoded() = 0;  ///< the frame that next() came back with
  virtual std::string remarks() = 0;  ///< what it would not do, one line; empty: all as asked
};

class LivePictures final : public PictureSource {
 public:
  struct Patience {
    std::chrono::milliseconds open{8000}, frame{3000};
  };

  /// `open` runs on the new thread and may throw CalibrationError, which comes out here.
  LivePictures(std::string name, const std::function<std::unique_ptr<FrameGiver>()>& open, const Patience& patience);
  ~LivePictures() override;

  GreyPicture take() override;
  std::string name() const override { return name_; }
  const std::string& remarks() const { return remarks_; }

 private:
  void run(const std::function<std::unique_ptr<FrameGiver>()>& open);

  std::string name_, remarks_;
  Patience patience_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool opened_ = false, stop_ = false, ended_ = false;
  int wanted_in_ = 0;       ///< frames until the one that is wanted; 0: none is
  std::uint64_t call_ = 0;  ///< which take() it is wanted by
  std::string trouble_;
  std::optional<GreyPicture> taken_;
  std::thread thread_;
};

}  // namespace calibration
