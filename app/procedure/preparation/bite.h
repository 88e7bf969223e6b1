// A bite on articulating paper (reference/sisters 5.4): the jaws close (jaw_closing.h) until the tooth meets what
// opposes it, at the latest where the rest of the teeth meet; paper of a thickness marks where the gap is not wider
// than it is. A mark's area tells where, never how hard (Open Dent J 2007, PMC2581523), so nothing is said of loads.
// Real papers are 8 to 200 µm thick, shimstock 8. Frame of the tooth, mm. Pure; any thread; some ms.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/procedure/preparation/antagonist.h"
#include "app/procedure/preparation/tooth_paint.h"

namespace app {

inline constexpr double kLeastPaper_um = 1.0, kUsualPaper_um = 40.0, kMostPaper_um = 500.0;

/// One mark.
struct BiteContact {
  glm::dvec2 place_mm{0.0};  ///< of its narrowest gap
  double gap_mm = 0.0;       ///< there
  double area_mm2 = 0.0;     ///< as seen along the way of closing
};

struct Bite {
  double paper_mm = 0.0;
  bool is_made = true;  ///< the antagonist
  assets::Closing closing = assets::Closing::axis;
  bool is_balanced = false;            ///< on three contacts around the middle
  double open_mm = 0.0;                ///< that the tooth keeps the jaws apart: how high it is
  double clearance_mm = 0.0;           ///< of the narrowest place when closed; 0: it touches
  std::optional<glm::dvec2> first_mm;  ///< where the tooth touches first; none: the rest of the teeth meet before
  std::vector<BiteContact> contacts;   ///< largest first
  OcclusalRaster gap_mm;               ///< when closed

  double area_mm2() const;
};

/// `heights`: of the tooth as it is. No clearance where nothing opposes the tooth: infinite.
Bite biteOn(const OcclusalRaster& heights, const Antagonist& antagonist, double paper_mm);

/// "hinge": of a command line and in a recording.
std::string_view nameOf(assets::Closing closing);
/// "mesiobuccal", "middle".
std::string placeName(const glm::dvec2& place_mm);
/// For the surgeon: "3 marks of 40 µm paper, 0.92 mm² in all"; "0.21 mm too high, distobuccal"; "free by 1.42 mm".
std::string biteLine(const Bite& bite);
/// Of the marks, on the tooth as it is.
PaintSpots biteSpots(const Crown& crown, const BoxBytes& solid, const OcclusalRaster& heights, const Bite& bite);
std::vector<render::SurfacePaint::Row> biteRows(const Bite& bite);

}  // namespace app
