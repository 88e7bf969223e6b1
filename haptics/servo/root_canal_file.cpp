#include "haptics/servo/root_canal_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "haptics/file/cone_chain.h"
#include "haptics/file/material_frame.h"
#include "haptics/file/wall_contact.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Vector;
using glm::dvec3;

// A hand without torque feels the torque as a vibration along the file (reference/sisters 1.5).
constexpr double kSlowest_Hz = 60.0, kFastest_Hz = 250.0, kBuzz_N = 0.3, kFeltShare = 0.1;

/// A cone that is not so far in a canal is not let go of.
constexpr double kStays_mm = 1.0;

FilePose poseOf(const calibration::Pose<Patient, calibration::Tool>& X_PT) {
  return {X_PT.rotation, X_PT.translation_mm};
}

dvec3 axisOf(const glm::dquat& R) { return R * dvec3(0.0, 0.0, -1.0); }

/// Turned about the file's own axis from one attitude to the next, beyond what the axis' own motion explains.
double rollBetween_rad(const glm::dquat& from, const glm::dquat& to) {
  const dvec3 axis = axisOf(to), expected = carried(sideOf(from), axisOf(from), axis);
  const double sine = std::clamp(glm::dot(glm::cross(expected, sideOf(to)), axis), -1.0, 1.0);
  const double angle = angleOfSine(std::fabs(sine));
  const double whole = glm::dot(expected, sideOf(to)) < 0.0 ? std::numbers::pi - angle : angle;
  return std::copysign(whole, sine);
}

}  // namespace

FileReference sanitised(const FileReference& reference) noexcept {
  const double length = glm::length(reference.out_P);
  if (!calibration::isFinite(reference.point_P_mm) || !(length > 1e-6) || !std::isfinite(length)) return {};
  constexpr double kDeepest_mm = 30.0;
  const double orifice_mm = std::isfinite(reference.orifice_mm) ? reference.orifice_mm : 0.0;
  return {reference.point_P_mm, reference.out_P / length, std::clamp(orifice_mm, 0.0, kDeepest_mm)};
}

void RootCanalFile::takeUp(const Tool& tool, const FilePose& X_PT, const WearSettings& wear,
                           double max_stiffness_N_per_mm) noexcept {
  const auto made = tool.file.made();
  const auto cone = tool.file.cone();
  const bool is_another = tool.file != chosen_ || !file_;
  chosen_ = tool.file;
  wear_settings_ = wear;
  worn_before_mm3_ += wear_.due_mm3();
  taken_before_mm3_ += wear_.removed_mm3();
  wear_ = CanalWear(wear);
  work_ = {};
  let_go_rad_ = buzz_rad_ = 0.0;
  has_let_go_ = false;
  last_hand_ = X_PT.rotation;
  if (!made && !cone) {
    file_.reset();
    return;
  }
  const FileGrip grip{false, std::min(kFileCoupling_N_per_mm, max_stiffness_N_per_mm)};
  file_.emplace(cone ? coneChain(*cone, kUsualLinks) : fileChain(*made, kUsualLinks), cone ? coneLaw() : FileLaw{},
                grip, X_PT);
  if (chosen_.bent_deg != 0.0)
    file_->prebend(chosen_.bent_mm, chosen_.bent_deg * std::numbers::pi / 180.0,
                   chosen_.bent_towards_deg * std::numbers::pi / 180.0);
  if (is_another) flutes_.takeUp(file_->chain());
  fragments_.lookAgain(file_->chain(), file_->state().shape);
}

void RootCanalFile::putDown(double dt_s, bool irrigates) noexcept {
  file_.reset();
  flutes_.rinse(dt_s, irrigates, true);
  work_ = {};
  work_.debris_mm3 = flutes_.left_mm3();
  work_.fragments = static_cast<std::uint8_t>(fragments_.lying());
}

double RootCanalFile::belowOrifice_mm(const FileReference& reference) const noexcept {
  const dvec3& tip_mm = file_->state().shape.node_mm[file_->chain().links];
  return -reference.orifice_mm - glm::dot(tip_mm - reference.point_P_mm, reference.out_P);
}

bool RootCanalFile::isOut(const FileReference& reference) const noexcept {
  const dvec3& tip_mm = file_->state().shape.node_mm[file_->chain().links];
  return glm::dot(tip_mm - reference.point_P_mm, reference.out_P) > 0.0;
}

