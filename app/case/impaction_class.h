// Classes of an impacted lower third molar as dentists name them: angulation after Winter (1926), depth and ramus after
// Pell and Gregory (1933), difficulty after Pederson (1988). Cut-offs: reference/product 3.3, at half degrees. Shared
// by the named cases, whose parameters are known, and by the plan, which measures. Pure functions; any thread.
#pragma once

#include <cstddef>
#include <string_view>

namespace app {

enum class Angulation { disto_angular, vertical, mesio_angular, horizontal, inverted };
/// Of the third molar's long axis against the second molar's, positive: crown to mesial.
Angulation winterClass(double angle_deg);
std::string_view nameOf(Angulation angulation);

/// A level with the second molar, B between its occlusal plane and its cervical line, C below that. Depth of the third
/// molar's highest point and of that line under the plane.
char pellGregoryDepth(double depth_mm, double cervical_line_mm);

/// I, II or III as 1 to 3, by the share of the crown's mesiodistal diameter for which there is no room between second
/// molar and ramus.
int pellGregoryRamus(double covered_share);
std::string_view ramusClassName(int ramus_class);

/// Pederson's sum, 3 to 10; 0 for an inverted tooth, which his index leaves out.
int pedersonSum(Angulation angulation, char depth, int ramus_class);
/// 0 to 4 of the sum, 1 to 6, 2 from 7.
std::size_t pedersonGrade(int sum);
/// To 4 slight, to 6 moderate, from 7 high.
std::string_view pedersonWord(int sum);

}  // namespace app
