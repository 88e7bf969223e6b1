#include "app/calibrate/still_capture.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "calibration/median.h"

namespace app {
namespace {

constexpr std::size_t kRing = 1024;       // more than 0.6 s at 1 kHz
constexpr double kLeastStep_s = 0.95e-3;  // of samples that are looked at
constexpr double kLook_s = 0.02, kMean_s = 0.1, kMedian_s = 0.2;
constexpr double kGap_s = 0.03;    // a device that was silent for longer was not seen to be still
constexpr int kLeastSamples = 20;  // in 0.2 s
constexpr double kLeft_mm = 5.0;

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Of places that come one after the other.
struct Scatter {
  int n = 0;
  glm::dvec3 mean{0.0}, square{0.0};

  void add(const glm::dvec3& place) {
    ++n;
    const glm::dvec3 off = place - mean;
    mean += off / static_cast<double>(n);
    square += off * (place - mean);
  }
  double sd() const { return n < 2 ? 0.0 : std::sqrt(largest(square) / n); }
};

}  // namespace

StillCapture::StillCapture(const StillLimits& limits) : limits_(limits), ring_(kRing) {}

const StillCapture::Seen& StillCapture::back(std::size_t n) const { return ring_[(newest_ + kRing - n) % kRing]; }

void StillCapture::update(const StylusSample& sample) {
  if (count_ > 0 && sample.t_s - back(0).t_s < kLeastStep_s) return;
  newest_ = (newest_ + 1) % kRing;
  count_ = std::min(count_ + 1, kRing);
  const glm::dvec3 tip_mm = (sample.X_DH * calibration::Point<calibration::Handle>{calibration::kNominalTip_H_mm}).mm;
  ring_[newest_] = {sample.t_s, sample.raw_rad, sample.X_DH.translation_mm, tip_mm};

  // It has to leave where it was; a turn of 5° moves the tip 3.5 mm about the wrist.
  if (!left_from_) left_from_ = back(0);
  const glm::dvec3 went_mm = back(0).wrist_D_mm - left_from_->wrist_D_mm;
  const glm::dvec3 tip_went_mm = back(0).tip_D_mm - left_from_->tip_D_mm;
  left_ = left_ || glm::length(went_mm) > kLeft_mm || glm::length(tip_went_mm - went_mm) > 0.7 * kLeft_mm;

  if (sample.t_s - looked_s_ < kLook_s) return;
  looked_s_ = sample.t_s;
  progress_ = left_ ? std::min(1.0, stillness(sample.t_s, limits_.hold_s).still_s / limits_.hold_s) : 0.0;
}

StillCapture::Stillness StillCapture::stillness(double end_s, double most_s) const {
  Stillness found;
  // The newest sample that counts.
  std::size_t first = 0;
  while (first < count_ && back(first).t_s > end_s + 1e-9) ++first;
  if (first == count_) return found;

  // Means over 0.1 s, one each 20 ms, backwards in time, until one is no longer where the others were.
  Scatter wrist, tip;
  glm::dvec3 newest_wrist{0.0};
  std::size_t start = first;
  for (double at_s = end_s; end_s - (at_s - kMean_s) <= most_s + 1e-6; at_s -= kLook_s) {
    while (start < count_ && back(start).t_s > at_s + 1e-9) ++start;
    Scatter here_wrist, here_tip;
    double last_s = at_s;
    for (std::size_t i = start; i < count_ && back(i).t_s > at_s - kMean_s - 1e-9; ++i) {
      found.gap = found.gap || last_s - back(i).t_s > kGap_s;
      last_s = back(i).t_s;
      here_wrist.add(back(i).wrist_D_mm);
      here_tip.add(back(i).tip_D_mm);
    }
    found.gap = found.gap || last_s > at_s - kMean_s + kGap_s;
    if (found.gap || here_wrist.n < kLeastSamples / 2) break;

    if (wrist.n == 0) newest_wrist = here_wrist.mean;
    wrist.add(here_wrist.mean);
    tip.add(here_tip.mean);
    const double apart_s = end_s - at_s;
    const double speed = apart_s > 0.0 ? glm::length(newest_wrist - here_wrist.mean) / apart_s : 0.0;
    found.sd_mm = std::max(wrist.sd(), tip.sd());
    found.speed_mm_per_s = std::max(found.speed_mm_per_s, speed);
    for (std::size_t i = start; i < count_ && back(i).t_s > at_s - kMean_s - 1e-9; ++i)
      found.swing_mm = std::max(found.swing_mm, glm::length(back(i).wrist_D_mm - wrist.mean));
    const bool is_still = found.sd_mm <= limits_.sd_mm && found.speed_mm_per_s <= limits_.speed_mm_per_s &&
                          found.swing_mm <= limits_.swing_mm;
    if (wrist.n > 1 && !is_still) break;
    found.still_s = end_s - (at_s - kMean_s);
  }
  if (found.still_s > most_s - kLook_s + 1e-6) found.still_s = most_s;
  return found;
}

StillReading StillCapture::median(double end_s) const {
  StillReading take;
  std::vector<double> angles;
  for (std::size_t joint = 0; joint < 6; ++joint) {
    angles.clear();
    for (std::size_t i = 0; i < count_ && back(i).t_s > end_s - kMedian_s - 1e-9; ++i)
      if (back(i).t_s <= end_s + 1e-9) angles.push_back(back(i).raw_rad[joint]);
    if (angles.empty()) return take;
    take.raw_rad[joint] = calibration::medianOf(angles);
    take.samples = static_cast<int>(angles.size());
  }
  return take;
}

std::optional<StillReading> StillCapture::heldStill() const {
  if (progress_ < 1.0 || count_ == 0) return std::nullopt;
  StillReading take = median(back(0).t_s);
  if (take.samples < kLeastSamples) return std::nullopt;
  take.sd_mm = stillness(looked_s_, limits_.hold_s).sd_mm;
  return take;
}

std::optional<StillReading> StillCapture::before(double t_s, std::string& why) const {
  StillReading take = median(t_s);
  const Stillness found = stillness(t_s, kMedian_s);
  take.sd_mm = found.sd_mm;
  if (found.gap || take.samples < kLeastSamples)
    why = "the device sent too little: wait a moment, then press again";
  else if (found.speed_mm_per_s > limits_.speed_mm_per_s)
    why = fmt::format("moving at {:.0f} mm/s: hold still, then press", found.speed_mm_per_s);
  else if (found.still_s < kMedian_s)
    why =
        fmt::format("moving by {:.2f} mm: rest the hand, hold still, then press", std::max(found.sd_mm, limits_.sd_mm));
  else
    return take;
  return std::nullopt;
}

void StillCapture::waitForMove() {
  left_ = false;
  progress_ = 0.0;
  left_from_.reset();
  if (count_ > 0) left_from_ = back(0);
}

void StillCapture::forget() {
  count_ = 0;
  progress_ = 0.0;
  left_ = false;
  left_from_.reset();
}

}  // namespace app