bool RootCanalFile::isInSolid(const FileScene& scene) const noexcept {
  const FileChain& chain = file_->chain();
  const ChainShape& shape = file_->state().shape;
  for (std::size_t i = 1; i <= chain.links; ++i) {
    SectionContact contact;
    const SectionPlace place{shape.node_mm[i], shape.direction[i], chain.radius_mm[i], chain.link_mm};
    if (scene.wall != nullptr) addSection(file_->law(), *scene.wall, place, contact);
    if (scene.laid != nullptr) addSection(file_->law(), *scene.laid, place, contact);
    if (contact.normal_N > 0.0) return true;
  }
  return false;
}

LaidCone RootCanalFile::laidCone(const FileReference& reference) const noexcept {
  static_assert(LaidCone::kMostNodes == kUsualLinks + 1);
  const FileChain& chain = file_->chain();
  LaidCone cone;
  cone.nodes = chain.links + 1;
  for (std::size_t n = 0; n < cone.nodes; ++n) {
    cone.node_P_mm[n] = file_->state().shape.node_mm[n];
    cone.radius_mm[n] = chain.radius_mm[n];
  }
  cone.sealer_mm3 = chosen_.sealer_mm3;
  cone.seared_P_mm = reference.point_P_mm - reference.orifice_mm * reference.out_P;
  cone.out_P = reference.out_P;
  return cone;
}

FilePose RootCanalFile::gripped(const Hand& hand) noexcept {
  FilePose at = poseOf(hand.X_PT);
  if (hand.opens_fingers && !hand.relocated && !chosen_.isCone())
    let_go_rad_ += rollBetween_rad(last_hand_, at.rotation);
  last_hand_ = at.rotation;
  // About the axis towards the tip, which is -z.
  const glm::dvec2 half = turnBy(-0.5 * let_go_rad_);
  at.rotation = at.rotation * glm::dquat(half.x, 0.0, 0.0, -half.y);
  return at;
}

RootCanalFile::Felt RootCanalFile::update(Bodies& bodies, StrokeHistory& strokes, const Tool& tool,
                                          const FileReference& reference, const WearSettings& wear, const Hand& hand,
                                          double dt_s, std::uint64_t tick) noexcept {
  CarvedBone& bone = bodies.bones().front();
  const SolidField wall = bone.field();
  Felt felt;
  felt.handle_P = {hand.X_PT.translation_mm};
  const bool other = !file_ || tool.file != chosen_ || wear != wear_settings_;
  // A cone meets what is laid too; files go through it.
  const bool is_cone = tool.file.isCone();
  SolidField laid;
  FileScene met;
  met.wall = &wall;
  if (is_cone && bodies.filling() != nullptr && !bodies.filling()->isEmpty())
    laid = bodies.filling()->field(), met.laid = &laid;
  if (other || hand.relocated) {
    takeUp(tool, poseOf(hand.X_PT), wear, hand.max_stiffness_N_per_mm);
    if (!file_) return felt;
    passes_ = isInSolid(met);
  }
  const bool opens = !std::exchange(were_open_, hand.opens_fingers) && hand.opens_fingers;
  if (is_cone && opens && !passes_ && hand.may_cut && bodies.filling() != nullptr &&
      belowOrifice_mm(reference) > kStays_mm) {
    felt.let_go = laidCone(reference);
    takeUp(tool, poseOf(hand.X_PT), wear, hand.max_stiffness_N_per_mm);
    has_let_go_ = passes_ = true;
  }

  FileScene scene;
  if (!passes_) {
    scene = met;
    if (fragments_.isMet()) scene.fragments = &fragments_;
    if (chosen_.stop_mm > 0.0) scene.stop = RubberStop{chosen_.stop_mm, reference.point_P_mm, reference.out_P};
  }
  const FileTick done = file_->step(gripped(hand), scene);
  has_let_go_ = has_let_go_ && belowOrifice_mm(reference) > 0.0;
  if (passes_) passes_ = has_let_go_ || isInSolid(met);
  felt.files = hand.may_cut && !is_cone && !passes_ && done.normal_N > 0.0;
  if (felt.files) felt.removed = wear_.step(*file_, bone, &strokes, tick, &flutes_);
  flutes_.rinse(dt_s, hand.irrigates, isOut(reference));
  if (done.broken_link && file_->fragment()) fragments_.leave(*file_->fragment(), file_->chain(), strokes);
  fragments_.wake(file_->chain(), file_->state().shape);

  tell(done);
  felt.handle_P = {file_->state().shape.node_mm[0]};
  felt.touches = done.normal_N > 0.0 || done.stop_N > 0.0;
  if (!passes_) {
    felt.on_hand = done.on_hand;
    felt.vibration_P_N = vibration(done, dt_s);
    // Of the shape, and of the spring that the hand stretches.
    const double pull_N = glm::length(done.on_hand.force_N.xyz);
    felt.max_stored_Nmm = std::max(0.0, done.energy_Nmm) + pull_N * pull_N / kFileCoupling_N_per_mm;
  }
  return felt;
}

