#include "haptics/file/file_flutes.h"

#include <algorithm>
#include <numbers>

namespace haptics {

void FileFlutes::takeUp(const FileChain& chain) noexcept {
  links_ = chain.links;
  sharpness_ = 1.0;
  fullest_ = all_held_mm3_ = 0.0;
  held_mm3_.fill(0.0);
  room_mm3_.fill(0.0);
  // Between the wire and the circle around it.
  for (std::size_t i = 1; i <= links_; ++i) {
    const double r_mm = chain.radius_mm[i];
    room_mm3_[i] = (std::numbers::pi * r_mm * r_mm - chain.wire_mm2[i]) * chain.link_mm;
  }
}

void FileFlutes::add(std::size_t section, double taken_mm3) noexcept {
  const double loose_mm3 = kLooseChips * taken_mm3;
  loose_mm3_ += loose_mm3;
  held_mm3_[section] += taken_mm3 - loose_mm3;
  // One factor of e^(-V / V0), as small as it is.
  sharpness_ -= sharpness_ * std::min(1.0, taken_mm3 / kDulled_mm3);
}

void FileFlutes::rinse(double dt_s, bool irrigates, bool is_out) noexcept {
  const double washed = irrigates ? std::min(1.0, dt_s / (is_out ? kWashed_s : kWashedBeside_s)) : 0.0;
  loose_mm3_ -= washed * loose_mm3_;
  fullest_ = all_held_mm3_ = 0.0;
  for (std::size_t i = 1; i <= links_; ++i) {
    held_mm3_[i] = is_out ? 0.0 : held_mm3_[i] - washed * held_mm3_[i];
    all_held_mm3_ += held_mm3_[i];
    if (room_mm3_[i] > 0.0) fullest_ = std::max(fullest_, std::min(1.0, held_mm3_[i] / room_mm3_[i]));
  }
}

}  // namespace haptics
