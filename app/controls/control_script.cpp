#include "app/controls/control_script.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/options/tool_text.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// The first tick that does not begin before `t_s`; tick n begins at n/rate.
std::uint64_t tickAt(double t_s, double rate_Hz) {
  auto tick = static_cast<std::uint64_t>(std::max(0.0, std::floor(t_s * rate_Hz)));
  while (static_cast<double>(tick) / rate_Hz < t_s) ++tick;
  return tick;
}

int toolIn(const std::vector<haptics::Tool>& tray, const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc{} && end == text.data() + text.size()) {
    if (number >= 1 && number <= static_cast<int>(tray.size())) return number - 1;
    throw UsageError("tool " + text + ": the tray holds " + std::to_string(tray.size()) +
                     ", write its number from 1 or name more with --tool");
  }
  const haptics::BurShape head = headFrom(text);
  const auto found = std::ranges::find(tray, head, &haptics::Tool::head);
  if (found == tray.end()) throw UsageError("tool " + text + ": it is not on the tray, name it with --tool");
  return static_cast<int>(found - tray.begin());
}

}  // namespace

ControlScript::ControlScript(const std::vector<HandAsks>& asked, const std::vector<haptics::Tool>& tray,
                             double rate_Hz) {
  std::string held;
  for (const HandAsks& row : asked) try {
      const std::uint64_t tick = tickAt(row.t_s, rate_Hz);
      if (!row.tool.empty() && row.tool != held)
        wishes_.push_back({tick, {Control::tool, toolIn(tray, held = row.tool)}});
      if (!row.action.empty()) wishes_.push_back({tick, wishFrom(row.action)});
    } catch (const UsageError& error) {
      throw UsageError(row.where + ": " + error.what());
    }
}

std::vector<ControlWish> ControlScript::takeDue(std::uint64_t next_tick) {
  std::vector<ControlWish> due;
  for (; taken_ < wishes_.size() && wishes_[taken_].tick <= next_tick; ++taken_) due.push_back(wishes_[taken_].wish);
  return due;
}

std::optional<std::uint64_t> ControlScript::nextTick() const {
  return taken_ < wishes_.size() ? std::optional(wishes_[taken_].tick) : std::nullopt;
}

}  // namespace app
