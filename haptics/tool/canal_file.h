// A root-canal file as chosen from its box: a size of ISO 3630-1, a length, a metal, bent or not before it goes in, and
// where its rubber stop sits (assets/instrument/k_file has the sizes, haptics/file how it lies in a canal). Part of a
// Tool, whose origin is where the file leaves its handle, +z away from the tip. mm, degrees. Plain values; any thread.
#pragma once

#include <optional>

#include "assets/instrument/k_file.h"

namespace haptics {

struct CanalFile {
  std::uint64_t size = 0;  ///< 1/100 mm at the tip; 0: none
  double length_mm = 25.0;
  bool nickel_titanium = false;
  double bent_deg = 0.0, bent_mm = 3.0;  ///< the last millimetres, along an arc
  double bent_towards_deg = 0.0;         ///< about the handle, from its x
  double stop_mm = 0.0;                  ///< of the rubber stop, from the tip; 0: pushed out of the way

  bool isChosen() const { return size != 0; }
  bool operator==(const CanalFile&) const = default;

  /// None: no such file is made.
  std::optional<assets::KFile> made() const {
    if (!(size > 0 && size <= 140 && length_mm >= 1.0 && length_mm <= 100.0)) return {};
    return assets::kFile(static_cast<int>(size), static_cast<int>(length_mm),
                         nickel_titanium ? assets::KFileMetal::nickel_titanium : assets::KFileMetal::steel);
  }
};

}  // namespace haptics