void RootCanalFile::tell(const FileTick& tick) noexcept {
  const FileChain& chain = file_->chain();
  const FileState& state = file_->state();
  work_.stay = passes_ ? FileStay::through : tick.normal_N > 0.0 ? FileStay::wall : FileStay::free;
  work_.tip_P_mm = state.shape.node_mm[chain.links];
  work_.tip_axis_P = state.shape.direction[chain.links];
  work_.normal_N = tick.normal_N;
  work_.torque_Nmm = tick.torque_Nmm;
  work_.torque_share = tick.torque_share;
  work_.strain = tick.strain;
  work_.strain_from_tip_mm = tick.strain_from_tip_mm;
  work_.damage = 0.0;
  for (std::size_t i = 1; i <= chain.links; ++i) work_.damage = std::max(work_.damage, state.damage[i]);
  work_.windup_rad = state.roll_rad[0] - state.roll_rad[chain.links];
  work_.roll_rad = state.roll_rad[0];
  work_.axial_N_per_mm = tick.axial_N_per_mm;
  work_.stop_N = tick.stop_N;
  work_.due_total_mm3 = worn_before_mm3_ + wear_.due_mm3();
  work_.removed_total_mm3 = taken_before_mm3_ + wear_.removed_mm3();
  work_.broken_from_tip_mm = tick.broken_link && file_->fragment() ? file_->fragment()->from_tip_mm : 0.0;
  work_.left_mm = chain.length_mm();
  // A cone has none.
  work_.flutes_full = chosen_.isCone() ? 0.0 : flutes_.fullest();
  work_.sharpness = chosen_.isCone() ? 1.0 : flutes_.sharpness();
  work_.debris_mm3 = flutes_.left_mm3();
  work_.fragments = static_cast<std::uint8_t>(fragments_.lying());
  work_.keeps_bend = tick.set;
  work_.unsettled = tick.unsettled;
  for (std::size_t n = 0; n <= kUsualLinks; ++n) {
    // Beyond a break what has just separated, still where it was.
    const std::size_t beyond = n > chain.links && tick.broken_link ? n - chain.links : 0;
    work_.node_P_mm[n] = glm::vec3(beyond > 0 && file_->fragment()
                                       ? file_->fragment()->node_P_mm[std::min(beyond, file_->fragment()->links)]
                                       : state.shape.node_mm[std::min(n, chain.links)]);
    const std::size_t i = std::max<std::size_t>(n, 1);
    const double torque_Nmm = chain.twist_Nmm_per_rad[i] * (state.roll_rad[i - 1] - state.roll_rad[i]);
    work_.link_share[n] = i <= chain.links ? static_cast<float>(std::fabs(torque_Nmm) / chain.breaking_Nmm[i]) : 0.0f;
  }
}

Vector<Patient> RootCanalFile::vibration(const FileTick& tick, double dt_s) noexcept {
  const double share = std::min(1.0, tick.torque_share);
  if (!(share > kFeltShare)) {
    buzz_rad_ = 0.0;
    return {};
  }
  buzz_rad_ += 2.0 * std::numbers::pi * (kSlowest_Hz + share * (kFastest_Hz - kSlowest_Hz)) * dt_s;
  if (buzz_rad_ > 2.0 * std::numbers::pi) buzz_rad_ -= 2.0 * std::numbers::pi;
  return {file_->state().shape.direction[0] * (kBuzz_N * share * turnBy(buzz_rad_).y)};
}

}  // namespace haptics
