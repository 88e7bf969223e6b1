#include "app/session/tick_columns.h"

#include <array>
#include <bit>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "app/session/session_error.h"
#include "calibration/random.h"

namespace app {
namespace {

/// Name of a column in two parts, unit, frame, meaning.
struct Text {
  std::string_view name, part = "", unit = "", frame = "", meaning = "";
};

constexpr std::string_view kRests = "none 0, undoing 1, caught 2, pedal 3";
constexpr std::string_view kStates = "off 0, calibrate 1, ready 2, armed 3, active 4, fault 5";
constexpr std::string_view kSoftMeaning = "none 0, gingiva 1, flap 2, lip 3, cheek 4, tongue 5, mucosa 6";
constexpr std::string_view kSoftSetMeaning = "gingiva 2, flap 4, lip 8, cheek 16, tongue 32, mucosa 64; their sum";
constexpr std::array<std::string_view, haptics::kMaxPieces> kPieceRotation{"piece_0.rotation", "piece_1.rotation",
                                                                           "piece_2.rotation", "piece_3.rotation"};
constexpr std::array<std::string_view, haptics::kMaxPieces> kPieceTranslation{
    "piece_0.translation_mm", "piece_1.translation_mm", "piece_2.translation_mm", "piece_3.translation_mm"};
constexpr std::string_view kFileMeaning = "none 0, free 1, wall 2, through 3";
constexpr std::string_view kSiteMeaning = "none 0, ready 1, refused 2";
constexpr std::string_view kSplitMeaning = "none 0, waiting 1, running 2, done 3, refused 4";
constexpr std::string_view kBridgeMeaning = "none 0, armed 1, refused 2, outdated 3, breaking 4";
constexpr std::string_view kFaults =
    "bad_pose 1, bad_force 2, clamped 4, slewed 8, device 16, joints 32, hot 64, stale 128, resumed 256, braked 512, "
    "too_fast 1024, buzz 2048, overdrawn 4096, let_go 8192, latched 16384, stopped 32768; their sum";

template <class Visit>
void visitXyz(Text text, auto& v, Visit&& visit) {
  text.part = ".x", visit(text, v.x);
  text.part = ".y", visit(text, v.y);
  text.part = ".z", visit(text, v.z);
}

// Structured bindings: a member added to Tick or HandSample does not compile until it is a column.

template <class Visit>
void visitSoftTouch(auto& soft, Visit&& visit) {
  auto& [tissue, bur_cuts, tissues, depth_mm, place_P, force_P_N, torque_P_Nmm, turn_P] = soft;
  visit(Text{"soft.tissue", "", "", "", kSoftMeaning}, tissue);
  visit(Text{"soft.bur_cuts", "", "", "", kSoftMeaning}, bur_cuts);
  visit(Text{"soft.tissues", "", "", "", kSoftSetMeaning}, tissues);
  visit(Text{"soft.depth_mm", "", "mm"}, depth_mm);
  visitXyz(Text{"soft.place_P_mm", "", "mm", "P"}, place_P.mm, visit);
  visitXyz(Text{"soft.force_P_N", "", "N", "P"}, force_P_N.xyz, visit);
  visitXyz(Text{"soft.torque_P_Nmm", "", "N mm", "P"}, torque_P_Nmm.xyz, visit);
  visit(Text{"soft.turn_P", ".w", "", "P"}, turn_P.w);
  visitXyz(Text{"soft.turn_P", "", "", "P"}, turn_P, visit);
}

template <class Visit>
void visitLevering(auto& lever, Visit&& visit) {
  auto& [piece, twist_Nmm, on_bone_N, on_teeth_N, on_piece_N, wedging_N, fulcrum_P_mm] = lever;
  visit(Text{"lever.piece", "", "", "", "none 0, else 1 + piece"}, piece);
  visit(Text{"lever.twist_Nmm", "", "N mm", "T"}, twist_Nmm);
  visit(Text{"lever.on_bone_N", "", "N"}, on_bone_N);
  visit(Text{"lever.on_teeth_N", "", "N"}, on_teeth_N);
  visit(Text{"lever.on_piece_N", "", "N"}, on_piece_N);
  visit(Text{"lever.wedging_N", "", "N"}, wedging_N);
  visitXyz(Text{"lever.fulcrum_P_mm", "", "mm", "P"}, fulcrum_P_mm, visit);
}

template <class Visit>
void visitFile(auto& file, Visit&& visit) {
  // Not columns: nodes and links, which a replay makes again.
  auto& [stay, tip_P_mm, tip_axis_P, normal_N, torque_Nmm, torque_share, strain, strain_from_tip_mm, damage, windup_rad,
         roll_rad, axial_N_per_mm, stop_N, due_total_mm3, removed_total_mm3, broken_from_tip_mm, left_mm, flutes_full,
         sharpness, debris_mm3, fragments, keeps_bend, unsettled, node_P_mm, link_share] = file;
  static_cast<void>(node_P_mm), static_cast<void>(link_share);
  visit(Text{"file.stay", "", "", "", kFileMeaning}, stay);
  visitXyz(Text{"file.tip_P_mm", "", "mm", "P"}, tip_P_mm, visit);
  visitXyz(Text{"file.tip_axis_P", "", "", "P"}, tip_axis_P, visit);
  visit(Text{"file.normal_N", "", "N"}, normal_N);
  visit(Text{"file.torque_Nmm", "", "N mm"}, torque_Nmm);
  visit(Text{"file.torque_share"}, torque_share);
  visit(Text{"file.strain"}, strain);
  visit(Text{"file.strain_from_tip_mm", "", "mm"}, strain_from_tip_mm);
  visit(Text{"file.damage"}, damage);
  visit(Text{"file.windup_rad", "", "rad"}, windup_rad);
  visit(Text{"file.roll_rad", "", "rad"}, roll_rad);
  visit(Text{"file.axial_N_per_mm", "", "N/mm"}, axial_N_per_mm);
  visit(Text{"file.stop_N", "", "N"}, stop_N);
  visit(Text{"file.due_total_mm3", "", "mm3"}, due_total_mm3);
  visit(Text{"file.removed_total_mm3", "", "mm3"}, removed_total_mm3);
  visit(Text{"file.broken_from_tip_mm", "", "mm"}, broken_from_tip_mm);
  visit(Text{"file.left_mm", "", "mm"}, left_mm);
  visit(Text{"file.flutes_full"}, flutes_full);
  visit(Text{"file.sharpness"}, sharpness);
  visit(Text{"file.debris_mm3", "", "mm3"}, debris_mm3);
  visit(Text{"file.fragments"}, fragments);
  visit(Text{"file.keeps_bend"}, keeps_bend);
  visit(Text{"file.unsettled"}, unsettled);
}

template <class Visit>
void visitFilling(auto& filling, Visit&& visit) {
  auto& [works, is_full, increment, changed_mm3, packed_mm3, total_mm3, cured_mm3] = filling;
  visit(Text{"filling.works"}, works);
  visit(Text{"filling.is_full"}, is_full);
  visit(Text{"filling.increment"}, increment);
  visit(Text{"filling.changed_mm3", "", "mm3"}, changed_mm3);
  visit(Text{"filling.packed_mm3", "", "mm3"}, packed_mm3);
  visit(Text{"filling.total_mm3", "", "mm3"}, total_mm3);
  visit(Text{"filling.cured_mm3", "", "mm3"}, cured_mm3);
}

template <class Visit>
void visitHand(auto& hand, Visit&& visit) {
  auto& [X_PT, velocity_P_mm_per_s, arm_P_mm, handle_velocity_P_mm_per_s, jacobian_P_mm, motor_heat, gap_s, drill_pedal,
         fresh, docked, held, calibrated, stop_requested, device_healthy] = hand;
  auto& [rotation, translation_mm] = X_PT;
  visit(Text{"hand.X_PT.rotation", ".w", "", "P"}, rotation.w);
  visitXyz(Text{"hand.X_PT.rotation", "", "", "P"}, rotation, visit);
  visitXyz(Text{"hand.X_PT.translation_mm", "", "mm", "P"}, translation_mm, visit);
  visitXyz(Text{"hand.velocity_P_mm_per_s", "", "mm/s", "P"}, velocity_P_mm_per_s.xyz, visit);
  visitXyz(Text{"hand.arm_P_mm", "", "mm", "P"}, arm_P_mm.xyz, visit);
  visitXyz(Text{"hand.handle_velocity_P_mm_per_s", "", "mm/s", "P"}, handle_velocity_P_mm_per_s.xyz, visit);
  visitXyz(Text{"hand.jacobian_P_mm.joint_1", "", "mm/rad", "P"}, jacobian_P_mm[0], visit);
  visitXyz(Text{"hand.jacobian_P_mm.joint_2", "", "mm/rad", "P"}, jacobian_P_mm[1], visit);
  visitXyz(Text{"hand.jacobian_P_mm.joint_3", "", "mm/rad", "P"}, jacobian_P_mm[2], visit);
  visit(Text{"hand.motor_heat"}, motor_heat);
  visit(Text{"hand.gap_s", "", "s"}, gap_s);
  visit(Text{"hand.drill_pedal"}, drill_pedal);
  visit(Text{"hand.fresh"}, fresh);
  visit(Text{"hand.docked"}, docked);
  visit(Text{"hand.held"}, held);
  visit(Text{"hand.calibrated"}, calibrated);
  visit(Text{"hand.stop_asked"}, stop_requested);
  visit(Text{"hand.device_healthy"}, device_healthy);
}

template <class Visit>
void forEachColumn(auto& tick, Visit&& visit) {
  auto& [index, t_s, dt_s, command_serial, hand, proxy_P, law_force_P_N, law_torque_P_Nmm, commanded_force_P_N,
         commanded_torque_P_Nmm, energy_Nmm, spindle_rad_per_s, overlap_mm3, depth_mm, removed_mm3, restored_total_mm3,
         bone_digest, removed_total_mm3, contact_tissue, soft, drilling, drill_inhibit, strokes, undone_strokes, pieces,
         split, bridge, broken, bridge_share, site, chips, gripped, set_aside, unsettled, X_PQ, grip_force_P_N,
         grip_torque_P_Nmm, lever, torn_share, torn_total_Nmm, file, filling, state, faults, work_us] = tick;
  visit(Text{"index"}, index);
  visit(Text{"t_s", "", "s"}, t_s);
  visit(Text{"dt_s", "", "s"}, dt_s);
  visit(Text{"command_serial"}, command_serial);
  visitHand(hand, visit);
  visitXyz(Text{"proxy_P_mm", "", "mm", "P"}, proxy_P.mm, visit);
  visitXyz(Text{"law_force_P_N", "", "N", "P"}, law_force_P_N.xyz, visit);
  visitXyz(Text{"law_torque_P_Nmm", "", "N mm", "P"}, law_torque_P_Nmm.xyz, visit);
  visitXyz(Text{"served_force_P_N", "", "N", "P"}, commanded_force_P_N.xyz, visit);
  visitXyz(Text{"served_torque_P_Nmm", "", "N mm", "P"}, commanded_torque_P_Nmm.xyz, visit);
  visit(Text{"energy_Nmm", "", "N mm"}, energy_Nmm);
  visit(Text{"spindle_rad_per_s", "", "rad/s", "T"}, spindle_rad_per_s);
  visit(Text{"overlap_mm3", "", "mm3"}, overlap_mm3);
  visit(Text{"depth_mm", "", "mm"}, depth_mm);
  visit(Text{"removed_mm3", "", "mm3"}, removed_mm3);
  visit(Text{"restored_total_mm3", "", "mm3"}, restored_total_mm3);
  visit(Text{"bone_digest"}, bone_digest);
  visit(Text{"contact_tissue", "", "", "", "place in the labels of meta"}, contact_tissue);
  visitSoftTouch(soft, visit);
  visit(Text{"drilling"}, drilling);
  visit(Text{"rest", "", "", "", kRests}, drill_inhibit);
  visit(Text{"strokes"}, strokes);
  visit(Text{"undone_strokes"}, undone_strokes);
  visit(Text{"pieces"}, pieces);
  visit(Text{"split", "", "", "", kSplitMeaning}, split);
  visit(Text{"bridge", "", "", "", kBridgeMeaning}, bridge);
  visit(Text{"chips", "", "", "", kSplitMeaning}, chips);
  auto& [broken_piece, is_complete, area_mm2, force_N, bending_Nmm] = broken;
  visit(Text{"broken.piece", "", "", "", "none 0, else 1 + piece"}, broken_piece);
  visit(Text{"broken.is_complete"}, is_complete);
  visit(Text{"broken.area_mm2", "", "mm2"}, area_mm2);
  visit(Text{"broken.force_N", "", "N"}, force_N);
  visit(Text{"broken.bending_Nmm", "", "N mm"}, bending_Nmm);
  visit(Text{"bridge_share"}, bridge_share);
  visit(Text{"site", "", "", "", kSiteMeaning}, site);
  visit(Text{"gripped", "", "", "", "none 0, else 1 + piece"}, gripped);
  visit(Text{"set_aside"}, set_aside);
  visit(Text{"unsettled"}, unsettled);
  for (std::size_t n = 0; n < X_PQ.size(); ++n) {
    visit(Text{kPieceRotation[n], ".w", "", "P"}, X_PQ[n].rotation.w);
    visitXyz(Text{kPieceRotation[n], "", "", "P"}, X_PQ[n].rotation, visit);
    visitXyz(Text{kPieceTranslation[n], "", "mm", "P"}, X_PQ[n].translation_mm, visit);
  }
  visitXyz(Text{"grip_force_P_N", "", "N", "P"}, grip_force_P_N.xyz, visit);
  visitXyz(Text{"grip_torque_P_Nmm", "", "N mm", "P"}, grip_torque_P_Nmm.xyz, visit);
  visitLevering(lever, visit);
  visit(Text{"torn_share"}, torn_share);
  visit(Text{"torn_total_Nmm", "", "N mm"}, torn_total_Nmm);
  visitFile(file, visit);
  visitFilling(filling, visit);
  visit(Text{"state", "", "", "", kStates}, state);
  visit(Text{"faults", "", "", "", kFaults}, faults);
  visit(Text{"work_us", "", "us"}, work_us);
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

std::uint64_t littleEndian(const std::uint8_t* at, std::size_t bytes, std::size_t stride) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes; ++i) bits |= static_cast<std::uint64_t>(at[i * stride]) << (8 * i);
  return bits;
}

void putLittleEndian(std::uint8_t* at, std::uint64_t bits, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) at[i] = static_cast<std::uint8_t>(bits >> (8 * i));
}

