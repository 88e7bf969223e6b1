// What use does to a file's flutes and edges, and what of it stays in the canal (reference/sisters 2.1). What a section
// takes from the wall fills its flutes; full ones take nothing until the file is out of the tooth and wiped, or water
// has washed them. A fifth of it lies loose in the canal until it is washed out. Edges get dull: eta e^(-V / V0). Own
// defaults, none measured: the loose share, V0, the times of washing with the file in the canal and out of it. mm3, s.
// Servo thread: no allocation; a µs.
#pragma once

#include "haptics/file/file_chain.h"

namespace haptics {

inline constexpr double kLooseChips = 0.2;
inline constexpr double kDulled_mm3 = 3.0;  ///< V0
inline constexpr double kWashedBeside_s = 8.0, kWashed_s = 1.5;

class FileFlutes {
 public:
  /// Another file, new and clean: what the one before held is out with it.
  void takeUp(const FileChain& chain) noexcept;

  /// Of a section's wear by its law: 0 where its flutes are full.
  double eta(std::size_t section) const noexcept { return isFull(section) ? 0.0 : sharpness_; }
  bool isFull(std::size_t section) const noexcept { return held_mm3_[section] >= room_mm3_[section]; }
  /// Taken from the wall there.
  void add(std::size_t section, double taken_mm3) noexcept;
  /// After each tick. `is_out`: the tip is out of the tooth, so it is wiped.
  void rinse(double dt_s, bool irrigates, bool is_out) noexcept;

  double sharpness() const noexcept { return sharpness_; }  ///< 1 when new
  double fullest() const noexcept { return fullest_; }      ///< largest share of a section's flutes, 0 to 1
  double held_mm3() const noexcept { return all_held_mm3_; }
  double loose_mm3() const noexcept { return loose_mm3_; }
  /// Not out of the canal: loose, and in the flutes of the file in it.
  double left_mm3() const noexcept { return loose_mm3_ + all_held_mm3_; }

 private:
  PerNode<double> room_mm3_{}, held_mm3_{};
  std::size_t links_ = 0;
  double sharpness_ = 1.0, fullest_ = 0.0, all_held_mm3_ = 0.0, loose_mm3_ = 0.0;
};

}  // namespace haptics
