#include "app/session/old_formats/packed_format.h"

#include <bit>
#include <cmath>
#include <string>

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>
#include <nlohmann/json.hpp>

#include "app/session/command_keys.h"
#include "app/session/compressed.h"
#include "app/session/session_error.h"
#include "app/session/tables.h"

namespace app::old_formats {
namespace {

constexpr std::array<Table, 8> kTables = {{
    {"meta", "schema INTEGER, program TEXT, patient TEXT, dt_s REAL"},
    {"bone",
     "size_i INTEGER, size_j INTEGER, size_k INTEGER, spacing_mm REAL, origin_x_P_mm REAL, origin_y_P_mm REAL, "
     "origin_z_P_mm REAL, solid BLOB, label BLOB"},
    {"command", "serial INTEGER, first_tick INTEGER, bytes BLOB"},
    {"tick_block", "first_tick INTEGER, count INTEGER, ticks BLOB"},
    {"event", "tick INTEGER, kind TEXT, text TEXT"},
    {"picture", "tick INTEGER, name TEXT, bytes BLOB"},
    {"seal", "ticks INTEGER, lost INTEGER"},
    {"calibration",
     "rig TEXT, rig_id TEXT, device_serial TEXT, verdict TEXT, touches INTEGER, rms_mm REAL, p95_mm REAL, max_mm REAL, "
     "checked_utc TEXT, age_days REAL, despite TEXT"},
}};

struct Member {
  std::string_view name, type;
  int copies = 1;  ///< 3: .x .y .z
};

constexpr auto kTickMembers = std::to_array<Member>({
    {"index", "u64"},
    {"t_s", "f64"},
    {"dt_s", "f64"},
    {"command_serial", "u64"},
    {"hand.X_PT.rotation.w", "f64"},
    {"hand.X_PT.rotation", "f64", 3},
    {"hand.X_PT.translation_mm", "f64", 3},
    {"hand.velocity_P_mm_per_s", "f64", 3},
    {"hand.arm_P_mm", "f64", 3},
    {"hand.handle_velocity_P_mm_per_s", "f64", 3},
    {"hand.jacobian_P_mm.joint_1", "f64", 3},
    {"hand.jacobian_P_mm.joint_2", "f64", 3},
    {"hand.jacobian_P_mm.joint_3", "f64", 3},
    {"hand.motor_heat", "f64"},
    {"hand.gap_s", "f64"},
    {"hand.drill_pedal", "u8"},
    {"hand.fresh", "u8"},
    {"hand.docked", "u8"},
    {"hand.held", "u8"},
    {"hand.calibrated", "u8"},
    {"hand.stop_asked", "u8"},
    {"hand.device_healthy", "u8"},
    {"proxy_P_mm", "f64", 3},
    {"law_force_P_N", "f64", 3},
    {"law_torque_P_Nmm", "f64", 3},
    {"served_force_P_N", "f64", 3},
    {"served_torque_P_Nmm", "f64", 3},
    {"energy_Nmm", "f64"},
    {"spindle_rad_per_s", "f64"},
    {"overlap_mm3", "f64"},
    {"depth_mm", "f64"},
    {"removed_mm3", "f64"},
    {"bone_digest", "u64"},
    {"contact_tissue", "u8"},
    {"drilling", "u8"},
    {"rest", "u8"},
    {"strokes", "u8"},
    {"state", "u8"},
    {"faults", "u32"},
    {"work_us", "f32"},
});

constexpr std::array<std::string_view, 10> kTissues = {"unlabelled", "cortical", "trabecular", "other_teeth",
                                                       "enamel",     "dentine",  "pulp",       "mandibular_canal",
                                                       "ligament",   "gingiva"};
constexpr std::array<std::string_view, 4> kShapes = {"sphere", "capsule", "cylinder", "cone"};
constexpr std::array<std::string_view, 7> kLaws = {"agus",   "forssim",   "hertz",   "shell",
                                                   "points", "machining", "harmonic"};
constexpr std::array<std::string_view, 3> kErosions = {"time", "dose", "machining"};

enum class Kind { whole, yes_no, real, shape, law, erosion, real_by_tissue };
struct Key {
  std::string_view name;
  Kind kind = Kind::real;
};

constexpr auto kCommandKeys = std::to_array<Key>({
    {"serial", Kind::whole},
    {"drill_enabled", Kind::yes_no},
    {"irrigating", Kind::yes_no},
    {"undo_serial", Kind::whole},
    {"tool.head.kind", Kind::shape},
    {"tool.head.radius_mm"},
    {"tool.head.length_mm"},
    {"tool.shaft.radius_mm"},
    {"tool.shaft.length_mm"},
    {"law.kind", Kind::law},
    {"law.tissue.factor", Kind::real_by_tissue},
    {"law.damping_Ns_per_mm"},
    {"law.agus.stiffness_N_per_mm"},
    {"law.forssim.force_constant_N"},
    {"law.forssim.hold_N_per_mm"},
    {"law.forssim.hold_from"},
    {"law.forssim.hold_until"},
    {"law.hertz.hertz_N_per_mm2"},
    {"law.shell.shell_N_per_mm3"},
    {"law.points.stiffness_N_per_mm"},
    {"law.harmonic.stiffness_N_per_mm"},
    {"law.machining.chip_tangential_N_per_mm2"},
    {"law.machining.chip_radial_N_per_mm2"},
    {"law.machining.chip_axial_N_per_mm2"},
    {"law.machining.edge_tangential_N_per_mm"},
    {"law.machining.edge_radial_N_per_mm"},
    {"law.machining.edge_axial_N_per_mm"},
    {"law.machining.flutes"},
    {"law.machining.thickest_chip_mm"},
    {"law.machining.slowest_cut_rpm"},
    {"law.machining.worn"},
    {"law.machining.vibration_share"},
    {"erosion.kind", Kind::erosion},
    {"erosion.time.removal_rate_per_s"},
    {"erosion.time.rated_rpm"},
    {"erosion.dose.removal_mm3_per_J"},
    {"erosion.friction"},
    {"erosion.machining.cutting_energy_J_per_mm3"},
    {"erosion.worn"},
    {"spindle.commanded_rpm"},
    {"spindle.stall_torque_Nmm"},
    {"spindle.free_rpm"},
    {"spindle.droop"},
    {"spindle.inertia_g_cm2"},
    {"spindle.bearing_torque_Nmm"},
    {"erosion.tissue_factor", Kind::real_by_tissue},
    {"safety.peak_force_N"},
    {"safety.slew_N_per_s"},
    {"safety.peak_torque_Nmm"},
    {"safety.slew_Nmm_per_s"},
    {"safety.most_stiffness_N_per_mm"},
    {"safety.most_damping_Ns_per_mm"},
    {"safety.continuous_force_N"},
    {"safety.peak_joint_torque_Nmm.joint_1"},
    {"safety.peak_joint_torque_Nmm.joint_2"},
    {"safety.peak_joint_torque_Nmm.joint_3"},
    {"safety.fastest_mm_per_s"},
    {"safety.fastest_turn_rad_per_s"},
    {"safety.must_be_armed", Kind::yes_no},
    {"safety.thresholds.longest_pause_s"},
    {"safety.thresholds.arming_mm_per_s"},
    {"safety.thresholds.let_go_s"},
    {"safety.thresholds.soft_start_s"},
    {"safety.thresholds.soft_start_N_per_s"},
    {"safety.thresholds.braked_mm_per_s"},
    {"safety.thresholds.cut_mm_per_s"},
    {"safety.thresholds.cut_s"},
    {"safety.thresholds.buzz_mm_per_s"},
    {"safety.thresholds.stale_s"},
    {"safety.thresholds.stale_fades_s"},
    {"safety.thresholds.longest_stale_s"},
    {"safety.thresholds.warm_motor"},
    {"safety.thresholds.share_of_hottest"},
    {"rearm", Kind::whole},
});

/// Reads little-endian values of a packed struct.
class Unpacker {
 public:
  explicit Unpacker(std::span<const std::uint8_t> bytes) : left_(bytes) {}
  std::uint64_t whole(std::size_t bytes = 8) {
    if (left_.size() < bytes) throw damagedSession("a command has a wrong length");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value |= static_cast<std::uint64_t>(left_[i]) << (8 * i);
    left_ = left_.subspan(bytes);
    return value;
  }
  double real() { return std::bit_cast<double>(whole()); }
  template <std::size_t N>
  std::string oneOf(const std::array<std::string_view, N>& names) {
    const std::uint64_t index = whole(1);
    if (index >= N) throw damagedSession("a command has an unknown kind");
    return std::string(names[index]);
  }
  bool isEmpty() const { return left_.empty(); }

