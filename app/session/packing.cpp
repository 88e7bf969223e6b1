#include "app/session/packing.h"

#include <bit>
#include <concepts>
#include <string>
#include <type_traits>

#include "app/session/session_error.h"

namespace app {
namespace {

// Every struct is taken apart by a structured binding, so a field added to one does not compile until it is packed.

template <class Visit>
void visitDvec3(auto& v, Visit&& visit) {
  visit(v.x), visit(v.y), visit(v.z);
}

template <class Visit>
void visitHand(auto& hand, Visit&& visit) {
  auto& [X_PT, velocity_P_mm_per_s, arm_P_mm, handle_velocity_P_mm_per_s, jacobian_P_mm, motor_heat, gap_s, drill_pedal,
         fresh, docked, held, calibrated, stop_asked, device_healthy] = hand;
  auto& [rotation, translation_mm] = X_PT;
  visit(rotation.w), visit(rotation.x), visit(rotation.y), visit(rotation.z);
  visitDvec3(translation_mm, visit);
  visitDvec3(velocity_P_mm_per_s.xyz, visit), visitDvec3(arm_P_mm.xyz, visit);
  visitDvec3(handle_velocity_P_mm_per_s.xyz, visit);
  for (int joint = 0; joint < 3; ++joint) visitDvec3(jacobian_P_mm[joint], visit);
  visit(motor_heat), visit(gap_s);
  visit(drill_pedal), visit(fresh), visit(docked), visit(held), visit(calibrated), visit(stop_asked);
  visit(device_healthy);
}

template <class Visit>
void forEachField(auto& tick, Visit&& visit) requires std::same_as<std::remove_cvref_t<decltype(tick)>, haptics::Tick> {
  auto& [index, t_s, dt_s, command_serial, hand, proxy_P, law_force_P_N, law_torque_P_Nmm, served_force_P_N,
         served_torque_P_Nmm, energy_Nmm, spindle_rad_per_s, overlap_mm3, depth_mm, removed_mm3, bone_digest,
         contact_tissue, drilling, rest, strokes, state, faults, work_us] = tick;
  visit(index), visit(t_s), visit(dt_s), visit(command_serial);
  visitHand(hand, visit);
  visitDvec3(proxy_P.mm, visit);
  visitDvec3(law_force_P_N.xyz, visit), visitDvec3(law_torque_P_Nmm.xyz, visit);
  visitDvec3(served_force_P_N.xyz, visit), visitDvec3(served_torque_P_Nmm.xyz, visit);
  visit(energy_Nmm), visit(spindle_rad_per_s);
  visit(overlap_mm3), visit(depth_mm), visit(removed_mm3), visit(bone_digest);
  visit(contact_tissue), visit(drilling), visit(rest), visit(strokes), visit(state), visit(faults), visit(work_us);
}

template <class Visit>
void visitLimits(auto& limits, Visit&& visit) {
  auto& [peak_force_N, slew_N_per_s, peak_torque_Nmm, slew_Nmm_per_s, most_stiffness_N_per_mm, most_damping_Ns_per_mm,
         continuous_force_N, peak_joint_torque_Nmm, fastest_mm_per_s, fastest_turn_rad_per_s, must_be_armed,
         thresholds] = limits;
  auto& [longest_pause_s, arming_mm_per_s, let_go_s, soft_start_s, soft_start_N_per_s, braked_mm_per_s, cut_mm_per_s,
         cut_s, buzz_mm_per_s, stale_s, stale_fades_s, longest_stale_s, warm_motor, share_of_hottest] = thresholds;
  visit(peak_force_N), visit(slew_N_per_s), visit(peak_torque_Nmm), visit(slew_Nmm_per_s);
  visit(most_stiffness_N_per_mm), visit(most_damping_Ns_per_mm), visit(continuous_force_N);
  visitDvec3(peak_joint_torque_Nmm, visit);
  visit(fastest_mm_per_s), visit(fastest_turn_rad_per_s), visit(must_be_armed);
  visit(longest_pause_s), visit(arming_mm_per_s), visit(let_go_s), visit(soft_start_s), visit(soft_start_N_per_s);
  visit(braked_mm_per_s), visit(cut_mm_per_s), visit(cut_s), visit(buzz_mm_per_s);
  visit(stale_s), visit(stale_fades_s), visit(longest_stale_s), visit(warm_motor), visit(share_of_hottest);
}

template <class Visit>
void forEachField(auto& command,
                  Visit&& visit) requires std::same_as<std::remove_cvref_t<decltype(command)>, haptics::Command> {
  auto& [serial, tool, drill_enabled, irrigating, undo_serial, law, erosion, spindle, safety, rearm] = command;
  auto& [head, shaft] = tool;
  auto& [shape_kind, radius_mm, length_mm] = head;
  auto& [shaft_radius_mm, shaft_length_mm] = shaft;
  auto& [law_kind, damping_Ns_per_mm, tissue, agus, forssim, hertz, shell, points, machining, harmonic] = law;
  auto& [force_constant_N, hold_N_per_mm, hold_from, hold_until] = forssim;
  auto& [agus_N_per_mm] = agus;
  auto& [hertz_N_per_mm2] = hertz;
  auto& [shell_N_per_mm3] = shell;
  auto& [points_N_per_mm] = points;
  auto& [harmonic_N_per_mm] = harmonic;
  auto& [chip_tangential_N_per_mm2, chip_radial_N_per_mm2, chip_axial_N_per_mm2, edge_tangential_N_per_mm,
         edge_radial_N_per_mm, edge_axial_N_per_mm, flutes, thickest_chip_mm, slowest_cut_rpm, worn, vibration_share] =
      machining;
  auto& [erosion_kind, time, dose, machining_erosion, friction, erosion_worn, tissue_factor] = erosion;
  auto& [removal_rate_per_s, rated_rpm] = time;
  auto& [removal_mm3_per_J] = dose;
  auto& [cutting_energy_J_per_mm3] = machining_erosion;
  auto& [commanded_rpm, stall_torque_Nmm, free_rpm, droop, inertia_g_cm2, bearing_torque_Nmm] = spindle;
  visit(serial), visit(drill_enabled), visit(irrigating), visit(undo_serial);
  visit(shape_kind), visit(radius_mm), visit(length_mm), visit(shaft_radius_mm), visit(shaft_length_mm);
  visit(law_kind);
  for (auto& factor : tissue.factor) visit(factor);
  visit(damping_Ns_per_mm), visit(agus_N_per_mm);
  visit(force_constant_N), visit(hold_N_per_mm), visit(hold_from), visit(hold_until);
  visit(hertz_N_per_mm2), visit(shell_N_per_mm3), visit(points_N_per_mm), visit(harmonic_N_per_mm);
  visit(chip_tangential_N_per_mm2), visit(chip_radial_N_per_mm2), visit(chip_axial_N_per_mm2);
  visit(edge_tangential_N_per_mm), visit(edge_radial_N_per_mm), visit(edge_axial_N_per_mm);
  visit(flutes), visit(thickest_chip_mm), visit(slowest_cut_rpm), visit(worn), visit(vibration_share);
  visit(erosion_kind), visit(removal_rate_per_s), visit(rated_rpm), visit(removal_mm3_per_J), visit(friction);
  visit(cutting_energy_J_per_mm3), visit(erosion_worn);
  visit(commanded_rpm), visit(stall_torque_Nmm), visit(free_rpm), visit(droop), visit(inertia_g_cm2);
  visit(bearing_torque_Nmm);
  for (auto& factor : tissue_factor) visit(factor);
  visitLimits(safety, visit);
  visit(rearm);
}

/// The unsigned integer that holds the bits of a field.
template <class T>
auto bitsOf(const T& field) {
  if constexpr (std::is_enum_v<T>) {
    return static_cast<std::make_unsigned_t<std::underlying_type_t<T>>>(field);
  } else if constexpr (std::same_as<T, bool>) {
    return static_cast<std::uint8_t>(field ? 1 : 0);
  } else if constexpr (std::same_as<T, double>) {
    return std::bit_cast<std::uint64_t>(field);
  } else if constexpr (std::same_as<T, float>) {
    return std::bit_cast<std::uint32_t>(field);
  } else {
    static_assert(std::unsigned_integral<T>);
    return field;
  }
}

template <class T, class Bits>
void setFromBits(T& field, Bits bits) {
  if constexpr (std::is_enum_v<T>) {
    field = static_cast<T>(bits);
  } else if constexpr (std::same_as<T, bool>) {
    field = bits != 0;
  } else if constexpr (std::floating_point<T>) {
    field = std::bit_cast<T>(bits);
  } else {
    field = bits;
  }
}

class Put {
 public:
  explicit Put(std::uint8_t* out) : out_(out) {}
  template <class T>
  void operator()(const T& field) {
    const std::uint64_t bits = bitsOf(field);
    for (std::size_t i = 0; i < sizeof(bitsOf(field)); ++i) *out_++ = static_cast<std::uint8_t>(bits >> (8 * i));
  }

