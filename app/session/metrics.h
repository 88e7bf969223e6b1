// Measures of a recorded session: times, paths, forces, removed volume. Values as recorded; for schemas 3 and 4 the
// volume by tissue comes from a replay and is none if that differs. Frame P; mm, N, s. Any thread but the servo; about
// a second for some minutes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/drawn_plan_event.h"
#include "app/session/flap_event.h"
#include "app/session/measures/contact_envelope.h"
#include "app/session/measures/measure_value.h"
#include "app/session/measures/session_case.h"
#include "app/session/replay.h"
#include "app/session/session_calibration.h"
#include "app/session/session_conditions.h"
#include "app/session/session_setup.h"
#include "app/session/session_text.h"
#include "app/session/socket_event.h"
#include "app/session/soft_touches.h"
#include "app/session/step_event.h"
#include "app/session/touch_event.h"
#include "app/session/way_event.h"
#include "assets/proposed.h"

namespace app {

/// A way measured with the ruler between two touches.
struct MeasuredWay {
  double t_s = 0.0, mm = 0.0;
  std::string words;  ///< as recorded, with both places
};

/// A bridge of the tooth that broke under force.
struct BridgeBreak {
  double t_s = 0.0, force_N = 0.0, bending_Nmm = 0.0, area_mm2 = 0.0;
  bool is_complete = true;  ///< false: a spur stayed on the root
};

struct SessionMetrics {
  std::string patient_title, program_version;
  std::optional<SessionCalibration> calibration;  ///< none: recorded before calibrations were stored
  SessionConditions conditions;
  assets::Proposed proposed;               ///< what rests on it is not confirmed
  std::optional<FormerSession> former;     ///< the session this one continues: its measures are its own
  bool closed = false;                     ///< false: ended by a kill or a full disk
  std::optional<std::string> missing_log;  ///< killed, and this log of it is missing
  std::uint64_t ticks = 0, lost = 0, commands = 0, events = 0;
  double duration_s = 0.0, contact_s = 0.0, drill_on_s = 0.0, drill_in_contact_s = 0.0, dry_drilling_s = 0.0,
         obscured_s = 0.0;
  double path_mm = 0.0, drilling_path_mm = 0.0, max_force_N = 0.0, mean_contact_force_N = 0.0, max_depth_mm = 0.0;
  double grip_s = 0.0, max_grip_N = 0.0, ligament_torn_Nmm = 0.0, pieces_out = 0.0;  ///< by forceps; N of the model
  double lever_s = 0.0, max_lever_Nmm = 0.0, max_fulcrum_N = 0.0;                    ///< by elevators, of the model
  double bridges_broken = 0.0;
  double limited_s = 0.0, faulty_s = 0.0, removed_mm3 = 0.0, returned_mm3 = 0.0;
  std::optional<RemovedByTissue> removed_mm3_by_label;  ///< none: not recorded
  std::vector<MeasuredWay> measured;
  std::vector<BridgeBreak> bridge_breaks;          ///< undone ones too
  std::optional<std::vector<TouchCount>> touched;  ///< teeth and canal; none: recorded before touches were counted
  std::optional<DrawnPlan> drawn_plan;             ///< of the surgeon; none: nothing was drawn
  std::optional<DrawnComparison> drawn_cut;        ///< against it; none: not compared
  std::optional<FlapRecord> flap;                  ///< none: it was raised from the beginning
  std::optional<SocketRecord> socket;              ///< none: no piece of a tooth was out at the end
  std::size_t ways_looked_at = 0;                  ///< how often it was looked what keeps the tooth in
  std::optional<WayRecord> way;                    ///< the last of these
  std::optional<ProcedureRun> procedure;           ///< none: no procedure was followed
  std::optional<Prediction> prediction;            ///< none: nothing was predicted
  std::optional<bool> assessed;                    ///< nothing helped; none: recorded before assessments
  std::size_t help_refused = 0, coach_said = 0;    ///< how often
  std::vector<MeasureValue> measures;              ///< by their ids, see measures/
  ContactEnvelope envelope;                        ///< force and speed by distance to the canal
  SoftTouches soft_touches;                        ///< of lip, cheek, tongue, gingiva …
  double work_p50_us = 0.0, work_p99_us = 0.0, work_max_us = 0.0;  ///< recorded CPU time of the servo step