 private:
  std::span<const std::uint8_t> left_;
};

haptics::Command commandFrom(std::span<const std::uint8_t> bytes) {
  Unpacker packed(bytes);
  nlohmann::json keys;
  const auto real = [&](const std::string& key) {
    const double value = packed.real();
    if (std::isfinite(value))
      keys[key] = value;
    else
      keys[key] = std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
  };
  for (const Key& key : kCommandKeys) {
    const std::string name(key.name);
    switch (key.kind) {
      case Kind::whole:
        keys[name] = packed.whole();
        break;
      case Kind::yes_no:
        keys[name] = packed.whole(1) != 0;
        break;
      case Kind::real:
        real(name);
        break;
      case Kind::shape:
        keys[name] = packed.oneOf(kShapes);
        break;
      case Kind::law:
        keys[name] = packed.oneOf(kLaws);
        break;
      case Kind::erosion:
        keys[name] = packed.oneOf(kErosions);
        break;
      case Kind::real_by_tissue:
        for (const std::string_view tissue : kTissues) real(name + "." + std::string(tissue));
    }
  }
  if (!packed.isEmpty()) throw damagedSession("a command has a wrong length");
  return commandFromText(keys.dump());
}

void setFrom(std::string& value, const SQLite::Column& column) { value = column.getString(); }
void setFrom(int& value, const SQLite::Column& column) { value = column.getInt(); }
void setFrom(double& value, const SQLite::Column& column) { value = column.getDouble(); }
void setFrom(std::optional<double>& value, const SQLite::Column& column) {
  if (!column.isNull()) value = column.getDouble();
}

SessionCalibration calibrationFrom(SQLite::Database& database) {
  SQLite::Statement row(database, "SELECT * FROM calibration");
  if (!row.executeStep()) throw damagedSession("it has no calibration");
  SessionCalibration calibration;
  forEachField(calibration, [&](const char* key, auto& value) { setFrom(value, row.getColumn(key)); });
  return calibration;
}

}  // namespace

std::span<const Table> packedTables(std::int64_t schema) {
  return std::span(kTables).first(schema < 4 ? kTables.size() - 1 : kTables.size());
}

const std::vector<TickColumn>& packedTickColumns() {
  static const std::vector<TickColumn> kColumns = [] {
    std::vector<TickColumn> columns;
    for (const Member& member : kTickMembers)
      for (int copy = 0; copy < member.copies; ++copy) {
        const std::string part = member.copies == 1 ? "" : std::string(".") + "xyz"[copy];
        columns.push_back({std::string(member.name) + part, std::string(member.type), "", "", ""});
      }
    return columns;
  }();
  return kColumns;
}

LabelTable packedLabels() { return labelsOfKeys(kTissues); }

StoredStart packedAbout(SQLite::Database& database, std::int64_t schema) {
  SQLite::Statement meta(database, "SELECT program, patient, dt_s FROM meta");
  SQLite::Statement bone(database, "SELECT * FROM bone");
  if (!meta.executeStep() || !bone.executeStep()) throw damagedSession("it has no start");
  StoredStart start;
  start.program_version = meta.getColumn(0).getString();
  start.patient_title = meta.getColumn(1).getString();
  start.dt_s = meta.getColumn(2).getDouble();
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t voxels = bone.getColumn(1 + axis).getInt64();
    start.grid.size[axis] = voxels < 1 || voxels > 1 << 20 ? 0 : static_cast<int>(voxels);
    start.grid.origin_P_mm[axis] = bone.getColumn(5 + axis).getDouble();
  }
  start.grid.spacing_mm = bone.getColumn(4).getDouble();
  refuseInvalidGrid(start.grid);
  if (schema >= 4) start.calibration = calibrationFrom(database);
  return start;
}

void readPackedBone(SQLite::Database& database, StoredStart& about) {
  SQLite::Statement bone(database, "SELECT * FROM bone");
  if (!bone.executeStep()) throw damagedSession("it has no bone");
  about.solid = decompress(blobOf(bone.getColumn(8)), about.grid.voxelCount());
  about.label = decompress(blobOf(bone.getColumn(9)), about.grid.voxelCount());
}

std::vector<SessionCommand> packedCommands(SQLite::Database& database) {
  std::vector<SessionCommand> commands;
  SQLite::Statement rows(database, "SELECT first_tick, bytes FROM command ORDER BY row");
  while (rows.executeStep())
    commands.push_back(
        {commandFrom(blobOf(rows.getColumn(1))), static_cast<std::uint64_t>(rows.getColumn(0).getInt64())});
  return commands;
}

}  // namespace app::old_formats
