#include "app/start_screen/start_lists.h"

#include <algorithm>
#include <exception>
#include <future>
#include <numbers>
#include <span>

#include <fmt/core.h>

#include "app/case/case.h"
#include "app/case/patient_placement.h"
#include "app/procedure/preparation/ideal_rule.h"
#include "app/session/session_folder.h"
#include "app/text/clock_text.h"
#include "assets/synthetic/jaw.h"
#include "assets/synthetic/practice_block.h"
#include "assets/synthetic/preparation_block.h"
#include "assets/tooth.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

/// "lower right third molar" as the beginning of a line.
std::string begun(std::string words) {
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

/// The surgeon's own patients before the built-in ones.
StartList caseStartList(std::span<const PatientListing> patients) {
  StartList list{"Case", {}, 0};
  for (const PatientListing& one : patients.first(std::min(patients.size(), kPatientsOffered)))
    list.choices.push_back(
        {.words = one.name,
         .beside = one.is_to_check ? "to be checked" : "imported",
         .about = begun(one.title) + (one.is_to_check ? ". Nobody has confirmed what was found in its scan: it is "
                                                        "looked at before the first rehearsal."
                                                      : ". Its folder is " + one.path + "."),
         .arguments = {one.path},
         .is_imported = true,
         .is_to_check = one.is_to_check});
  for (const Case& one : cases()) {
    if (one.name == usualCase().name) list.chosen = list.choices.size();
    list.choices.push_back(
        {.words = begun(assets::toothName(one.fdi())) + ", " + angulationText(one),
         .beside = fmt::format("{}, {}", one.name, difficultyText(one)),
         .about = fmt::format("{}; {}. {}.", begun(depthText(one)), canalText(one), begun(std::string(one.challenge))),
         .arguments = {"--case", std::string(one.name)},
         .fdi = one.fdi()});
  }
  for (const assets::PracticeText& block : assets::kPracticeTasks)
    list.choices.push_back({.words = begun(std::string(block.title)),
                            .beside = "practice",
                            .about = std::string(block.instruction) + ".",
                            .arguments = {"--case", std::string(block.key)},
                            .has_mouth = false});
  for (const assets::PreparationBlock& block : assets::kPreparationBlocks)
    list.choices.push_back({.words = begun(std::string(block.title)),
                            .beside = "practice",
                            .about = std::string(block.instruction) + ".",
                            .arguments = {"--case", std::string(block.key)},
                            .has_mouth = false});
  return list;
}

StartList taskList() {
  StartList list{"Operation", {}, 0};
  list.choices.push_back({.words = "Third molar",
                          .beside = "removed",
                          .about = "The impacted tooth of the chosen case: gutter, section, out with it.",
                          .arguments = {}});
  list.choices.push_back({.words = "Root canal",
                          .beside = "from the crown on",
                          .about = "The access cavity is drilled first, then the canals are filed.",
                          .arguments = {"--task", "root-canal"},
                          .task = StartTask::root_canal});
  list.choices.push_back({.words = "Root canal, cavity open",
                          .beside = "files alone",
                          .about = "The access cavity is there: the files go in.",
                          .arguments = {"--task", "root-canal", "--access", "open"},
                          .task = StartTask::root_canal});
  for (const IdealRule& rule : idealRules())
    list.choices.push_back(
        {.words = begun(std::string(rule.for_people)),
         .beside = "prepared",
         .about = "One tooth is prepared to its ideal: " + std::string(rule.for_people) + ", and measured against it.",
         .arguments = {"--task", "preparation", "--ideal", std::string(rule.name)},
         .task = StartTask::preparation});
  return list;
}

/// "mesiobuccal 20.4 mm, 24°".
std::string canalWords(const assets::ToothCanal& canal) {
  return fmt::format("{} {:.1f} mm, {:.0f}°", canal.name, canal.workingLength_mm(),
                     canal.schneider_rad * 180.0 / std::numbers::pi);
}

/// Of both sides: a left jaw is the right one's mirror image.
StartList toothList(std::span<const CanalTooth> right) {
  StartList list{"Tooth", {}, 0};
  list.choices.push_back({.words = "Point at it",
                          .beside = "",
                          .about = "For root canals: the jaw is shown, and a click takes the tooth under the pointer.",
                          .arguments = {}});
  constexpr int kRightToLeft = 10, kUsual = 46;
  for (const int by : {0, kRightToLeft})
    for (const CanalTooth& tooth : right) {
      // An impacted one cannot be treated.
      if (!tooth.canals || !tooth.remark.empty()) continue;
      const int fdi = tooth.fdi - by;
      std::string canals;
      for (const assets::ToothCanal& canal : tooth.canals->canals)
        canals += (canals.empty() ? "" : "; ") + canalWords(canal);
      if (fdi == kUsual) list.chosen = list.choices.size();
      const std::size_t count = tooth.canals->canals.size();
      list.choices.push_back({.words = fmt::format("{}", fdi),
                              .beside = fmt::format("{} canal{}", count, count == 1 ? "" : "s"),
                              .about = fmt::format("{}. Canals, working length and curve, of the built-in patient: {}.",
                                                   begun(assets::toothName(fdi)), canals),
                              .arguments = {"--tooth", fmt::format("{}", fdi)},
                              .fdi = fdi});
    }
  return list;
}

StartList handList(std::span<const haptics::FoundDevice> devices) {
  StartList list{"Hand", {}, 0};
  list.choices.push_back(
      {.words = "Mouse",
       .beside = "",
       .about = "Drag moves the bur, the wheel goes in and out, Space is the pedal. F1 shows all keys.",
       .arguments = {"--device", "mouse"}});
  for (const haptics::FoundDevice& found : devices) {
    const bool driven = haptics::isDeviceAddress(found.address);
    // A unit that Molar cannot use is told with its next step; what is none of its devices is left out.
    if (!driven && found.advice.empty()) continue;
    list.choices.push_back(
        {.words = found.name,
         .beside = driven ? "plugged in" : "not ready",
         .about = driven ? found.location + ", driven by " + found.driver + ". " + found.advice : found.advice,
         .arguments = {"--device", found.address},
         .why_not = driven ? "" : found.advice});
  }
  list.choices.push_back(
      {.words = "Demonstration",
       .beside = "",
       .about = "The program operates by itself, along the planned cut, in the canals or on the crown, and you watch.",
       .arguments = {"--device", "scripted"}});
  list.choices.push_back(
      {.words = "Demonstration, to the last piece",
       .beside = "",
       .about = "The whole operation, shown by itself: gutter, section, forceps. Some minutes; not for every scan.",
       .arguments = {"--device", "scripted", "--procedure", "third-molar"},
       .is_of_extraction = true});
  return list;
}

StartList calibrationList(std::span<const calibration::RigLocation> calibrations) {
  StartList list{"Calibration", {}, 0};
  list.choices.push_back({.words = "Usual",
                          .beside = "",
                          .about = "The calibration in force of the chosen device; without one the desk, magnified.",
                          .arguments = {}});
  for (const calibration::RigLocation& at : calibrations)
    list.choices.push_back(
        {.words = at.rig_id,
         .beside = at.serial + ", " + at.mount,
         .about = "The calibration in force of device " + at.serial + ", which stands on the " + at.mount + ".",
         .arguments = {"--rig", "current:" + at.rig_id, "--mount", at.mount}});
  list.choices.push_back({.words = "Plain monitor, life size",
                          .beside = "not measured",
                          .about = "1:1 on a usual 24-inch monitor, in full screen.",
                          .arguments = {"--rig", "desktop"}});
  list.choices.push_back({.words = "Mirrored workstation, life size",
                          .beside = "not measured",
                          .about = "1:1 through a half-silvered mirror of the usual place, in full screen.",
                          .arguments = {"--rig", "mirrored"}});
  return list;
}

StartList positionList() {
  StartList list{"Patient", {}, 0};
  constexpr std::pair<const char*, const char*> kWords[] = {
      {"Seated before you", "For comparison: most third molars are removed lying."},
      {"Lying, from the right", "At 10 o'clock, the head turned and tilted towards you."},
      {"Lying, from the left", "At 2 o'clock, the head turned and tilted towards you."},
      {"Lying, from behind", "At 12 o'clock, behind the head."}};
  list.choices.push_back({.words = "Usual",
                          .beside = "",
                          .about = "As the calibration was set up; without one seated before you.",
                          .arguments = {}});
  for (std::size_t n = 0; n < kPatientPositions.size(); ++n)
    list.choices.push_back({.words = kWords[n].first,
                            .beside = "",
                            .about = kWords[n].second,
                            .arguments = {"--position", std::string(kPatientPositions[n])}});
  return list;
}

/// Only of the built-in patient: a scan's mouth is as it was scanned.
StartList openingList() {
  constexpr double kWide_mm = assets::kMostOpening_mm, kNarrow_mm = 30.0, kTrismus_mm = assets::kLeastOpening_mm;
  StartList list{"Mouth opens", {}, 0};
  const auto offer = [&](double mm, const char* beside, const char* about, std::vector<std::string> arguments) {
    list.choices.push_back(
        {.words = fmt::format("{:g} mm", mm), .beside = beside, .about = about, .arguments = std::move(arguments)});
  };
  const auto asked = [](double mm) { return std::vector<std::string>{"--opening", fmt::format("{:g}", mm)}; };
  offer(assets::kUsualOpening_mm, "usual", "Between the edges of the incisors, as most adults open comfortably.", {});
  offer(kWide_mm, "wide", "The most that the built-in patient opens: more room for the handpiece.", asked(kWide_mm));
  offer(kNarrow_mm, "limited", "Less than 35 mm is trismus, as with pericoronitis: little room for the handpiece.",
        asked(kNarrow_mm));
  offer(kTrismus_mm, "trismus", "The least: the handpiece hardly passes between the teeth.", asked(kTrismus_mm));
  return list;
}

StartList sessionList(std::span<const SessionListing> sessions) {
  StartList list{"Go on with", {}, 0};
  list.choices.push_back(
      {.words = "A new rehearsal", .beside = "", .about = "Of the chosen case; it is recorded.", .arguments = {}});
  list.choices.push_back({.words = "An assessment",
                          .beside = "nothing helps",
                          .about =
                              "Of the chosen case: no coach, no clearances, no undo, no plan; all is recorded, and "
                              "the session says so.",
                          .arguments = {"--assess"}});
  const std::size_t most = list.choices.size() + kSessionsOffered;
  for (const SessionListing& one : sessions) {
    if (!one.isReadable()) continue;
    if (list.choices.size() == most) break;
    list.choices.push_back({.words = localDateTime(one.unix_s) + "  " + one.case_title,
                            .beside = clockText(one.length_s),
                            .about = (one.is_imported ? "Goes on where this session ended, with its bone and tools: "
                                                        "choose its patient under Case."
                                                      : "Goes on where this session ended: its bone, case and tools.") +
                                     (one.remark.empty() ? std::string() : " It has " + one.remark + "."),
                            .arguments = {"--continue", one.path},
                            .is_imported = one.is_imported});
  }
  return list;
}

}  // namespace

StartLists startLists(const StartFindings& found) {
  return {caseStartList(found.patients),       taskList(),     toothList(found.teeth), handList(found.devices),
          calibrationList(found.calibrations), positionList(), openingList(),          sessionList(found.sessions)};
}

StartLists startListsHere() {
  StartFindings found;
  // Some tenths of a second, beside the search for devices.
  auto teeth = std::async(std::launch::async, [] { return canalTeeth(assets::JawParameters{}); });
  try {
    found.patients = listPatients(usualPatientFolder());
  } catch (const std::exception&) {  // no data folder
  }
  try {
    found.devices = haptics::findDevices().devices;
  } catch (const std::exception&) {  // molar devices tells why
  }
  try {
    const calibration::RigStore store(calibration::RigStore::usualRoot());
    for (const calibration::RigLocation& at : store.locations())
      if (store.currentName(at)) found.calibrations.push_back(at);
  } catch (const std::exception&) {  // molar calibrate list tells why
  }
  try {
    found.sessions = listSessions(usualSessionFolder(), false, 2 * kSessionsOffered);
  } catch (const std::exception&) {  // molar sessions tells why
  }
  found.teeth = teeth.get();
  return startLists(found);
}

}  // namespace app
