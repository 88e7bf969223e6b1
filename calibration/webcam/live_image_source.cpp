#include "calibration/webcam/live_image_source.h"

namespace calibration {
namespace {

// The frame being exposed at the call started before it.
constexpr int kFramesAhead = 2;

}  // namespace

LiveImageSource::LiveImageSource(std::string name, const std::function<std::unique_ptr<FrameGrabber>()>& open,
                                 const Timeouts& timeouts)
    : name_(std::move(name)), timeouts_(timeouts), thread_([this, open] { run(open); }) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeouts_.open, [&] { return opened_ || ended_; });
  if (opened_) return;  // disconnected since: take() reports it
  // A throwing constructor runs no destructor.
  const std::string why = !trouble_.empty() ? trouble_ : name_ + ": it does not answer, unplug it and plug it in again";
  stop_ = true;
  lock.unlock();
  thread_.join();
  throw CalibrationError(why);
}

LiveImageSource::~LiveImageSource() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  thread_.join();
}

GreyImage LiveImageSource::take() {
  std::unique_lock lock(mutex_);
  taken_.reset();
  ++call_;
  wanted_in_ = kFramesAhead;
  const bool answered = changed_.wait_for(lock, timeouts_.frame, [&] { return taken_.has_value() || ended_; });
  wanted_in_ = 0;
  if (taken_) return *std::move(taken_);
  throw CalibrationError(name_ + (answered ? ": it delivers no more images" : ": no image in time") +
                         ", check its cable, unplug it and plug it in again");
}

void LiveImageSource::run(const std::function<std::unique_ptr<FrameGrabber>()>& open) {
  std::unique_ptr<FrameGrabber> giver;
  std::string trouble;
  try {
    giver = open();
  } catch (const CalibrationError& error) {
    trouble = error.what();
  } catch (const std::exception&) {
    // Errors of a driver or of memory count as no answer.
  }
  std::unique_lock lock(mutex_);
  opened_ = giver != nullptr;
  trouble_ = trouble;
  if (giver) remarks_ = giver->remarks();
  ended_ = !giver;
  changed_.notify_all();
  while (!stop_ && !ended_) {
    lock.unlock();
    const bool came = giver->next();
    lock.lock();
    ended_ = !came;
    if (came && wanted_in_ > 0 && --wanted_in_ == 0) {
      const std::uint64_t call = call_;
      lock.unlock();
      GreyImage image = giver->decoded();
      lock.lock();
      ended_ = image.grey.empty();
      // The caller may have given up; for a new caller the image is too old.
      if (call == call_) taken_ = std::move(image);
    }
    if (ended_ || taken_) changed_.notify_all();
  }
}

}  // namespace calibration