void packInto(std::uint8_t* row, const haptics::Tick& tick) {
  forEachColumn(tick, [&](const Text&, const auto& field) {
    const auto bits = bitsOf(field);
    putLittleEndian(row, bits, sizeof bits);
    row += sizeof bits;
  });
}

haptics::Tick unpackedFrom(const std::uint8_t* row) {
  haptics::Tick tick;
  forEachColumn(tick, [&](const Text&, auto& field) {
    using Bits = decltype(bitsOf(field));
    setFromBits(field, static_cast<Bits>(littleEndian(row, sizeof(Bits), 1)));
    row += sizeof(Bits);
  });
  return tick;
}

std::size_t packedTickBytes() {
  const haptics::Tick tick;
  std::size_t bytes = 0;
  forEachColumn(tick, [&](const Text&, const auto& field) { bytes += sizeof(bitsOf(field)); });
  return bytes;
}

}  // namespace

const std::vector<TickColumn>& tickColumns() {
  static const std::vector<TickColumn> kColumns = [] {
    const haptics::Tick tick;
    std::vector<TickColumn> columns;
    forEachColumn(tick, [&](const Text& text, const auto& field) {
      const char kind = std::floating_point<std::remove_cvref_t<decltype(field)>> ? 'f' : 'u';
      columns.push_back({std::string(text.name) + std::string(text.part),
                         kind + std::to_string(8 * sizeof(bitsOf(field))), std::string(text.unit),
                         std::string(text.frame), std::string(text.meaning)});
    });
    return columns;
  }();
  return kColumns;
}

