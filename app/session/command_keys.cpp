#include "app/session/command_keys.h"

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "app/session/session_error.h"
#include "assets/json_depth.h"

namespace app {
namespace {

constexpr std::array<std::string_view, haptics::kShapeKinds> kShapes = {"sphere", "capsule", "cylinder", "cone",
                                                                        "revolved"};

std::string_view keyOf(haptics::ShapeKind kind) { return kShapes[static_cast<std::size_t>(kind) % kShapes.size()]; }
std::string_view keyOf(assets::BurProfile profile) {
  return assets::kBurProfileKeys[static_cast<std::size_t>(profile) % assets::kBurProfiles];
}
std::string_view keyOf(haptics::LawKind kind) {
  return haptics::kLaws[static_cast<std::size_t>(kind) % haptics::kLaws.size()].key;
}
std::string_view keyOf(haptics::ErosionKind kind) {
  return haptics::kErosions[static_cast<std::size_t>(kind) % haptics::kErosions.size()].key;
}

std::string_view keyOf(haptics::ElevatorKind kind) {
  return haptics::kElevatorKeys[static_cast<std::size_t>(kind) % haptics::kElevatorKeys.size()];
}

std::string_view keyOf(haptics::HandInstrument kind) {
  return haptics::kHandInstrumentKeys[static_cast<std::size_t>(kind) % haptics::kHandInstrumentKeys.size()];
}

constexpr std::array<std::string_view, 3> kWearLaws = {"wear", "counters", "counters-helical"};
std::string_view keyOf(haptics::WearLaw kind) { return kWearLaws[static_cast<std::size_t>(kind) % kWearLaws.size()]; }

/// Sets the kind of this key; unchanged if the key is unknown here.
template <class Kind>
void setByKey(Kind& kind, std::string_view key) {
  constexpr std::size_t kCount = std::same_as<Kind, haptics::LawKind>          ? haptics::kLaws.size()
                                 : std::same_as<Kind, haptics::ErosionKind>    ? haptics::kErosions.size()
                                 : std::same_as<Kind, haptics::ElevatorKind>   ? haptics::kElevatorKeys.size()
                                 : std::same_as<Kind, haptics::HandInstrument> ? haptics::kHandInstrumentKeys.size()
                                 : std::same_as<Kind, haptics::WearLaw>        ? kWearLaws.size()
                                 : std::same_as<Kind, assets::BurProfile>      ? assets::kBurProfiles
                                                                               : kShapes.size();
  for (std::size_t i = 0; i < kCount; ++i)
    if (keyOf(static_cast<Kind>(i)) == key) kind = static_cast<Kind>(i);
}

// Structured bindings: a member added to a command does not compile until it has a key.

template <class Visit>
void visitByTissue(const std::string& key, auto& factors, Visit&& visit) {
  for (std::size_t i = 0; i < factors.size(); ++i) visit(key + "." + std::string(assets::kTissues[i].key), factors[i]);
}

template <class Visit>
void visitTool(auto& tool, Visit&& visit) {
  auto& [head, shaft, handpiece, grips, elevator, hand_instrument, file] = tool;
  auto& [kind, radius_mm, length_mm, profile] = head;
  auto& [shaft_radius_mm, shaft_length_mm] = shaft;
  visit("tool.head.kind", kind), visit("tool.head.radius_mm", radius_mm), visit("tool.head.length_mm", length_mm);
  visit("tool.head.profile", profile);
  visit("tool.shaft.radius_mm", shaft_radius_mm), visit("tool.shaft.length_mm", shaft_length_mm);
  visit("tool.handpiece", handpiece), visit("tool.grips", grips);
  visit("tool.elevator", elevator), visit("tool.hand_instrument", hand_instrument);
  auto& [size, file_length_mm, nickel_titanium, bent_deg, bent_mm, bent_towards_deg, stop_mm, cone_taper, sealer_mm3] =
      file;
  visit("tool.file.size", size), visit("tool.file.length_mm", file_length_mm);
  visit("tool.file.nickel_titanium", nickel_titanium), visit("tool.file.bent_deg", bent_deg);
  visit("tool.file.bent_mm", bent_mm), visit("tool.file.bent_towards_deg", bent_towards_deg);
  visit("tool.file.stop_mm", stop_mm);
  visit("tool.file.cone_taper", cone_taper), visit("tool.file.sealer_mm3", sealer_mm3);
}

/// The plan follows from the bodies.
template <class Visit>
void visitSplit(auto& split, Visit&& visit) {
  auto& [serial, bodies_digest, piece, plan] = split;
  visit("split.serial", serial), visit("split.bodies_digest", bodies_digest), visit("split.piece", piece);
}

/// The plan of a break follows from the bodies and these.
template <class Visit>
void visitBridge(auto& order, Visit&& visit) {
  auto& [serial, bodies_digest, piece, plan_digest, bridge, plan] = order;
  auto& [between, area_mm2, width_mm, thickness_mm, half_width_mm, half_thickness_mm, centre_mm, normal, width_axis] =
      bridge;
  visit("bridge.serial", serial), visit("bridge.bodies_digest", bodies_digest), visit("bridge.piece", piece);
  visit("bridge.plan_digest", plan_digest), visit("bridge.area_mm2", area_mm2);
  visit("bridge.width_mm", width_mm), visit("bridge.thickness_mm", thickness_mm);
  visit("bridge.half_width_mm", half_width_mm), visit("bridge.half_thickness_mm", half_thickness_mm);
  visit("bridge.centre_mm.x", centre_mm.x), visit("bridge.centre_mm.y", centre_mm.y);
  visit("bridge.centre_mm.z", centre_mm.z);
  visit("bridge.normal.x", normal.x), visit("bridge.normal.y", normal.y), visit("bridge.normal.z", normal.z);
  visit("bridge.width_axis.x", width_axis.x), visit("bridge.width_axis.y", width_axis.y);
  visit("bridge.width_axis.z", width_axis.z);
}

/// The site follows from the bodies, too.
template <class Visit>
void visitSite(auto& order, Visit&& visit) {
  auto& [serial, bodies_digest, piece, site] = order;
  visit("site.serial", serial), visit("site.bodies_digest", bodies_digest), visit("site.piece", piece);
}

/// The plan follows from the bodies at the start and these.
template <class Visit>
void visitChips(auto& order, Visit&& visit) {
  auto& [serial, bodies_digest, plan_digest, plan] = order;
  visit("chips.serial", serial), visit("chips.bodies_digest", bodies_digest);
  visit("chips.plan_digest", plan_digest);
}

template <class Visit>
void visitMachining(auto& machining, Visit&& visit) {
  auto& [chip_tangential_N_per_mm2, chip_radial_N_per_mm2, chip_axial_N_per_mm2, edge_tangential_N_per_mm,
         edge_radial_N_per_mm, edge_axial_N_per_mm, flutes, thickest_chip_mm, slowest_cut_rpm, worn, vibration_share] =
      machining;
  visit("law.machining.chip_tangential_N_per_mm2", chip_tangential_N_per_mm2);
  visit("law.machining.chip_radial_N_per_mm2", chip_radial_N_per_mm2);
  visit("law.machining.chip_axial_N_per_mm2", chip_axial_N_per_mm2);
  visit("law.machining.edge_tangential_N_per_mm", edge_tangential_N_per_mm);
  visit("law.machining.edge_radial_N_per_mm", edge_radial_N_per_mm);
  visit("law.machining.edge_axial_N_per_mm", edge_axial_N_per_mm);
  visit("law.machining.flutes", flutes), visit("law.machining.thickest_chip_mm", thickest_chip_mm);
  visit("law.machining.slowest_cut_rpm", slowest_cut_rpm), visit("law.machining.worn", worn);
  visit("law.machining.vibration_share", vibration_share);
}

template <class Visit>
void visitLaw(auto& law, Visit&& visit) {
  auto& [kind, damping_Ns_per_mm, tissue, agus, forssim, hertz, shell, points, machining, harmonic] = law;
  auto& [force_constant_N, hold_N_per_mm, hold_from, hold_until] = forssim;
  auto& [tissue_factor] = tissue;
  auto& [agus_N_per_mm] = agus;
  auto& [hertz_N_per_mm2] = hertz;
  auto& [shell_N_per_mm3] = shell;
  auto& [points_N_per_mm] = points;
  auto& [harmonic_N_per_mm] = harmonic;
  visit("law.kind", kind), visit("law.damping_Ns_per_mm", damping_Ns_per_mm);
  visitByTissue("law.tissue.factor", tissue_factor, visit);
  visit("law.agus.stiffness_N_per_mm", agus_N_per_mm);
  visit("law.forssim.force_constant_N", force_constant_N), visit("law.forssim.hold_N_per_mm", hold_N_per_mm);
  visit("law.forssim.hold_from", hold_from), visit("law.forssim.hold_until", hold_until);
  visit("law.hertz.hertz_N_per_mm2", hertz_N_per_mm2), visit("law.shell.shell_N_per_mm3", shell_N_per_mm3);
  visit("law.points.stiffness_N_per_mm", points_N_per_mm);
  visitMachining(machining, visit);
  visit("law.harmonic.stiffness_N_per_mm", harmonic_N_per_mm);
}

template <class Visit>
void visitErosion(auto& erosion, Visit&& visit) {
  auto& [kind, time, dose, machining, friction, worn, tissue_factor] = erosion;
  auto& [removal_rate_per_s, rated_rpm] = time;
  auto& [removal_mm3_per_J] = dose;
  auto& [cutting_energy_J_per_mm3] = machining;
  visit("erosion.kind", kind), visit("erosion.time.removal_rate_per_s", removal_rate_per_s);
  visit("erosion.time.rated_rpm", rated_rpm), visit("erosion.dose.removal_mm3_per_J", removal_mm3_per_J);
  visit("erosion.machining.cutting_energy_J_per_mm3", cutting_energy_J_per_mm3);
  visit("erosion.friction", friction), visit("erosion.worn", worn);
  visitByTissue("erosion.tissue_factor", tissue_factor, visit);
}

template <class Visit>
void visitSpindle(auto& spindle, Visit&& visit) {
  auto& [commanded_rpm, stall_torque_Nmm, free_rpm, droop, inertia_g_cm2, bearing_torque_Nmm] = spindle;
  visit("spindle.commanded_rpm", commanded_rpm), visit("spindle.stall_torque_Nmm", stall_torque_Nmm);
  visit("spindle.free_rpm", free_rpm), visit("spindle.droop", droop);
  visit("spindle.inertia_g_cm2", inertia_g_cm2), visit("spindle.bearing_torque_Nmm", bearing_torque_Nmm);
}

template <class Visit>
void visitWear(auto& wear, Visit&& visit) {
  auto& [law, alpha_mm3_per_Nmm, push_share, counter] = wear;
  visit("wear.law", law), visit("wear.alpha_mm3_per_Nmm", alpha_mm3_per_Nmm);
  visit("wear.push_share", push_share), visit("wear.counter", counter);
}

template <class Visit>
void visitThresholds(auto& thresholds, Visit&& visit) {
  auto& [max_pause_s, arming_mm_per_s, release_s, soft_start_s, soft_start_N_per_s, brake_mm_per_s, cutoff_mm_per_s,
         cutoff_s, buzz_mm_per_s, stale_s, stale_fade_s, max_stale_s, warm_motor, share_at_hottest] = thresholds;
  visit("safety.thresholds.longest_pause_s", max_pause_s);
  visit("safety.thresholds.arming_mm_per_s", arming_mm_per_s);
  visit("safety.thresholds.let_go_s", release_s);
  visit("safety.thresholds.soft_start_s", soft_start_s);
  visit("safety.thresholds.soft_start_N_per_s", soft_start_N_per_s);
  visit("safety.thresholds.braked_mm_per_s", brake_mm_per_s);
  visit("safety.thresholds.cut_mm_per_s", cutoff_mm_per_s);
  visit("safety.thresholds.cut_s", cutoff_s);
  visit("safety.thresholds.buzz_mm_per_s", buzz_mm_per_s);
  visit("safety.thresholds.stale_s", stale_s);
  visit("safety.thresholds.stale_fades_s", stale_fade_s);
  visit("safety.thresholds.longest_stale_s", max_stale_s);
  visit("safety.thresholds.warm_motor", warm_motor);
  visit("safety.thresholds.share_of_hottest", share_at_hottest);
}

template <class Visit>
void visitSafety(auto& safety, Visit&& visit) {
  auto& [peak_force_N, slew_N_per_s, peak_torque_Nmm, slew_Nmm_per_s, max_stiffness_N_per_mm, max_damping_Ns_per_mm,
         continuous_force_N, peak_joint_torque_Nmm, max_speed_mm_per_s, max_angular_speed_rad_per_s, must_be_armed,
         thresholds] = safety;
  visit("safety.peak_force_N", peak_force_N), visit("safety.slew_N_per_s", slew_N_per_s);
  visit("safety.peak_torque_Nmm", peak_torque_Nmm), visit("safety.slew_Nmm_per_s", slew_Nmm_per_s);
  visit("safety.most_stiffness_N_per_mm", max_stiffness_N_per_mm);
  visit("safety.most_damping_Ns_per_mm", max_damping_Ns_per_mm);
  visit("safety.continuous_force_N", continuous_force_N);
  visit("safety.peak_joint_torque_Nmm.joint_1", peak_joint_torque_Nmm.x);
  visit("safety.peak_joint_torque_Nmm.joint_2", peak_joint_torque_Nmm.y);
  visit("safety.peak_joint_torque_Nmm.joint_3", peak_joint_torque_Nmm.z);
  visit("safety.fastest_mm_per_s", max_speed_mm_per_s),
      visit("safety.fastest_turn_rad_per_s", max_angular_speed_rad_per_s);
  visit("safety.must_be_armed", must_be_armed);
  visitThresholds(thresholds, visit);
}

template <class Visit>
void forEachKey(auto& command, Visit&& visit) {
  auto& [serial, tool, drill_enabled, hands_off, irrigating, assistant_holds, flap_aside, undo_serial, redo_serial,
         split, bridge, site, chips, law, erosion, spindle, wear, file_reference, safety, rearm] = command;
  visit("serial", serial);
  visitTool(tool, visit);
  visit("drill_enabled", drill_enabled), visit("hands_off", hands_off), visit("irrigating", irrigating),
      visit("undo_serial", undo_serial);
  visit("assistant_holds", assistant_holds), visit("flap_aside", flap_aside);
  visit("redo_serial", redo_serial);
  visitSplit(split, visit);
  visitBridge(bridge, visit);
  visitSite(site, visit);
  visitChips(chips, visit);
  visitLaw(law, visit);
  visitErosion(erosion, visit);
  visitSpindle(spindle, visit);
  visitWear(wear, visit);
  auto& [stop_at_mm, stop_out, orifice_mm] = file_reference;
  visit("file_reference.point_P_mm.x", stop_at_mm.x), visit("file_reference.point_P_mm.y", stop_at_mm.y);
  visit("file_reference.point_P_mm.z", stop_at_mm.z), visit("file_reference.out_P.x", stop_out.x);
  visit("file_reference.out_P.y", stop_out.y), visit("file_reference.out_P.z", stop_out.z);
  visit("file_reference.orifice_mm", orifice_mm);
  visitSafety(safety, visit);
  visit("rearm", rearm);
}

nlohmann::json jsonOf(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}
nlohmann::json jsonOf(std::uint64_t value) { return value; }
nlohmann::json jsonOf(bool value) { return value; }
template <class Kind>
requires std::is_enum_v<Kind> nlohmann::json jsonOf(Kind kind) { return keyOf(kind); }

[[noreturn]] void refuse(const std::string& key) {
  throw damagedSession("a command has no valid value of " + key.substr(0, 80));
}

void setFrom(double& value, const nlohmann::json& json, const std::string& key) {
  if (json == "nan")
    value = std::numeric_limits<double>::quiet_NaN();
  else if (json == "inf" || json == "-inf")
    value = json == "inf" ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  else if (json.is_number())
    value = json.get<double>();
  else
    refuse(key);
}
void setFrom(std::uint64_t& value, const nlohmann::json& json, const std::string& key) {
  if (!json.is_number_unsigned()) refuse(key);
  value = json.get<std::uint64_t>();
}
void setFrom(bool& value, const nlohmann::json& json, const std::string& key) {
  if (!json.is_boolean()) refuse(key);
  value = json.get<bool>();
}
template <class Kind>
requires std::is_enum_v<Kind>
void setFrom(Kind& kind, const nlohmann::json& json, const std::string& key) {
  if (!json.is_string()) refuse(key);
  setByKey(kind, json.get_ref<const std::string&>());
}

}  // namespace

std::string commandText(const haptics::Command& command) {
  nlohmann::json json = nlohmann::json::object();
  forEachKey(command, [&](const std::string& key, const auto& member) { json[key] = jsonOf(member); });
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

haptics::Command commandFromText(std::string_view text) {
  const nlohmann::json json =
      assets::isNestedTooDeep(text) ? nlohmann::json() : nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) throw damagedSession("a command cannot be read");
  haptics::Command command;
  forEachKey(command, [&](const std::string& key, auto& member) {
    if (const auto found = json.find(key); found != json.end()) setFrom(member, *found, key);
  });
  return command;
}

}  // namespace app
