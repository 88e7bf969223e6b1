// What the surgeon reads in the picture: a line at its edge (bur, speed, water, force, gap, time), warnings and what
// was just said next to it, and on request the sheet of keys. Panels in the plane of the screen
// (render/display/overlay.h), each drawn again only when its own content changed. Never over the site: the line is at
// the lower edge, or at the upper one where the site is low in the picture; the ruler of clearances stands beside bur
// and site, where the shaft does not come in. Any one thread; a changed panel costs about 0.1 ms.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/report/drawing.h"
#include "assets/risk_structures.h"
#include "render/display/overlay.h"
#include "render/frame.h"

namespace app {

/// `danger`: harm or no force; otherwise a caution.
struct HeadUpWarning {
  std::string words;
  bool danger = false;
  bool operator==(const HeadUpWarning&) const = default;
};

/// The instruments of the tray around a place (app/controls/tool_ring).
struct HeadUpRing {
  std::vector<std::string> names;  ///< empty: closed
  std::size_t in_hand = 0;
  std::optional<std::size_t> chosen;  ///< none: in the middle
  glm::dvec2 middle{0.0};             ///< viewer's, in shares of the screen's height
};

/// A structure that the tool is near, for the ruler beside the site.
struct HeadUpClearance {
  std::string name;  ///< "canal"
  double mm = 0.0;   ///< below 0 inside
  assets::RiskLevel level = assets::RiskLevel::none;
  bool is_confirmed = true;  ///< false: of a tooth or canal that the program proposed; grey, without a band
};

/// What an apex locator shows.
struct HeadUpLocator {
  double left_mm = 0.0;  ///< to the foramen, 0 to 3
  bool is_apex = false;
};

struct HeadUpContent {
  bool line_shown = true;
  std::string bur;                          ///< "round 3.0 mm, ISO 030"
  std::string drive;                        ///< "40,000 rpm", "drill off"
  bool turning = false;                     ///< the bur
  bool irrigating = true;                   ///< water on
  double force_N = 0.0, force_share = 0.0;  ///< share of the device's limit
  std::optional<double> torque_Nmm;         ///< of an elevator, of the model: shown instead of the force
  double torque_share = 0.0;                ///< of what an elevator turns with at most
  std::optional<double> gap_mm;             ///< of the bur to bone or tooth; none: too far to show
  std::string ruler;                        ///< "ruler 7.3 mm"; empty: none
  double time_s = 0.0;
  std::string said;                      ///< just now; empty: nothing
  std::string task;                      ///< of an experiment; empty: none
  std::string site;                      ///< state of the socket; empty: none
  std::string way;                       ///< what keeps the tooth in; empty: not known
  std::optional<HeadUpLocator> locator;  ///< none: no file is in a canal
  HeadUpRing ring;
  std::vector<HeadUpClearance> clearances;                ///< the most urgent first; three are shown
  std::vector<HeadUpWarning> warnings;                    ///< the most important first; two are shown
  std::vector<std::pair<std::string, std::string>> keys;  ///< key and meaning; empty: no sheet
};

/// Where panels lie, in viewer's pixels.
struct HeadUpPlace {
  glm::ivec2 screen_px{0};     ///< of the whole screen
  int reserved_left_px = 0;    ///< a column that belongs to the CT slices
  bool at_top = false;         ///< the site is low in the picture
  double magnification = 1.0;  ///< of the letters, for displays that give an eye fewer lines
  /// Of the ruler beside bur and site: the edge towards them and the height of its middle; on the side that the shaft
  /// leaves free.
  glm::ivec2 ruler_px{0};
  bool ruler_at_left = false;
  bool operator==(const HeadUpPlace&) const = default;
};

/// For frames of this rig in a display mode.
HeadUpPlace headUpPlace(const calibration::Rig& rig, render::DisplayMode mode, const render::Frame& frame);

/// Of a point of the patient on the screen that the viewer sees, px from its top left.
glm::dvec2 placeOnScreen(const calibration::Rig& rig, const calibration::Point<calibration::Patient>& p_P);

class HeadUpLine {
 public:
  /// True if a panel changed.
  bool update(const HeadUpContent& content, const HeadUpPlace& place);
  const std::vector<render::OverlayPanel>& panels() const { return panels_; }

 private:
  struct Cell {
    std::string content;  ///< as text; an equal one is not drawn again
    glm::ivec2 corner_px{0}, size_px{1};
    std::function<void(const Drawing&)> draw;
  };
  std::vector<Cell> cells(const HeadUpContent& content, const HeadUpPlace& place) const;

  std::vector<std::string> drawn_;  ///< content of each panel
  std::vector<render::OverlayPanel> panels_;
  std::uint64_t serial_ = 0;
};

/// Height of a letter's line in pixels: 2.6 % of the screen's height (35 arc minutes where the screen is 300 mm high at
/// 500 mm), lower where the line would not fit the width.
double headUpTextHeight_px(const HeadUpPlace& place);

}  // namespace app
