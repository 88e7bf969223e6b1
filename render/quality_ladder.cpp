#include "render/quality_ladder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace render {
namespace {

constexpr std::size_t kWindow = 9;            ///< frames of the median, so that one slow frame changes nothing
constexpr std::size_t kFarTooLateWindow = 3;  ///< frames of the median if they are far too late
constexpr double kFarTooLate = 2.5;           ///< of the budget: down several steps
constexpr double kLate = 1.05;                ///< of the budget: down
constexpr double kEasy = 0.85;                ///< of the budget, predicted for the better step: up
constexpr double kFirstClimbAfter_s = 2.0;
constexpr double kLongestClimbAfter_s = 64.0;
constexpr double kLeastPart = 0.1;       ///< of a step's cost, as a logarithm, however little a descent saved
constexpr double kClimbProved_s = 10.0;  ///< a climb that lasted this long succeeded

constexpr int kWorst = static_cast<int>(kQualitySteps.size()) - 1;

}  // namespace

QualityLadder::QualityLadder(double budget_s, int first_step)
    : budget_s_(budget_s), step_(std::clamp(first_step, 0, kWorst)), climb_after_s_(kFirstClimbAfter_s) {
  for (std::size_t n = 0; n < kQualitySteps.size(); ++n) climb_cost_[n] = kQualitySteps[n].climb_cost;
}

double QualityLadder::typical_s() const {
  std::vector<double> sorted(recent_s_.begin(), recent_s_.end());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  return sorted[sorted.size() / 2];
}

std::optional<int> QualityLadder::goTo(int step) {
  step_ = step;
  recent_s_.clear();
  calm_s_ = 0.0;
  return step;
}

// What all steps of a descent saved together, spread as the table has it.
void QualityLadder::learnCost(double typical_s) {
  double of_table = 1.0;
  for (int step = descent_->from + 1; step <= step_; ++step)
    of_table *= kQualitySteps[static_cast<std::size_t>(step)].climb_cost;
  const double part = std::clamp(std::log(descent_->left_at_s / typical_s) / std::log(of_table), kLeastPart, 1.0);
  for (int step = descent_->from + 1; step <= step_; ++step)
    climb_cost_[static_cast<std::size_t>(step)] =
        std::pow(kQualitySteps[static_cast<std::size_t>(step)].climb_cost, part);
  descent_.reset();
}

std::optional<int> QualityLadder::add(double frame_s, bool may_change) {
  recent_s_.push_back(frame_s);
  if (recent_s_.size() > kWindow) recent_s_.pop_front();
  since_climb_s_ += frame_s;
  if (since_climb_s_ > kClimbProved_s && since_climb_s_ < 2.0 * kClimbProved_s) climb_after_s_ = kFirstClimbAfter_s;
  const double typical = typical_s();
  const bool far_too_late = typical > kFarTooLate * budget_s_;
  if (recent_s_.size() < (far_too_late ? kFarTooLateWindow : kWindow)) return std::nullopt;
  if (descent_ && recent_s_.size() == kWindow) learnCost(typical);
  const double climb_cost = climb_cost_[static_cast<std::size_t>(step_)];
  const bool easy = step_ > 0 && typical * climb_cost < kEasy * budget_s_;
  calm_s_ = easy ? calm_s_ + std::max(frame_s, budget_s_) : 0.0;
  if (!may_change) return std::nullopt;

  if (typical > kLate * budget_s_ && step_ < kWorst) {
    // Down again soon after a climb: the climb failed.
    if (since_climb_s_ < kClimbProved_s) climb_after_s_ = std::min(2.0 * climb_after_s_, kLongestClimbAfter_s);
    since_climb_s_ = 1e9;
    int to = step_ + 1;
    double expected_s = typical / kQualitySteps[static_cast<std::size_t>(to)].climb_cost;
    while (far_too_late && to < kWorst && expected_s > budget_s_)
      expected_s /= kQualitySteps[static_cast<std::size_t>(++to)].climb_cost;
    if (!descent_) descent_ = Descent{step_, typical};
    return goTo(to);
  }
  if (calm_s_ > climb_after_s_) {
    since_climb_s_ = 0.0;
    descent_.reset();
    return goTo(step_ - 1);
  }
  return std::nullopt;
}

}  // namespace render