std::vector<std::uint8_t> packTicks(std::span<const haptics::Tick> ticks) {
  static const std::size_t kRowBytes = packedTickBytes();
  const std::size_t count = ticks.size();
  std::vector<std::uint8_t> row(kRowBytes), planes(kRowBytes * count);
  for (std::size_t t = 0; t < count; ++t) {
    packInto(row.data(), ticks[t]);
    for (std::size_t b = 0; b < kRowBytes; ++b) planes[b * count + t] = row[b];
  }
  return planes;
}

std::uint64_t digestOf(const haptics::Tick& tick) {
  haptics::Tick timeless = tick;
  timeless.work_us = 0.0f;
  std::uint64_t digest = 0;
  forEachColumn(timeless, [&](const Text&, const auto& field) {
    digest = calibration::mixedBits(digest ^ static_cast<std::uint64_t>(bitsOf(field)));
  });
  return digest;
}

TickUnpacker::Type TickUnpacker::typeOf(const std::string& text) {
  for (const char kind : {'u', 'i', 'f'})
    for (const std::uint8_t bytes : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{4}, std::uint8_t{8}})
      if ((kind != 'f' || bytes >= 4) && text == kind + std::to_string(8 * bytes)) return {kind, bytes};
  throw damagedSession("a column of its ticks is of type '" + text.substr(0, 20) + "', which is unknown");
}

