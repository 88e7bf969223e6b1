// `molar clearance PATIENT`: how near a tool's surface is to canal, lingual surface and second molar on given poses, no
// device. CSV of distances out, mm.

#include <memory>

#include <fmt/core.h>

#include "app/case/clearance_source.h"
#include "app/commands/command.h"
#include "app/commands/patient_or_case.h"
#include "app/device/pose_csv.h"
#include "app/options/settings_text.h"
#include "app/options/tool_text.h"
#include "app/text/command_line.h"
#include "calibration/output_file.h"
#include "haptics/tool/clearance.h"

namespace app {
namespace {

struct ClearanceOptions {
  PatientOrCase patient;
  std::string tool, shaft = "none", poses, out;
  bool force = false;
};

/// In the order of the columns.
using assets::RiskStructure;
constexpr std::array kColumns{RiskStructure::canal, RiskStructure::lingual, RiskStructure::second_molar};

/// The columns that rest on what nobody has confirmed: lingual surface and second molar are told by the tooth.
std::string notConfirmed(const assets::Proposed& proposed) {
  std::string columns = proposed.canal ? "canal_mm" : "";
  if (proposed.tooth) columns += std::string(columns.empty() ? "" : " ") + "lingual_mm second_molar_mm";
  return columns;
}

int clearance(const ClearanceOptions& options) {
  options.patient.refuseUnlessOne("clearance");
  const haptics::Tool tool = haptics::sanitised({headFrom(options.tool), shaftFrom(options.shaft)});
  refuseSameFile(options.out, {options.poses});
  calibration::OutputFile out(options.out, options.force);
  const std::vector<TimedPose> poses = readPoses(options.poses);
  refuseControls(poses, options.poses);
  const assets::Patient patient = options.patient.load();
  const assets::RiskStructures structures = cachedRiskStructures(patient);
  const std::string not_confirmed = notConfirmed(patient.proposed());

  std::string csv = "t_s,canal_mm,lingual_mm,second_molar_mm";
  csv += not_confirmed.empty() ? "\n" : ",not_confirmed\n";
  for (const TimedPose& pose : poses) {
    csv += fmt::format("{:.9g}", pose.t_s);
    for (const RiskStructure structure : kColumns) {
      csv += ",";
      if (const auto& distance = structures.of(structure); !distance.isEmpty())
        csv += fmt::format("{:.4f}", haptics::clearance_mm(distance, tool, pose.X_PT));
    }
    csv += not_confirmed.empty() ? "\n" : "," + not_confirmed + "\n";
  }
  out.commit(csv);
  return 0;
}

}  // namespace

void addClearance(CommandLine& molar) {
  auto options = std::make_shared<ClearanceOptions>();
  CommandLine& command =
      molar.command("clearance", "How near a tool comes to canal, lingual surface and second molar on given poses");
  options->patient.addTo(command);
  command.option("--tool", options->tool, headHelp()).required();
  command.option("--shaft", options->shaft, kShaftHelp).showsDefault();
  command.option("--poses", options->poses, "t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz (X_PT)").required();
  command.option("--out", options->out, "Distances, CSV: t_s,canal_mm,lingual_mm,second_molar_mm").required();
  command.flag("--force", options->force, "Replace the output if it exists");
  command.footer(
      "From the tool's surface to the structure as labelled in the scan, mm, negative inside; empty where the case has "
      "no such structure. A sphere: to its centre, less the radius. lingual: the outer surface of the jaw towards the "
      "tongue, from 20 mm before to 20 mm behind the operated tooth. Where the program found tooth or canal in a scan "
      "and nobody "
      "has confirmed them, a column not_confirmed names the columns that rest on them.");
  command.does([options] { return clearance(*options); });
}

}  // namespace app
