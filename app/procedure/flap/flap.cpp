#include "app/procedure/flap/flap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace app {
namespace {

constexpr double kUnderGum_deep_mm = 0.4;  // the elevator's tip: under the gum
constexpr double kTunnel_mm = 0.8;         // deeper in gum that is whole: a tear
constexpr double kWorks_mm_per_s = 1.0;    // slower, the elevator rests
constexpr double kPause_s = 0.5;           // between two events of a kind
constexpr double kBurReach_mm = 0.3;       // of the bur beyond its head
constexpr double kTakesShare = 0.85;       // so much is free: the assistant takes it
constexpr double kClear_mm = 6.0;          // of the elevator, for the assistant
constexpr double kPull_s = 2.5;            // to turn it over
constexpr double kTight_N = 4.0;           // drawn no farther
constexpr double kAwayShare = 0.8;         // of what the plan bares, the rest lies at the base
constexpr double kAway_mm = 1.5;           // from where it lay: aside
constexpr double kTurned_rad = 0.7;        // from straight up, towards the cheek
constexpr double kStretched = 0.92;        // of its length from base to edge, turned up
constexpr double kOverPlace_mm = 1.0;
constexpr double kFront_mm = 6.0;  // of the incision: where a releasing cut begins
constexpr double kAtPapilla_mm = 1.5, kUnderMargin_mm = 2.5;

glm::dvec3 alongTool(const haptics::Tick& tick, double z_mm) {
  return tick.proxy_P.mm + tick.heldRotation() * glm::dvec3(0.0, 0.0, z_mm);
}

/// From the highest to the lowest place of the incision's front.
double releasingCut_mm(const std::vector<IncisionPoint>& points, double front_m) {
  const IncisionPoint *low = nullptr, *high = nullptr;
  for (const IncisionPoint& point : points) {
    if (point.at.m_mm < front_m - kFront_mm) continue;
    if (low == nullptr || point.at.angle_rad > low->at.angle_rad) low = &point;
    if (high == nullptr || point.at.angle_rad < high->at.angle_rad) high = &point;
  }
  return low != nullptr ? glm::distance(low->at_P_mm, high->at_P_mm) : 0.0;
}

bool meets(const haptics::Tick& tick) { return tick.depth_mm > 0.0; }

}  // namespace

Flap::Flap(const assets::Patient& patient, const assets::MeshModel& gum_P, const assets::PlannedCut& cut,
           const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P)
    : soft_(soft_tissue),
      chart_(gum_P, patient.ct, cut),
      plan_(chart_, patient, cut),
      down_P_(down_P),
      incision_(chart_) {}

void Flap::follow(const haptics::Tick& tick, const haptics::Command& command) {
  met_bone_ = met_bone_ || meets(tick);
  const auto frame = static_cast<std::int64_t>(std::floor((tick.t_s + tick.dt_s) / FlapSheet::kFrame_s));
  if (frame == frame_) return;
  frame_ = frame;
  step(tick, command);
  met_bone_ = false;
}

void Flap::step(const haptics::Tick& tick, const haptics::Command& command) {
  const haptics::HandInstrument in_hand = command.tool.hand_instrument;
  std::optional<Incision::Blade> blade;
  if (in_hand == haptics::HandInstrument::scalpel_15)
    blade = Incision::Blade{alongTool(tick, -command.tool.head.radius_mm), met_bone_};
  if (incision_.follow(blade, FlapSheet::kFrame_s)) ++incision_revision_;

  std::optional<FlapSheet::Instrument> elevator;
  if (in_hand == haptics::HandInstrument::periosteal) {
    raise(tick);
    elevator = FlapSheet::Instrument{tick.proxy_P.mm, tick.heldRotation() * glm::dvec3(0.0, 0.0, 1.0)};
  }
  elevator_before_P_mm_.reset();
  if (elevator) elevator_before_P_mm_ = elevator->tip_P_mm;
  touch(tick, command.tool);
  retract(command);
  if (!sheet_ || !sheet_->anyFree()) return;
  const FlapSheet::GroundAt ground = [this](const glm::dvec3& p) -> FlapSheet::Ground {
    const ChartPlace at = chart_.placeOf(p);
    if (!chart_.contains(at)) return {10.0, {}};
    return {chart_.radiusOf_mm(p) - chart_.bone_mm(at), chart_.outward_P(at)};
  };
  sheet_->step({ground, elevator ? &*elevator : nullptr, down_P_});
  ++sheet_revision_;
}

