#include "haptics/servo/root_canal_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/file/material_frame.h"
#include "haptics/file/wall_contact.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Vector;
using glm::dvec3;

// A hand without torque feels the torque as a vibration along the file (reference/sisters 1.5).
constexpr double kSlowest_Hz = 60.0, kFastest_Hz = 250.0, kBuzz_N = 0.3, kFeltShare = 0.1;

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
  return {reference.point_P_mm, reference.out_P / length};
}

void RootCanalFile::takeUp(const Tool& tool, const FilePose& X_PT, const WearSettings& wear,
                           double max_stiffness_N_per_mm) noexcept {
  const auto made = tool.file.made();
  const bool is_another = tool.file != chosen_ || !file_;
  chosen_ = tool.file;
  wear_settings_ = wear;
  worn_before_mm3_ += wear_.due_mm3();
  taken_before_mm3_ += wear_.removed_mm3();
  wear_ = CanalWear(wear);
  work_ = {};
  let_go_rad_ = buzz_rad_ = 0.0;
  last_hand_ = X_PT.rotation;
  if (!made) {
    file_.reset();
    return;
  }
  const double N_per_mm = std::min(kFileCoupling_N_per_mm, max_stiffness_N_per_mm);
  file_.emplace(fileChain(*made, kUsualLinks), FileLaw{}, FileGrip{false, N_per_mm}, X_PT);
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

bool RootCanalFile::isOut(const FileReference& reference) const noexcept {
  const dvec3& tip_mm = file_->state().shape.node_mm[file_->chain().links];
  return glm::dot(tip_mm - reference.point_P_mm, reference.out_P) > 0.0;
}

bool RootCanalFile::isInSolid(const SolidField& wall) const noexcept {
  const FileChain& chain = file_->chain();
  const ChainShape& shape = file_->state().shape;
  for (std::size_t i = 1; i <= chain.links; ++i) {
    SectionContact contact;
    addSection(file_->law(), wall, {shape.node_mm[i], shape.direction[i], chain.radius_mm[i], chain.link_mm}, contact);
    if (contact.normal_N > 0.0) return true;
  }
  return false;
}

FilePose RootCanalFile::gripped(const Hand& hand) noexcept {
  FilePose at = poseOf(hand.X_PT);
  if (hand.opens_fingers && !hand.relocated) let_go_rad_ += rollBetween_rad(last_hand_, at.rotation);
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
  if (other || hand.relocated) {
    takeUp(tool, poseOf(hand.X_PT), wear, hand.max_stiffness_N_per_mm);
    if (!file_) return felt;
    passes_ = isInSolid(wall);
  }

  FileScene scene;
  if (!passes_) {
    scene.wall = &wall;
    if (fragments_.isMet()) scene.fragments = &fragments_;
    if (chosen_.stop_mm > 0.0) scene.stop = RubberStop{chosen_.stop_mm, reference.point_P_mm, reference.out_P};
  }
  const FileTick done = file_->step(gripped(hand), scene);
  if (passes_) passes_ = isInSolid(wall);
  felt.files = hand.may_cut && !passes_ && done.normal_N > 0.0;
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
  work_.flutes_full = flutes_.fullest();
  work_.sharpness = flutes_.sharpness();
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
