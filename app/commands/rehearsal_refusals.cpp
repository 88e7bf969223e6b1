#include "app/commands/rehearsal_refusals.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/commands/compose_preparation.h"
#include "app/commands/rehearsed_case.h"
#include "app/device/pose_source_table.h"
#include "app/procedure/preparation/given_ideal.h"
#include "app/procedure/preparation/ideal_rule.h"
#include "app/session/session_folder.h"
#include "app/session/session_reader.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/scan/tooth_division.h"
#include "assets/synthetic/practice_block.h"
#include "assets/tooth.h"
#include "haptics/device/device_catalogue.h"

namespace app {

void refuseUnlessThirdMolar(const RehearsalPlan& plan, const std::string& procedure) {
  const std::optional<assets::OperativeSite>& site = plan.patient.site;
  if (!site || !assets::isThirdMolar(site->fdi) || assets::isUpper(site->fdi) ||
      assets::voxelsOfTooth(plan.patient.ct, site->fdi).empty())
    throw UsageError("--procedure " + procedure +
                     ": no lower third molar is labelled and numbered in this patient, import teeth.nrrd with it");
  if (!plan.cut)
    throw UsageError("--procedure " + procedure + ": no bur reaches bone beside the " + assets::toothName(site->fdi));
}

void refuseUnlessSteppable(const RehearseOptions& options) {
  if (!options.plan.headless) throw UsageError("--pace fast: a window needs real time, add --headless");
  const PoseSourceKind* const hand = poseSourceKindOf(options.plan.device);
  if (!hand || !hand->simulated)
    throw UsageError("--pace fast: " + options.plan.device +
                     " is not simulated, choose --device scripted, simulated, practice, replay or poses");
  if (!options.plan.second_hand.device.empty() && haptics::isDeviceAddress(options.plan.second_hand.device))
    throw UsageError("--pace fast: --second-hand " + options.plan.second_hand.device +
                     " is not simulated, choose scripted or replay:SESSION");
  if (options.plan.instructor_window) throw UsageError("--pace fast: a window needs real time, leave --instructor out");
  if (options.pedal != "auto" && options.pedal != "none")
    throw UsageError("--pace fast: a pedal needs real time, leave --pedal out");
}

void refuseUnlessForBlock(const RehearseOptions& options) {
  const std::string block =
      options.continued.empty() ? "--case " + options.case_name : "--continue " + options.continued;
  const std::string on = " needs a patient, leave it or " + block + " out";
  if (!options.procedure.empty()) throw UsageError("--procedure " + options.procedure + ":" + on);
  if (options.flap == "closed") throw UsageError("--flap closed:" + on);
  if (!options.face.empty()) throw UsageError("--face " + options.face + ":" + on);
  if (options.opening_mm) throw UsageError("--opening:" + on);
}

/// A task of one tooth, whose tooth is named and that is no extraction.
static void refuseUnlessForOneTooth(const RehearseOptions& options) {
  const std::string task = "--task " + options.task, with = " is of an extraction, leave it or " + task + " out";
  if (!options.tooth)
    throw UsageError(task + ": which tooth? give its FDI number with --tooth, molar teeth lists them" +
                     (options.task == "root-canal" ? ", or leave --headless out and point at it" : ""));
  if (!options.procedure.empty()) throw UsageError("--procedure " + options.procedure + ":" + with);
  if (options.flap == "closed") throw UsageError("--flap closed:" + with);
  if (!options.drawn.empty()) throw UsageError("--drawn " + options.drawn + ":" + with);
  if (practiceOf(options))
    throw UsageError("--case " + options.case_name + ": a practice block has no tooth, leave it or " + task + " out");
}

void refuseUnlessForRootCanal(const RehearseOptions& options) {
  refuseUnlessForOneTooth(options);
  if (preparationBlockOf(options) != nullptr)
    throw UsageError("--case " + options.case_name +
                     ": a practice block has no canals, leave it or --task root-canal out");
}

void refuseTooWide(const RehearsalPlan& plan) {
  const assets::ToothCanals& tooth = *plan.patient.canals;
  double widest_mm = 0.0;
  for (const assets::ToothCanal& canal : tooth.canals)
    widest_mm = std::max(widest_mm, 2.0 * std::min(canal.places.front().narrow_mm, canal.places.front().wide_mm));
  for (const haptics::Tool& tool : plan.other_tools)
    if (tool.isFile() && 0.01 * static_cast<double>(tool.file.size) > widest_mm)
      throw UsageError(
          fmt::format("--tool {}:{},{:g}: its tip is wider than the widest orifice of tooth {}, {:.2f} mm, choose "
                      "a smaller one",
                      tool.file.isCone() ? "gp-cone" : "k-file", tool.file.size,
                      tool.file.isCone() ? 100.0 * tool.file.cone_taper : tool.file.length_mm, tooth.fdi, widest_mm));
}

void refuseUnlessForPreparation(const RehearseOptions& options) {
  refuseUnlessForOneTooth(options);
  if (preparationBlockOf(options) != nullptr) {
    refuseUnlessForBlock(options);
    if (*options.tooth != assets::kPreparationBlockTooth)
      throw UsageError(fmt::format("--tooth {}: a practice block is a tooth of its own, leave it or --case {} out",
                                   *options.tooth, options.case_name));
    if (!options.caries.empty())
      throw UsageError("--caries " + options.caries + ": a practice block has none, leave it or --case " +
                       options.case_name + " out");
  }
  if (!options.given_ideal && !isIdealFile(options.ideal)) {
    if (std::ranges::find(idealRules(), options.ideal, &IdealRule::name) == idealRules().end())
      throw UsageError("--ideal " + options.ideal + ": no such preparation, give " +
                       joined(idealRules(), [](const IdealRule& rule) { return std::string(rule.name); }) +
                       ", or a FILE.nrrd or FILE.stl of the prepared tooth");
  }
  if (!options.hinge.empty()) hingeFrom(options.hinge);
  if (options.plan.device == "scripted" && !options.continued.empty())
    throw UsageError("--device scripted: its hand begins with an untouched tooth, leave --continue out");
  if (options.cavity != "ready") return;
  if (isIdealFile(options.ideal) || idealRule(options.ideal, "--ideal").kind != IdealKind::cavity)
    throw UsageError("--cavity ready: " + options.ideal + " is no cavity by rule, give --ideal class-1 or class-2");
  if (options.plan.device == "scripted")
    throw UsageError("--cavity ready: a scripted hand cuts the cavity itself, leave it out or give another --device");
  if (!options.continued.empty())
    throw UsageError("--cavity ready: --continue " + options.continued + " has its own cavity, leave one of them out");
}

void refuseUnlessDrawnHere(const RehearseOptions& options, const assets::CtVolume& ct) {
  const StoredStart start = SessionReader(sessionNamed(options.drawn)).start();
  if (!(start.grid == ct.grid) || start.label != ct.label)
    throw UsageError("--drawn " + options.drawn + ": was drawn in another case, name a session of this one");
}

void refuseUnlessAssessable(const RehearseOptions& options) {
  const auto refuse = [](const std::string& what, const char* why) {
    throw UsageError("--assess: " + what + " contradicts it (" + why + "), leave one of them out");
  };
  if (!options.coach.empty() && options.coach != "off") refuse("--coach " + options.coach, "nothing is said");
  if (!options.clearance.empty() && options.clearance != "off")
    refuse("--clearance " + options.clearance, "clearances are not told");
  if (!options.guidance.empty() && options.guidance != "assessed")
    refuse("--guidance " + options.guidance, "steps are recorded and not told");
  if (options.no_record) refuse("--no-record", "everything is recorded");
  if (!options.continued.empty()) refuse("--continue " + options.continued, "it begins with the untouched patient");
  if (!options.plan.parameters.empty()) refuse("--parameters " + options.plan.parameters, "its conditions stay");
  // A scripted hand with the gum closed shows incision and flap.
  if (isShown(options) || (options.plan.device == "scripted" && options.flap == "closed"))
    refuse("an operation that is shown", "somebody is to be assessed");
  if (const std::string layer = options.picture.help(); !layer.empty())
    refuse("--layers " + layer, "it shows what nobody sees");
}

}  // namespace app
