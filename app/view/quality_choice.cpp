#include "app/view/quality_choice.h"

#include <algorithm>

namespace app {
namespace {

constexpr double kSlowestSmooth_s = 1.0 / 30.0;

double budgetOf_s(SurgeonDisplay& display) {
  const double refresh_s = 1.0 / display.refresh_Hz();
  return display.backend() == render::Backend::cpu ? std::max(refresh_s, kSlowestSmooth_s) : refresh_s;
}

}  // namespace

QualityChoice::QualityChoice(SurgeonDisplay& display, std::optional<int> held)
    : display_(display),
      held_(held.has_value()),
      budget_s_(budgetOf_s(display)),
      ladder_(budget_s_, held.value_or(0)) {}

}  // namespace app
