#include "app/case/case.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/case/impaction_class.h"
#include "assets/synthetic/practice_block.h"
#include "assets/synthetic/preparation_block.h"
#include "assets/tooth.h"

namespace app {
namespace {

/// Crown height of the built-in patient's second molar: its cervical line under the occlusal plane, mm.
constexpr double kSecondMolarCrown_mm = 7.6;
/// Between the second molar and the ramus there is less room than the crown is wide, in this jaw always.
constexpr int kRamusClass = 2;

constexpr assets::JawParameters jawOf(bool right_side, double winter_angle_deg, double depth_mm, double canal_mm) {
  return {.right_side = right_side,
          .winter_angle_deg = winter_angle_deg,
          .depth_mm = depth_mm,
          .mandibular_canal_distance_mm = canal_mm};
}

constexpr std::array kCases{
    Case{"shallow", jawOf(false, 30.0, 6.5, 3.0), "part of the crown is free of bone: a short gutter is enough"},
    Case{"usual", {}, "the crown lies under bone against the second molar: its distal half has to be divided off"},
    Case{"usual-left", jawOf(false, 45.0, 8.0, 1.0), "the mirror image of usual, for the other hand's side"},
    Case{"canal-touched", jawOf(true, 60.0, 9.5, 0.0), "a root lies against the nerve: no force and no bur below it"},
    Case{"deep", jawOf(true, 50.0, 11.0, 0.5), "a thick roof of bone: long to expose, little room beside it"},
    Case{"horizontal", jawOf(true, 90.0, 9.0, 0.8), "the crown must be cut from the roots before anything moves"},
    Case{"horizontal-left", jawOf(false, 90.0, 9.0, 0.8), "the mirror image of horizontal"},
    Case{"vertical", jawOf(true, 5.0, 9.0, 1.5),
         "it stands upright in bone on all sides: the gutter is deep and narrow"},
    Case{"disto-angular", jawOf(false, -30.0, 8.5, 1.5), "the crown lies under the ramus and its way out is backwards"},
};

Angulation angulationOf(const Case& one) { return winterClass(one.jaw.winter_angle_deg); }

}  // namespace

std::span<const Case> cases() { return kCases; }

std::vector<std::string> caseNames() {
  std::vector<std::string> names;
  for (const Case& one : kCases) names.emplace_back(one.name);
  return names;
}

std::vector<std::string> rehearsalNames() {
  std::vector<std::string> names = caseNames();
  for (const assets::PracticeText& block : assets::kPracticeTasks) names.emplace_back(block.key);
  for (const assets::PreparationBlock& block : assets::kPreparationBlocks) names.emplace_back(block.key);
  return names;
}

std::string practiceList() {
  std::string text;
  for (const assets::PracticeText& block : assets::kPracticeTasks)
    text += fmt::format("{:<16} {}, round bur of {:g} mm\n", block.key, block.instruction, 2.0 * block.bur_radius_mm);
  for (const assets::PreparationBlock& block : assets::kPreparationBlocks)
    text += fmt::format("{:<16} {}\n", block.key, block.instruction);
  return text;
}

const Case* caseNamed(std::string_view name) {
  const auto found = std::ranges::find(kCases, name, &Case::name);
  return found == kCases.end() ? nullptr : &*found;
}

const Case& usualCase() { return *caseNamed("usual"); }

std::string angulationText(const Case& one) {
  return fmt::format("{}, {:g}°", nameOf(angulationOf(one)), std::abs(one.jaw.winter_angle_deg));
}

std::string depthText(const Case& one) {
  return fmt::format("{:g} mm under the occlusal plane, position {} class {}", one.jaw.depth_mm,
                     pellGregoryPosition(one), ramusClassName(kRamusClass));
}

std::string canalText(const Case& one) {
  const double distance_mm = one.jaw.mandibular_canal_distance_mm;
  return distance_mm > 0.0 ? fmt::format("canal {:g} mm from the root", distance_mm)
                           : std::string("canal touched by the root");
}

char pellGregoryPosition(const Case& one) { return pellGregoryDepth(one.jaw.depth_mm, kSecondMolarCrown_mm); }

int pedersonScore(const Case& one) { return pedersonSum(angulationOf(one), pellGregoryPosition(one), kRamusClass); }

std::string_view difficultyText(const Case& one) { return pedersonWord(pedersonScore(one)); }

std::string caseList() {
  std::string text;
  for (const Case& one : cases())
    text += fmt::format("{:<16} {}, {}; {}; {}\n{:<16} {} ({} of 10 after Pederson): {}\n", one.name,
                        assets::toothName(one.fdi()), angulationText(one), depthText(one), canalText(one), "",
                        difficultyText(one), pedersonScore(one), one.challenge);
  return text;
}

}  // namespace app