TickUnpacker::TickUnpacker(std::span<const TickColumn> stored) {
  constexpr std::size_t kMaxColumns = 10'000;
  if (stored.empty() || stored.size() > kMaxColumns) throw damagedSession("its ticks have no columns");
  default_row_.resize(packedTickBytes());
  packInto(default_row_.data(), haptics::Tick{});
  static const std::vector<Type> kOwnTypes = [] {
    std::vector<Type> types;
    for (const TickColumn& own : tickColumns()) types.push_back(typeOf(own.type));
    return types;
  }();
  for (const TickColumn& column : stored) {
    const Type type = typeOf(column.type);
    for (std::size_t own = 0, to = 0; own < kOwnTypes.size(); to += kOwnTypes[own++].bytes)
      if (tickColumns()[own].name == column.name) routes_.push_back({bytes_per_tick_, to, type, kOwnTypes[own]});
    bytes_per_tick_ += type.bytes;
  }
}

std::uint64_t TickUnpacker::converted(std::uint64_t bits, Type from, Type to) {
  if (from == to) return bits;
  const int unused = 64 - 8 * from.bytes;
  const auto with_sign = static_cast<std::int64_t>(bits << unused) >> unused;
  if (from.kind != 'f' && to.kind != 'f') return from.kind == 'i' ? static_cast<std::uint64_t>(with_sign) : bits;
  const double value = from.kind == 'i'   ? static_cast<double>(with_sign)
                       : from.kind == 'u' ? static_cast<double>(bits)
                       : from.bytes == 4  ? double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))}
                                          : std::bit_cast<double>(bits);
  if (to.kind == 'f')
    return to.bytes == 4 ? std::bit_cast<std::uint32_t>(static_cast<float>(value))
                         : std::bit_cast<std::uint64_t>(value);
  return value >= 0.0 && value < 0x1p63 ? static_cast<std::uint64_t>(value) : 0;
}

std::vector<haptics::Tick> TickUnpacker::unpack(std::span<const std::uint8_t> bytes) const {
  const std::size_t count = bytes.size() / bytes_per_tick_;
  if (bytes.size() % bytes_per_tick_ != 0) throw damagedSession("a block of ticks has a wrong length");
  std::vector<haptics::Tick> ticks;
  ticks.reserve(count);
  std::vector<std::uint8_t> row = default_row_;
  for (std::size_t t = 0; t < count; ++t) {
    for (const Route& route : routes_) {
      const std::uint64_t bits = littleEndian(bytes.data() + route.from * count + t, route.stored.bytes, count);
      putLittleEndian(row.data() + route.to, converted(bits, route.stored, route.own), route.own.bytes);
    }
    ticks.push_back(unpackedFrom(row.data()));
  }
  return ticks;
}

}  // namespace app
