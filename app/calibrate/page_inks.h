// Colours of the wizard's pages, on near-black: light in one eye's image is a ghost in the other's. Safe for all colour
// vision (Okabe, Ito 2008); shapes and text always say the same.
#pragma once

#include "app/report/screen_page.h"

namespace app {

inline constexpr Ink kGroundInk{0.02, 0.02, 0.03}, kWordInk{0.92, 0.92, 0.92}, kQuietInk{0.58, 0.60, 0.63},
    kPendingInk{0.40, 0.43, 0.47}, kFaintInk{0.25, 0.27, 0.30};
inline constexpr Ink kWantedInk{0.34, 0.71, 0.91};   ///< sky blue: what to do, the next target
inline constexpr Ink kPresentInk{0.94, 0.89, 0.26};  ///< yellow: the current stylus
inline constexpr Ink kGoodInk{0.05, 0.72, 0.54};     ///< bluish green
inline constexpr Ink kDoubtInk{0.95, 0.66, 0.05};    ///< orange
inline constexpr Ink kBadInk{0.93, 0.42, 0.10};      ///< vermillion

inline Ink dimmed(const Ink& ink, double share) { return {ink.red * share, ink.green * share, ink.blue * share}; }

}  // namespace app
