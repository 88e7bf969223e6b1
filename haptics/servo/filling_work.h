// What instruments that fill a tooth did in a tick, and what is in place after it. Part of a Tick; of the filling that
// a replay makes again. Plain values; any thread.
#pragma once

#include <cstdint>

namespace haptics {

struct FillingWork {
  bool works = false;    ///< lays, packs, carves or shines
  bool is_full = false;  ///< no more can be laid anywhere (bone/filling)
  /// Of what is laid now, from 1; light, packing what light does not set, or another material ends it.
  std::uint8_t increment = 0;
  double changed_mm3 = 0.0;  ///< by the instrument: laid, or carved away (below 0)
  double packed_mm3 = 0.0;   ///< pressed aside
  double total_mm3 = 0.0;    ///< in the tooth
  double cured_mm3 = 0.0;    ///< of it, that has set

  bool operator==(const FillingWork&) const = default;
};

}  // namespace haptics
