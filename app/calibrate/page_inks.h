// Colours of the wizard's pages, on a ground that is nearly black: light in the other eye's picture is a ghost there.
// Told apart by people with any colour vision (Okabe, Ito 2008), and never alone: shapes and words say the same.
#pragma once

#include "app/report/screen_page.h"

namespace app {

inline constexpr Ink kGroundInk{0.02, 0.02, 0.03}, kWordInk{0.92, 0.92, 0.92}, kQuietInk{0.58, 0.60, 0.63},
    kPendingInk{0.40, 0.43, 0.47}, kFaintInk{0.25, 0.27, 0.30};
inline constexpr Ink kWantedInk{0.34, 0.71, 0.91};   ///< sky blue: what to do, where to go
inline constexpr Ink kPresentInk{0.94, 0.89, 0.26};  ///< yellow: where the stylus is
inline constexpr Ink kGoodInk{0.05, 0.72, 0.54};     ///< bluish green
inline constexpr Ink kDoubtInk{0.95, 0.66, 0.05};    ///< orange
inline constexpr Ink kBadInk{0.93, 0.42, 0.10};      ///< vermillion

inline Ink dimmed(const Ink& ink, double share) { return {ink.red * share, ink.green * share, ink.blue * share}; }

}  // namespace app
