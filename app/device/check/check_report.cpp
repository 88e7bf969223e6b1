#include "app/device/check/check_report.h"

#include <algorithm>
#include <array>

namespace app {
namespace {

struct OpenQuestion {
  const char* text;
  bool can_be_checked;
  Evidence evidence;
};
constexpr std::array<OpenQuestion, 13> kOpenQuestions = {{
    {"the unit moves under a commanded force", true, Evidence::moves},
    {"the force has the right sign on every axis", true, Evidence::force_sign},
    {"a newton is a newton", true, Evidence::force_scale},
    {"the inkwell's switch is the right way round", true, Evidence::inkwell},
    {"the deadman feels a hand", true, Evidence::deadman},
    {"the pose is calibrated by the device's own style", true, Evidence::calibration},
    {"the axes of the pose point where they should", true, Evidence::axes},
    {"the rate and its jitter on the real bus", true, Evidence::rate},
    {"the base's offsets and the gimbal's zeros: molar calibrate", false, {}},
    {"the largest stiffness and damping under a human hand", false, {}},
    {"how bone and drill feel", false, {}},
    {"how warm the motors become", false, {}},
    {"what the unit does when the program is killed or the cable pulled", false, {}},
}};

const char* wordOf(Verdict verdict) {
  constexpr const char* kWords[] = {"ok", "**WRONG**", "not tried", "not there"};
  return kWords[static_cast<int>(verdict)];
}

/// Without the characters that would end a cell.
std::string cell(std::string text) {
  for (char& c : text)
    if (c == '|' || c == '\n' || c == '\r') c = ' ';
  return text;
}

}  // namespace

bool CheckReport::isGood() const {
  return !left_early && std::ranges::none_of(lines, [](const CheckLine& one) { return one.verdict == Verdict::wrong; });
}

std::string shortened(const std::string& serial) {
  constexpr std::size_t kShown = 4;
  return serial.size() <= kShown ? serial : "…" + serial.substr(serial.size() - kShown);
}

std::string pageOf(const CheckReport& report) {
  const bool is_simulated = report.device.provenance == haptics::Provenance::simulated;
  std::string page = "# Check of " + cell(report.device.model) + "\n\n";
  page += "- address `" + cell(report.address) + "`\n";
  if (!report.device.serial.empty()) page += "- serial number " + cell(shortened(report.device.serial)) + "\n";
  page += "- " + report.date + ", Molar " + report.program + "\n";
  page += std::string("- ") +
          (report.left_early ? "left before the end"
           : report.isGood() ? "everything tried is as it should be"
                             : "something is wrong: do not use this unit until it is repaired") +
          "\n\n";
  page += "| what | expected | found | |\n|---|---|---|---|\n";
  for (const CheckLine& one : report.lines)
    page += "| " + cell(one.what) + " | " + cell(one.expected) + " | " + cell(one.found) + " | " + wordOf(one.verdict) +
            " |\n";
  page += "\n## What only a real unit can show\n\n";
  if (is_simulated) page += "This unit is simulated and shows none of it.\n\n";
  for (const OpenQuestion& one : kOpenQuestions) {
    const bool confirmed =
        one.can_be_checked && !is_simulated && std::ranges::count(report.confirmed, one.evidence) != 0;
    page += std::string("- [") + (confirmed ? "x" : " ") + "] " + one.text + "\n";
  }
  return page;
}

}  // namespace app