/// Under the gum the elevator peels next to the incision; elsewhere it tears.
void Flap::raise(const haptics::Tick& tick) {
  const glm::dvec3 tip = tick.proxy_P.mm;
  const double depth_mm = chart_.depth_mm(tip);
  const ChartPlace at = chart_.placeOf(tip);
  const bool moves =
      elevator_before_P_mm_ && glm::distance(*elevator_before_P_mm_, tip) > kWorks_mm_per_s * FlapSheet::kFrame_s;
  if (!chart_.contains(at) || depth_mm < kUnderGum_deep_mm || !moves) return;
  laySheet();
  if (sheet_ && sheet_->isOpenAt(tip)) {
    if (sheet_->peel(tip) > 0) ++sheet_revision_;
    return;
  }
  if (depth_mm < kTunnel_mm || depth_mm > 8.0 || !chart_.isGum(at)) return;
  if (tick.t_s >= tear_s_) {
    ++tears_;
    news_.push_back("the elevator tears gum that is not cut through: begin at the incision");
  }
  tear_s_ = tick.t_s + kPause_s;
}

/// Anew where the incision has become longer; what was free stays so.
void Flap::laySheet() {
  std::size_t full = 0;
  for (const IncisionPoint& point : incision_.points()) full += point.is_full ? 1 : 0;
  if (full == points_in_sheet_) return;
  points_in_sheet_ = full;
  std::optional<FlapSheet> laid = sheetFor(chart_, plan_, incision_);
  if (!laid) return;
  if (sheet_) {
    laid->takeOver(*sheet_);
  }
  sheet_ = std::move(laid);
  over_bared_.clear();
  for (const ChartPlace& place : plan_.bared()) {
    const glm::dvec3 p = chart_.surface_P_mm(place);
    const std::vector<SheetVertex>& all = sheet_->vertices();
    const auto nearest =
        std::ranges::min_element(all, {}, [&](const SheetVertex& v) { return glm::distance(v.home_P_mm, p); });
    over_bared_.push_back(glm::distance(nearest->home_P_mm, p) < kOverPlace_mm
                              ? std::optional(static_cast<std::size_t>(nearest - all.begin()))
                              : std::nullopt);
  }
  ++sheet_number_, ++sheet_revision_;
}

double Flap::raisedShare() const {
  if (!sheet_ || plan_.bared().empty()) return 0.0;
  double free = 0.0;
  for (const auto& vertex : over_bared_) free += vertex && sheet_->vertices()[*vertex].isFree() ? 1.0 : 0.0;
  return free / static_cast<double>(plan_.bared().size());
}

double Flap::freeShare() const {
  if (!sheet_) return 0.0;
  double free = 0.0, all = 0.0;
  for (const SheetVertex& v : sheet_->vertices()) all += v.is_attached ? 0.0 : 1.0, free += v.isFree() ? 1.0 : 0.0;
  return all > 0.0 ? free / all : 0.0;
}

/// A place deep in cheek or lip moves out of it; a little they give way.
glm::dvec3 Flap::besideCheek(const glm::dvec3& p_P_mm) const {
  constexpr int kSteps = 12;
  constexpr double kGivesWay_mm = 2.5;
  glm::dvec3 p = p_P_mm;
  for (int n = 0; n < kSteps; ++n) {
    const FlapSheet::Ground cheek = cheekAt(p);
    if (cheek.above_mm >= -kGivesWay_mm) break;
    p += std::min(1.0, -kGivesWay_mm - cheek.above_mm) * cheek.out_P;
  }
  return p;
}

/// Lip, cheek and the mouth's lining, which the flap is turned against.
FlapSheet::Ground Flap::cheekAt(const glm::dvec3& p_P_mm) const {
  const assets::SoftTissueField::Sample soft = soft_.at(p_P_mm);
  const double slope = glm::length(soft.gradient_P);
  const assets::SoftTissue tissue = soft_.tissueAt(p_P_mm);
  if (tissue == assets::SoftTissue::none || tissue == assets::SoftTissue::gingiva ||
      tissue == assets::SoftTissue::flap || slope < 0.2)
    return {10.0, {}};
  return {soft.distance_mm, soft.gradient_P / slope};
}

