// A rig file with every block, its values seeded and full of digits.
#pragma once

#include <random>

#include "calibration/record/rig_record.h"

namespace calibration {

inline RigRecord fullRecord(std::uint32_t seed = 1) {
  std::mt19937 rng(seed);
  const auto number = [&](double size) { return std::uniform_real_distribution<double>(-size, size)(rng); };
  const auto vector = [&](double size) { return glm::dvec3(number(size), number(size), number(size)); };
  const auto rotation = [&] { return glm::angleAxis(number(3.0), glm::normalize(vector(1.0))); };

  RigRecord record;
  Rig& rig = record.rig;
  rig = desktopRig({1920, 1080});
  rig.mirror = Plane<World>{glm::normalize(glm::dvec3(0.01, 1, 1.02)), 12.0 + number(1.0)};
  for (Point<World>* p : {&rig.screen.lower_left, &rig.screen.lower_right, &rig.screen.upper_left})
    *p = rig.mirror->reflect(*p);
  rig.left_eye.mm += vector(2.0);
  rig.right_eye.mm += vector(2.0);
  rig.X_WP = {rotation(), vector(100.0)};
  rig.X_WD = {rotation(), vector(200.0)};
  rig.second_X_WD = Pose<World, Device>{rotation(), vector(200.0)};
  rig.device = RigDevice{"omni", "60623200012", "right", "burr-3mm-07"};
  ArmCorrection arm;
  for (double& v : arm.offset_rad) v = number(0.01);
  for (double& v : arm.gain) v = number(0.004);
  for (double& v : arm.quadratic_per_rad) v = number(0.001);
  arm.thigh_delta_mm = number(0.4), arm.shin_delta_mm = number(0.4);
  arm.tilt_rad = number(0.002), arm.reach_delta_mm = number(0.5);
  arm.tip_H_mm += vector(0.4);
  rig.arm = arm;

  record.provenance = {"rig-02",  "2026-11-21T08:20:00Z", "1.4.0", "4.6.0",
                       "tech-07", "half_silvered",        2.0,     std::string(64, 'a')};
  record.eye_sd_mm = 4.7;
  record.procedure = RigProcedure{"jig27", ArmModel::full, 26, 1, 41.3, 168.4, 0.18, 0.24, {0.05, 0.06}};
  record.verification = RigVerification{{16, 0.21, 0.24, 0.41, 0.55, {{0.03, -0.05, 0.1}}, 0.2, 0.13},
                                        VerificationKind::full,
                                        Verdict::green,
                                        "2026-11-21T08:23:00Z",
                                        "worst: back left low, 0.6 mm"};
  for (int id = 0; id < 16; ++id)
    record.verification->residuals.push_back({100 + id, {vector(60.0)}, {vector(0.25)}, true});
  for (int id = 0; id < 27; ++id) record.residuals.push_back({id, {vector(60.0)}, {vector(0.3)}, id != 13});
  record.patient_position = "left";
  record.rest = RestRegistration{rotation(), vector(80.0), 0.2, 0.4};
  for (int i = 0; i < 28; ++i) record.sigma.push_back(std::abs(number(0.1)));
  return record;
}

}  // namespace calibration
