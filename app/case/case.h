// The named cases of the built-in patient: one impacted lower third molar each, from the easiest to the hardest. The
// one table of them: the list (`molar rehearse --cases`), the check of `--case`, the README and the start screen read
// it. Words and classes of a dentist: angulation after Winter (1926), depth and ramus after Pell and Gregory (1933),
// difficulty after Pederson (1988). Plain data, frame P where there is one; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/synthetic/jaw.h"

namespace app {

struct Case {
  std::string_view name;       ///< as on the command line
  assets::JawParameters jaw;   ///< what the built-in patient is made from
  std::string_view challenge;  ///< what is hard about it, one short line

  int fdi() const { return jaw.right_side ? 48 : 38; }
};

/// By difficulty; names are unique.
std::span<const Case> cases();

std::vector<std::string> caseNames();
/// With the practice blocks (assets/synthetic/practice_block): what can be rehearsed.
std::vector<std::string> rehearsalNames();

/// For --opening, which any of them can have.
inline constexpr const char* kOpeningHelp =
    "Built-in patient: opening of the mouth, mm between the incisal edges; below 35 it is trismus [37]";

/// nullptr: there is no case of that name.
const Case* caseNamed(std::string_view name);

/// The one that is rehearsed when nothing is asked for: JawParameters{}.
const Case& usualCase();

/// "mesio-angular, 45°".
std::string angulationText(const Case& one);
/// "8 mm under the occlusal plane, position C class II".
std::string depthText(const Case& one);
/// "canal 1 mm from the root", "canal touched by the root".
std::string canalText(const Case& one);

/// Pell and Gregory: A level with the second molar, B between its occlusal plane and its cervical line, C below that.
char pellGregoryPosition(const Case& one);
/// Pederson's sum of angulation, depth and ramus, 3 to 10: to 4 slight, to 6 moderate, from 7 high.
int pedersonScore(const Case& one);
std::string_view difficultyText(const Case& one);

/// The list for people, one line a case and one for what is hard about it.
std::string caseList();
/// Of the practice blocks.
std::string practiceList();

}  // namespace app
