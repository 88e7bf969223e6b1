#include "app/case/impaction_class.h"

#include <cstddef>

namespace app {

Angulation winterClass(double angle_deg) {
  if (angle_deg < -79.5 || angle_deg >= 100.5) return Angulation::inverted;
  if (angle_deg <= -10.5) return Angulation::disto_angular;
  if (angle_deg < 10.5) return Angulation::vertical;
  return angle_deg < 79.5 ? Angulation::mesio_angular : Angulation::horizontal;
}

std::string_view nameOf(Angulation angulation) {
  constexpr std::string_view kNames[] = {"disto-angular", "vertical", "mesio-angular", "horizontal", "inverted"};
  return kNames[static_cast<std::size_t>(angulation)];
}

char pellGregoryDepth(double depth_mm, double cervical_line_mm) {
  constexpr double kSameLevel_mm = 1.0;
  return depth_mm <= kSameLevel_mm ? 'A' : depth_mm <= cervical_line_mm ? 'B' : 'C';
}

int pellGregoryRamus(double covered_share) { return covered_share <= 0.05 ? 1 : covered_share < 0.95 ? 2 : 3; }

std::string_view ramusClassName(int ramus_class) { return ramus_class <= 1 ? "I" : ramus_class == 2 ? "II" : "III"; }

int pedersonSum(Angulation angulation, char depth, int ramus_class) {
  if (angulation == Angulation::inverted) return 0;
  constexpr int kByAngulation[] = {4, 3, 1, 2};
  return kByAngulation[static_cast<std::size_t>(angulation)] + (depth - 'A' + 1) + ramus_class;
}

std::size_t pedersonGrade(int sum) { return sum <= 4 ? 0 : sum <= 6 ? 1 : 2; }

std::string_view pedersonWord(int sum) {
  constexpr std::string_view kWords[] = {"slight", "moderate", "high"};
  return kWords[pedersonGrade(sum)];
}

}  // namespace app
