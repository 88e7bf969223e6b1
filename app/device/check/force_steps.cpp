#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <fmt/core.h>

#include "app/device/check/check_steps.h"

namespace app {
namespace {

constexpr double kSign_N = 0.5, kMinForce_N = 0.05;
constexpr std::array<double, 3> kSteps_N = {0.3, 0.6, 1.0};
constexpr double kMaxGrams = 2000.0;
constexpr double kScaleTolerance = 0.1;  ///< a kitchen balance and a hand have 5 %

/// At most four fifths of the force limit.
double within(const CheckBench& bench, double force_N) {
  return std::min(force_N, 0.8 * bench.hand.limits().peak_force_N);
}

/// Possible answers; the first three are the directions pushed.
struct Way {
  char answer;
  const char* name;
  glm::dvec3 DeviceAxes::*axis = nullptr;
};
constexpr std::array<Way, 7> kWays = {{{'r', "right", &DeviceAxes::right_D},
                                       {'u', "up", &DeviceAxes::up_D},
                                       {'t', "towards you", &DeviceAxes::towards_D},
                                       {'l', "left"},
                                       {'d', "down"},
                                       {'a', "away from you"},
                                       {'n', "nothing"}}};

struct Step {
  double up_N = 0.0;
  const char* way = "";
};

/// Down first, as a balance measures.
std::vector<Step> stepsOf(const CheckBench& bench) {
  std::vector<Step> steps;
  for (const double force_N : kSteps_N) steps.push_back({-within(bench, force_N), "down"});
  for (const double force_N : kSteps_N) steps.push_back({within(bench, force_N), "up"});
  return steps;
}

}  // namespace

bool checkForceSign(CheckBench& bench, bool& sign_is_right) {
  sign_is_right = true;
  if (!bench.confirm(
          OwnerTask::hold,
          fmt::format("It will push with {:.1f} N, as much as 50 g weigh. Hold the handle loosely in the middle.",
                      within(bench, kSign_N))))
    return false;
  for (const Way& side : std::span(kWays).first(3)) {
    const glm::dvec3 axis_D = bench.axes.*side.axis;
    const glm::dvec3 before_mm = bench.hand.newest().state.X_DH.translation_mm;
    const bool steady = pushUntilSteady(bench, within(bench, kSign_N) * axis_D);
    const ConstantForceLoop::Seen pushed = bench.hand.newest();
    const auto answer =
        bench.dialogue.choice("Which way does it push? r l u d t(owards you) a(way) n(othing):", "rludtan");
    letGo(bench);
    if (!answer) return false;
    const double moved_mm = glm::dot(pushed.state.X_DH.translation_mm - before_mm, axis_D);
    const bool is_right = *answer == side.answer && steady;
    sign_is_right = sign_is_right && is_right;
    bench.saw(std::string("pushes ") + side.name, side.name,
              fmt::format("{}, moved {:+.1f} mm", std::ranges::find(kWays, *answer, &Way::answer)->name, moved_mm) +
                  (steady ? "" : ", the safety layer delivered only " + newtons(pushed.lately_D_N)),
              is_right);
    if (*answer != 'n' && std::ranges::count(bench.report.confirmed, Evidence::moves) == 0)
      bench.report.confirmed.push_back(Evidence::moves);
  }
  if (sign_is_right) bench.report.confirmed.push_back(Evidence::force_sign);
  return true;
}

bool checkForceScale(CheckBench& bench, std::vector<ForceReading>& readings) {
  Dialogue& dialogue = bench.dialogue;
  dialogue.say("  Stand a cup with 200 g of water on a kitchen balance, and tape the handle to it from above, so that");
  dialogue.say("  it can press and lift. Minus where the balance shows less than at first.");
  const auto nothing_g = dialogue.number("No force yet. What does the balance show, in g?", -kMaxGrams, kMaxGrams);
  if (!nothing_g) return false;
  for (const Step& step : stepsOf(bench)) {
    pushUntilSteady(bench, step.up_N * bench.axes.up_D);
    const auto shown_g = dialogue.number(
        fmt::format("It pushes {} with {:.1f} N. What does it show, in g?", step.way, std::abs(step.up_N)), -kMaxGrams,
        kMaxGrams);
    const double given_N = -glm::dot(bench.hand.newest().lately_D_N, bench.axes.up_D);
    letGo(bench);
    if (!shown_g) return false;
    if (std::abs(given_N) < kMinForce_N) {
      bench.saw(fmt::format("{} with {:.1f} N", step.way, std::abs(step.up_N)), "a force",
                "the safety layer let none through", false);
      continue;
    }
    readings.push_back({given_N, (*shown_g - *nothing_g) / kGrams_per_N});
    bench.saw(fmt::format("{} with {:.2f} N", step.way, std::abs(given_N)),
              fmt::format("{:.0f} g", given_N * kGrams_per_N), fmt::format("{:.0f} g", *shown_g - *nothing_g), true);
  }
  if (readings.size() < 2) return true;
  const ForceScaleFit fit = forceScale(readings);
  bench.saw("scale of the force", "1.00 ± 0.10",
            fmt::format("{:.3f} ± {:.3f}, offset {:+.2f} N, farthest {:.2f} N off", fit.scale, fit.scale_error,
                        fit.offset_N, fit.worst_N),
            std::abs(fit.scale - 1.0) <= kScaleTolerance, Evidence::force_scale);
  return true;
}

}  // namespace app