/// Asked for by hand it takes what is free at once; else it waits until the flap is raised and the elevator away.
void Flap::retract(const haptics::Command& command) {
  const bool asked = command.assistant_holds, newly = asked && !std::exchange(asked_before_, asked);
  if (newly) gave_up_ = false;
  if (!sheet_) return;
  if (!asked) return sheet_->letGo();
  if (!sheet_->isHeld()) {
    const bool is_clear = !elevator_before_P_mm_ || std::ranges::none_of(sheet_->vertices(), [&](const SheetVertex& v) {
      return glm::distance(v.home_P_mm, *elevator_before_P_mm_) < kClear_mm;
    });
    const bool is_ready = freeShare() >= kTakesShare && is_clear;
    if (gave_up_ || !(newly || is_ready) || !sheet_->hold()) return;
    pulled_ = 0.0;
  }
  // What is raised is drawn until it is tight; what is not, until it slips.
  const double eased = freeShare() < kTakesShare ? 1.0 : std::clamp(1.0 - sheet_->held_N() / kTight_N, 0.0, 1.0);
  pulled_ = std::min(1.0, pulled_ + eased * FlapSheet::kFrame_s / kPull_s);
  // About the base: up, over, and towards the cheek.
  const auto goal = [&](std::size_t vertex) {
    const int column = static_cast<int>(vertex % static_cast<std::size_t>(sheet_->columns()));
    const glm::dvec3 hinge = sheet_->vertices()[sheet_->index(column, sheet_->rows() - 1)].home_P_mm;
    const glm::dvec3 arm = sheet_->vertices()[vertex].home_P_mm - hinge;
    const double b = glm::dot(arm, chart_.buccal_P()), u = glm::dot(arm, chart_.up_P());
    const double from = std::atan2(b, u), turned = from + pulled_ * (kTurned_rad - from);
    // Rows are evenly spaced from the edge to the base.
    const double row = static_cast<double>(vertex / static_cast<std::size_t>(sheet_->columns()));
    const double flat_mm = kStretched * sheet_->columnLength_mm(column) * (1.0 - row / (sheet_->rows() - 1));
    const double chord_mm = std::hypot(b, u), length_mm = chord_mm + pulled_ * (flat_mm - chord_mm);
    return hinge + glm::dot(arm, chart_.mesial_P()) * chart_.mesial_P() +
           length_mm * (std::sin(turned) * chart_.buccal_P() + std::cos(turned) * chart_.up_P());
  };
  sheet_->pull(pulled_, goal, [this](const glm::dvec3& middle) { return besideCheek(middle) - middle; });
  if (!told_raised_ && isAside()) {
    told_raised_ = true;
    news_.push_back("the flap is raised and held: the bone lies bare");
  }
  if (sheet_->held_N() <= FlapSheet::kSlip_N) return;
  sheet_->letGo();
  gave_up_ = true;
  ++slips_;
  news_.push_back("the retractor slips: raise more of the flap first");
}

void Flap::touch(const haptics::Tick& tick, const haptics::Tool& tool) {
  if (!sheet_ || !tick.drilling) return;
  const double half_mm = std::max(0.0, haptics::halfHeight_mm(tool.head) - tool.head.radius_mm);
  int torn = 0;
  for (int n = 0; n <= 4; ++n)
    torn += sheet_->tear(alongTool(tick, half_mm * (0.5 * n - 1.0)), tool.head.radius_mm + kBurReach_mm);
  if (torn == 0) return;
  ++sheet_revision_;
  if (tick.t_s >= bur_s_) {
    ++bur_touches_;
    news_.push_back("the bur tears the flap");
  }
  bur_s_ = tick.t_s + kPause_s;
}

bool Flap::isAside() const {
  if (!sheet_ || !sheet_->isHeld() || raisedShare() < kRaisedShare) return false;
  std::size_t away = 0;
  for (const auto& vertex : over_bared_) {
    if (!vertex) continue;
    const SheetVertex& v = sheet_->vertices()[*vertex];
    away += glm::distance(v.at_P_mm, v.home_P_mm) > kAway_mm ? 1 : 0;
  }
  return static_cast<double>(away) >= kAwayShare * static_cast<double>(over_bared_.size());
}

FlapRecord Flap::record() const {
  FlapRecord record;
  record.incision_mm = incision_.length_mm();
  record.full_share = incision_.fullShare();
  double front_m = -std::numeric_limits<double>::infinity();
  const std::vector<IncisionPoint>& points = incision_.points();
  for (std::size_t n = 0; n < points.size(); ++n) {
    const ChartPlace& at = points[n].at;
    const double off_mm = acrossGum_mm(chart_, at.m_mm, plan_.lingualCrest_rad(at.m_mm), at.angle_rad);
    record.lingual_mm = std::min(record.lingual_mm.value_or(off_mm), off_mm);
    if (off_mm < 0.0 && n > 0 && points[n].stroke == points[n - 1].stroke)
      record.beyond_lingual_mm += glm::distance(points[n].at_P_mm, points[n - 1].at_P_mm);
    front_m = std::max(front_m, at.m_mm);
  }
  record.limb_mm = releasingCut_mm(points, front_m);
  if (record.limb_mm < kLeastLimb_mm) record.limb_mm = 0.0;
  if (plan_.papilla_m_mm() && record.limb_mm > 0.0)
    record.papilla_spared = std::ranges::none_of(points, [&](const IncisionPoint& point) {
      return std::abs(point.at.m_mm - *plan_.papilla_m_mm()) < kAtPapilla_mm &&
             acrossGum_mm(chart_, point.at.m_mm, plan_.crest_rad(point.at.m_mm), point.at.angle_rad) > kUnderMargin_mm;
    });
  record.raised_share = raisedShare();
  if (sheet_) {
    record.raised_mm2 = sheet_->freeArea_mm2();
    record.is_held = sheet_->isHeld();
    record.digest = sheet_->digest();
  }
  record.tears = tears_, record.slips = slips_, record.bur_touches = bur_touches_;
  return record;
}

std::optional<std::string> Flap::news() {
  if (news_.empty()) return {};
  std::string line = std::move(news_.front());
  news_.pop_front();
  return line;
}

}  // namespace app