 private:
  std::uint8_t* out_;
};

class Get {
 public:
  explicit Get(const std::uint8_t* in) : in_(in) {}
  template <class T>
  void operator()(T& field) {
    using Bits = decltype(bitsOf(field));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) bits |= static_cast<std::uint64_t>(*in_++) << (8 * i);
    setFromBits(field, static_cast<Bits>(bits));
  }

 private:
  const std::uint8_t* in_;
};

template <class T>
std::size_t packedBytes() {
  const T value{};
  std::size_t bytes = 0;
  forEachField(value, [&](const auto& field) { bytes += sizeof(bitsOf(field)); });
  return bytes;
}

}  // namespace

std::size_t packedTickBytes() { return packedBytes<haptics::Tick>(); }
std::size_t packedCommandBytes() { return packedBytes<haptics::Command>(); }

std::vector<std::uint8_t> packTicks(std::span<const haptics::Tick> ticks) {
  const std::size_t row_bytes = packedTickBytes(), count = ticks.size();
  std::vector<std::uint8_t> row(row_bytes), planes(row_bytes * count);
  for (std::size_t t = 0; t < count; ++t) {
    forEachField(ticks[t], Put(row.data()));
    for (std::size_t b = 0; b < row_bytes; ++b) planes[b * count + t] = row[b];
  }
  return planes;
}

std::vector<haptics::Tick> unpackTicks(std::span<const std::uint8_t> bytes) {
  const std::size_t row_bytes = packedTickBytes(), count = bytes.size() / row_bytes;
  if (bytes.size() % row_bytes != 0) throw SessionError("a block of ticks has a wrong length: the session is damaged");
  std::vector<std::uint8_t> row(row_bytes);
  std::vector<haptics::Tick> ticks(count);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t b = 0; b < row_bytes; ++b) row[b] = bytes[b * count + t];
    forEachField(ticks[t], Get(row.data()));
  }
  return ticks;
}

std::vector<std::uint8_t> packCommand(const haptics::Command& command) {
  std::vector<std::uint8_t> bytes(packedCommandBytes());
  forEachField(command, Put(bytes.data()));
  return bytes;
}

haptics::Command unpackCommand(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != packedCommandBytes()) {
    throw SessionError("a command has " + std::to_string(bytes.size()) + " bytes, not " +
                       std::to_string(packedCommandBytes()) + ": recorded by another version of the program");
  }
  haptics::Command command;
  forEachField(command, Get(bytes.data()));
  return command;
}

}  // namespace app