  /// The end of the procedure's last step, or of the recording.
  double endOfWork_s() const { return (procedure ? procedure->end_s() : std::nullopt).value_or(duration_s); }
};

struct Measure {
  std::string_view key, unit, meaning;
  double SessionMetrics::*value;
};

/// The numeric measures, in the order of the JSON and of the help.
inline constexpr std::array kMeasures = std::to_array<Measure>({
    {"duration_s", "s", "length of the recording", &SessionMetrics::duration_s},
    {"contact_s", "s", "time with the bur in the bone", &SessionMetrics::contact_s},
    {"drill_on_s", "s", "time with the drill on", &SessionMetrics::drill_on_s},
    {"drill_in_contact_s", "s", "time drilling in bone", &SessionMetrics::drill_in_contact_s},
    {"dry_drilling_s", "s", "time drilling in bone without irrigation", &SessionMetrics::dry_drilling_s},
    {"obscured_s", "s", "time drilling in bone with less than half of the cut in view: dust, blood, spray",
     &SessionMetrics::obscured_s},
    {"path_mm", "mm", "path length of the bur's centre", &SessionMetrics::path_mm},
    {"drilling_path_mm", "mm", "path length with the drill on", &SessionMetrics::drilling_path_mm},
    {"max_force_N", "N", "largest force on the hand", &SessionMetrics::max_force_N},
    {"mean_contact_force_N", "N", "mean force in contact", &SessionMetrics::mean_contact_force_N},
    {"max_depth_mm", "mm", "largest equivalent depth of the force law", &SessionMetrics::max_depth_mm},
    {"grip_s", "s", "time with the forceps closed on a piece of tooth", &SessionMetrics::grip_s},
    {"max_grip_N", "N", "largest force of the forceps on a piece, in the model", &SessionMetrics::max_grip_N},
    {"lever_s", "s", "time with an elevator's blade at work on a piece of tooth", &SessionMetrics::lever_s},
    {"max_lever_Nmm", "N mm", "largest torque of the hand about an elevator's shaft, in the model",
     &SessionMetrics::max_lever_Nmm},
    {"max_fulcrum_N", "N", "largest force of an elevator on a neighbouring tooth, in the model",
     &SessionMetrics::max_fulcrum_N},
    {"ligament_torn_Nmm", "N mm", "energy that tore ligament, without undone strokes",
     &SessionMetrics::ligament_torn_Nmm},
    {"pieces_out", "pieces", "pieces of tooth taken out at the end", &SessionMetrics::pieces_out},
    {"bridges_broken", "bridges", "bridges of the tooth broken by force, undone ones too",
     &SessionMetrics::bridges_broken},
    {"limited_s", "s", "time with the force clamped or slew-limited", &SessionMetrics::limited_s},
    {"faulty_s", "s", "time with an invalid pose or force or a device fault", &SessionMetrics::faulty_s},
    {"removed_mm3", "mm3", "removed volume, without undone strokes", &SessionMetrics::removed_mm3},
    {"returned_mm3", "mm3", "volume restored by undone strokes", &SessionMetrics::returned_mm3},
});

/// Throws SessionError if the file is missing, not a session, or damaged. `case_of` a session's start: what its bur had
/// to keep off and what was to be removed (app/station/session_case); without it neither is told. 8 to 10 s for ten
/// minutes; of a recording that does not hold the bone at its end (it was not closed) the time of its replay as well,
/// where a case is asked for and that bone is not given as `left`.
SessionMetrics metricsOf(const std::string& path, const CaseOf& case_of = {}, const BoneLeft* left = nullptr);

/// Units as people write them: mm³, mm², °.
std::string unitText(std::string_view unit);

/// A measure by its id; null: it is not among them.
const MeasureValue* measureOf(const SessionMetrics& metrics, std::string_view id);
/// A measure's value by its id; none: the recording cannot tell.
std::optional<double> valueOf(const SessionMetrics& metrics, std::string_view id);

/// Whether kMeasures have the same measure by another name.
bool isAmongMeasures(std::string_view id);

/// The table of kMeasures for --help and the manual, and where the others are.
std::string measuresHelp();

/// One sentence on what nobody had confirmed; empty: nothing.
std::string notConfirmedText(const assets::Proposed& proposed);

/// For people: a summary in a few short lines, then kMeasures with units, then the volume by tissue.
std::string metricsText(const SessionMetrics& metrics);

/// In one sentence for the surgeon: time, removed volume, irrigation, what was touched and what the turning bur was on.
std::string metricsInShort(const SessionMetrics& metrics);

/// One JSON object: the state of the recording, kMeasures by key, volumes by the key of the tissue.
std::string metricsJson(const SessionMetrics& metrics);

}  // namespace app
