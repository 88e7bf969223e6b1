// A root-canal file as chosen from its box: a size of ISO 3630-1, a length, a metal, bent or not before it goes in, and
// where its rubber stop sits; or a cone of gutta-percha for its filling, with a taper and sealer on it
// (assets/instrument/k_file and gutta_percha_cone have the sizes, haptics/file how both lie in a canal). Part of a
// Tool, whose origin is where the file leaves its handle, or the cone its pliers, +z away from the tip. mm, degrees.
// Plain values; any thread.
#pragma once

#include <optional>

#include "assets/instrument/gutta_percha_cone.h"
#include "assets/instrument/k_file.h"

namespace haptics {

struct CanalFile {
  std::uint64_t size = 0;  ///< 1/100 mm at the tip; 0: none
  double length_mm = 25.0;
  bool nickel_titanium = false;
  double bent_deg = 0.0, bent_mm = 3.0;  ///< the last millimetres, along an arc
  double bent_towards_deg = 0.0;         ///< about the handle, from its x
  double stop_mm = 0.0;                  ///< of the rubber stop, from the tip; 0: pushed out of the way
  double cone_taper = 0.0;               ///< of a cone of gutta-percha, mm a mm; 0: it is a file
  double sealer_mm3 = 0.0;               ///< brought in on a cone

  bool isChosen() const { return size != 0; }
  bool isCone() const { return isChosen() && cone_taper != 0.0; }
  bool operator==(const CanalFile&) const = default;

  /// None: no such file is made, or it is a cone.
  std::optional<assets::KFile> made() const {
    if (!(size > 0 && size <= 140 && cone_taper == 0.0 && length_mm >= 1.0 && length_mm <= 100.0)) return {};
    return assets::kFile(static_cast<int>(size), static_cast<int>(length_mm),
                         nickel_titanium ? assets::KFileMetal::nickel_titanium : assets::KFileMetal::steel);
  }
  /// None: it is a file, or no such cone is made.
  std::optional<assets::GuttaPerchaCone> cone() const {
    if (!(size > 0 && size <= 140)) return {};
    return assets::guttaPerchaCone(static_cast<int>(size), cone_taper, length_mm);
  }
};

}  // namespace haptics
