// What still held the tooth together at a moment (reference/product 4.2: O9): the thinnest bridge between the parts
// into which its cuts divide it, as a rehearsal looks for it live (haptics/body/tooth_survey). Frame P, mm, s. A pure
// function; any thread; some tens of ms.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "app/session/measures/removal_clock.h"

namespace app {

struct SectionLeft {
  double thickness_mm = 0.0, area_mm2 = 0.0;
};

/// `before`, `after`: solid; `is_tooth`: not 0 in the tooth; in the order of the clock's grid. Of what was cut before
/// `t_s`; none: all. None: the tooth is not cut to a bridge.
std::optional<SectionLeft> sectionLeft(const RemovalClock& clock, std::span<const std::uint8_t> before,
                                       std::span<const std::uint8_t> after, std::span<const std::uint8_t> is_tooth,
                                       std::optional<double> t_s);

}  // namespace app
