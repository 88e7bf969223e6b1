#include "app/rehearsal/ruler.h"

#include <fmt/core.h>

namespace app {
namespace {

std::string placeText(const glm::dvec3& p_P_mm) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", p_P_mm.x, p_P_mm.y, p_P_mm.z);
}

}  // namespace

calibration::Point<calibration::Patient> markedPoint(const render::Frame& frame, const haptics::BurShape& head) {
  if (frame.gap) return frame.gap->nearest_P;
  return frame.X_PT * calibration::Point<calibration::Tool>{{0.0, 0.0, -haptics::halfHeight_mm(head)}};
}

std::optional<render::RulerLine> rulerAfterMark(const std::optional<render::RulerLine>& ruler,
                                                const calibration::Point<calibration::Patient>& point_P) {
  if (!ruler) return render::RulerLine{point_P, {}};
  if (!ruler->to_P) return render::RulerLine{ruler->from_P, point_P};
  return {};
}

std::string rulerText(const std::optional<render::RulerLine>& ruler) {
  if (!ruler) return {};
  return ruler->to_P ? fmt::format("ruler {:.1f} mm", ruler->length_mm()) : "ruler: 2nd point";
}

std::string rulerEvent(const std::optional<render::RulerLine>& ruler) {
  if (!ruler) return "cleared";
  const std::string from = placeText(ruler->from_P.mm);
  if (!ruler->to_P) return "first point " + from + " mm";
  return fmt::format("{:.2f} mm from {} to {} mm", ruler->length_mm(), from, placeText(ruler->to_P->mm));
}

}  // namespace app
