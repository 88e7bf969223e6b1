#include "app/controls/control_script.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/options/tool_text.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// The first tick that does not begin before `t_s`; tick n begins at n/rate.
std::uint64_t tickAt(double t_s, double rate_Hz) {
  auto tick = static_cast<std::uint64_t>(std::max(0.0, std::floor(t_s * rate_Hz)));
  while (static_cast<double>(tick) / rate_Hz < t_s) ++tick;
  return tick;
}

/// The index, checked.
int onTray(const std::vector<haptics::Tool>& tray, int index, const std::string& written) {
  if (index >= 0 && index < static_cast<int>(tray.size())) return index;
  throw UsageError("tool " + written + ": the tray holds " + std::to_string(tray.size()) +
                   ", write its number from 1 or name more with --tool");
}

int toolIn(const std::vector<haptics::Tool>& tray, const std::string& text) {
  if (const auto number = parseNumber<int>(text)) return onTray(tray, *number - 1, text);
  const haptics::Tool wanted = toolFrom(text, {});
  const auto found = std::ranges::find_if(tray, [&](const haptics::Tool& tool) {
    return tool.head == wanted.head && tool.grips == wanted.grips && tool.elevator == wanted.elevator &&
           tool.hand_instrument == wanted.hand_instrument && tool.file == wanted.file;
  });
  if (found == tray.end()) throw UsageError("tool " + text + ": it is not on the tray, name it with --tool");
  return static_cast<int>(found - tray.begin());
}

}  // namespace

ControlScript::ControlScript(const std::vector<TimedRequest>& rows, const std::vector<haptics::Tool>& tray,
                             double rate_Hz) {
  int held = 0;
  for (const TimedRequest& row : rows) try {
      const std::uint64_t tick = tickAt(row.t_s, rate_Hz);
      const auto add = [&](const ControlRequest& request) { requests_.push_back({tick, request, row.where}); };
      if (!row.tool.empty())
        if (const int wanted = toolIn(tray, row.tool); std::exchange(held, wanted) != wanted)
          add({Control::tool, wanted});
      if (row.action.empty()) continue;
      const ControlRequest request = requestFrom(row.action);
      add(request);
      if (request.control != Control::tool) continue;
      held = request.value != kNoValue ? onTray(tray, request.value, std::to_string(request.value + 1))
                                       : (held + 1) % static_cast<int>(tray.size());
    } catch (const UsageError& error) {
      throw UsageError(row.where + ": " + error.what());
    }
}

std::vector<ScriptedRequest> ControlScript::takeDue(std::uint64_t next_tick) {
  std::vector<ScriptedRequest> due;
  for (; taken_ < requests_.size() && requests_[taken_].tick <= next_tick; ++taken_) due.push_back(requests_[taken_]);
  return due;
}

std::optional<std::uint64_t> ControlScript::nextTick() const {
  return taken_ < requests_.size() ? std::optional(requests_[taken_].tick) : std::nullopt;
}

}  // namespace app
