#include "app/session/gates.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/session/measures/clearance_measures.h"
#include "app/session/measures/rests_on.h"
#include "app/session/metrics.h"
#include "app/session/touch_event.h"
#include "app/text/clock_text.h"

namespace app {
namespace {

/// The neighbour's name in touches, of either side.
constexpr std::string_view kSecondMolar = "second molar";
constexpr double kLeastShown_mm3 = 0.01;
constexpr double kLeastOpen_mm2 = 0.005;  ///< what recordings keep of an area

std::string atTime(const std::optional<double>& t_s) { return t_s ? " at " + clockText(*t_s) : ""; }

const TouchCount* touchOf(const SessionMetrics& metrics, std::string_view ending) {
  if (!metrics.touched) return nullptr;
  for (const TouchCount& count : *metrics.touched)
    if (std::string_view(count.what).ends_with(ending)) return &count;
  return nullptr;
}

std::string touchWords(const TouchCount& count) {
  return fmt::format("the bur was on it {}, {} s in all",
                     count.times == 1 ? std::string("once") : fmt::format("{} times", count.times),
                     fmt::format("{:.1f}", count.contact_s));
}

/// The case has none of the structure of this least clearance: what is not there is not missed either.
bool hasNone(const SessionMetrics& metrics, std::string_view id) {
  const MeasureValue* const least = measureOf(metrics, id);
  return least != nullptr && !least->value && least->why == kNoStructure;
}

Gate perforationGate(const SessionMetrics& metrics) {
  Gate gate{"perforation", "lingual plate broken through", {}, {}};
  const MeasureValue* const area = measureOf(metrics, "O5.area");
  const bool is_out = metrics.socket && metrics.socket->is_out;
  const double in_socket_mm2 = is_out ? sumOf(metrics.socket->lingual) : 0.0;
  if (area != nullptr && area->value) {
    gate.is_open = *area->value > 0.0 || in_socket_mm2 > 0.0;
    if (*gate.is_open)
      gate.words = fmt::format("{:.1f}", std::max(*area->value, in_socket_mm2)) + " mm² of its outer surface" +
                   atTime(area->t_s);
  } else if (is_out) {
    gate.is_open = in_socket_mm2 > 0.0;
    if (*gate.is_open) gate.words = fmt::format("{:.1f}", in_socket_mm2) + " mm²";
  } else {
    gate.words = area != nullptr ? std::string(area->why) : "not measured";
  }
  return gate;
}

Gate secondMolarGate(const SessionMetrics& metrics) {
  Gate gate{"second_molar", "second molar touched by the bur", {}, {}};
  const MeasureValue* const removed = measureOf(metrics, "O10.second_molar");
  const TouchCount* const touch = touchOf(metrics, kSecondMolar);
  const bool is_cut = removed != nullptr && removed->value && *removed->value > 0.0;
  if (is_cut)
    gate.words = (*removed->value < kLeastShown_mm3 ? fmt::format("less than {:.2f}", kLeastShown_mm3)
                                                    : fmt::format("{:.2f}", *removed->value)) +
                 " mm³ gone" + atTime(removed->t_s);
  else if (touch != nullptr)
    gate.words = touchWords(*touch);
  else if (!metrics.touched)
    gate.words = "touches were not counted when this was recorded";
  if (is_cut || touch != nullptr)
    gate.is_open = true;
  else if (metrics.touched)
    gate.is_open = false;
  return gate;
}

Gate canalGate(const SessionMetrics& metrics) {
  Gate gate{"canal", "mandibular canal touched or laid open", {}, {}};
  const TouchCount* const touch = touchOf(metrics, kCanalTouch);
  const double laid_open_mm2 = metrics.socket && metrics.socket->is_out ? metrics.socket->canal.amount : 0.0;
  const bool is_none = hasNone(metrics, "S1.canal");
  // Where the tooth lay on it, whoever takes the tooth out lays it open.
  const double by_root_mm2 = laid_open_mm2 > 0.0 ? metrics.socket->canal_by_root_mm2 : 0.0;
  const double through_bone_mm2 = laid_open_mm2 - by_root_mm2;
  const bool is_through_bone = through_bone_mm2 >= kLeastOpen_mm2;
  if (is_through_bone)
    gate.words = fmt::format("{:.1f} mm² laid open{}", through_bone_mm2, by_root_mm2 > 0.0 ? " through bone" : "");
  else if (touch != nullptr)
    gate.words = touchWords(*touch);
  else if (is_none)
    gate.words = kNoStructure;
  else if (!metrics.touched)
    gate.words = "touches were not counted when this was recorded";
  if (is_through_bone || touch != nullptr)
    gate.is_open = true;
  else if (metrics.touched && !is_none)
    gate.is_open = false;
  if (by_root_mm2 > 0.0)
    gate.words +=
        fmt::format("{}{:.1f} mm² bare where the tooth lay on it", gate.words.empty() ? "" : ", ", by_root_mm2);
  return gate;
}

Gate retainedGate(const SessionMetrics& metrics) {
  Gate gate{"retained", "tooth left in the socket", {}, {}};
  if (!metrics.socket || !metrics.socket->is_out) {
    gate.words = "no piece of the tooth was out at the end";
    return gate;
  }
  gate.is_open = !metrics.socket->retained.empty();
  if (*gate.is_open) gate.words = fmt::format("{:.1f}", sumOf(metrics.socket->retained)) + " mm³";
  return gate;
}

}  // namespace

std::array<Gate, 4> gatesOf(const SessionMetrics& metrics) {
  std::array<Gate, 4> gates{perforationGate(metrics), secondMolarGate(metrics), canalGate(metrics),
                            retainedGate(metrics)};
  for (Gate& gate : gates) gate.is_confirmed = isConfirmed(gate.key, metrics.proposed);
  return gates;
}

std::string gatesInWords(const SessionMetrics& metrics) {
  std::string words;
  for (const Gate& gate : gatesOf(metrics)) {
    if (!words.empty()) words += "; ";
    words += fmt::format("{}: {}", gate.name, !gate.is_open ? "not known" : *gate.is_open ? "yes" : "no");
    if (!gate.words.empty()) words += ", " + gate.words;
    if (gate.is_open && !gate.is_confirmed) words += " (not confirmed)";
  }
  return words;
}

}  // namespace app
