#include "app/session/locator_event.h"

#include <string_view>

#include <fmt/core.h>

#include "app/text/parse_number.h"

namespace app {
namespace {

constexpr std::string_view kApex = "APEX";
constexpr double kMost_mm = 10.0;

}  // namespace

std::string locatorText(const std::optional<LocatorTold>& told) {
  if (!told) return "off";
  return told->is_apex ? fmt::format("{} {}", kApex, told->where)
                       : fmt::format("{:.1f} {}", told->left_mm, told->where);
}

std::optional<LocatorTold> locatorFrom(const std::string& text) {
  const std::size_t space = text.find(' ');
  if (space == std::string::npos) return {};
  const std::string_view first = std::string_view(text).substr(0, space);
  const std::string where = text.substr(space + 1);
  if (first == kApex) return LocatorTold{0.0, true, where};
  const std::optional<double> left_mm = parseNumber<double>(first);
  if (!left_mm || !(*left_mm >= 0.0 && *left_mm <= kMost_mm)) return {};
  return LocatorTold{*left_mm, false, where};
}

}  // namespace app
