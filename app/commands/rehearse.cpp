// `molar rehearse [PATIENT]`: the rehearsal.

#include <malloc.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "app/case/case.h"
#include "app/commands/choose_tooth.h"
#include "app/commands/command.h"
#include "app/commands/compose_rehearsal.h"
#include "app/commands/rehearse_options.h"
#include "app/commands/rehearsed_case.h"
#include "app/rehearsal/rehearsal.h"
#include "app/session/session_error.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/message.h"

namespace app {
namespace {

/// Below the cases; empty where there is none or no data folder.
std::string importedList() {
  try {
    const std::string list = patientList(listPatients(usualPatientFolder()));
    return list.empty() ? list : "\nimported, molar rehearse NAME:\n" + list;
  } catch (const SessionError&) {
    return {};
  }
}

/// What preparing a patient takes goes back to the system when it is freed; else blocks of up to 32 MB are kept between
/// others: 170 MB of a root canal treatment. Pictures are smaller, so that a frame asks for no pages.
constexpr int kGivenBack_bytes = 8 << 20;

int runRehearse(RehearseOptions& options) {
  mallopt(M_MMAP_THRESHOLD, kGivenBack_bytes);
  if (options.list_cases) {
    std::fputs(
        (caseList() + "\npractice blocks, to learn the hand's work:\n" + practiceList() + importedList()).c_str(),
        stdout);
    return 0;
  }
  // Pointed at, where there is a window to point in.
  if (isRootCanal(options) && !options.tooth && !options.plan.headless && options.continued.empty()) {
    options.patient = patientNamed(options.patient);
    options.tooth = chooseTooth(options);
    if (!options.tooth) return printMessage("no tooth was chosen"), 0;
  }
  std::optional<RehearsalPlan> plan = composeRehearsal(options);
  return plan ? rehearse(std::move(*plan)) : 0;
}

}  // namespace

void addRehearse(CommandLine& molar) {
  auto options = std::make_shared<RehearseOptions>();
  CommandLine& command = molar.command("rehearse", "Rehearse a third-molar extraction, seen and felt");
  command.example("molar rehearse", "on the desk, with the mouse, on the built-in patient");
  command.example("molar rehearse --case horizontal --tool round:3.0 --tool fissure:1.6,6 --instructor",
                  "a difficult case with two burs, and the instructor's window beside it");
  command.example("molar rehearse PATIENT --device openhaptics --record first.molar",
                  "an imported patient, with a haptic device, recorded");
  addRehearseOptions(command, *options);
  command.does([options] { return runRehearse(*options); });
}

}  // namespace app
