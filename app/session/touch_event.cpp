#include "app/session/touch_event.h"

#include <algorithm>
#include <string_view>

#include <fmt/core.h>

#include "app/text/parse_number.h"

namespace app {

std::string touchText(const Touch& touch) { return fmt::format("{}: {:.3f} s", touch.what, touch.contact_s); }

std::optional<Touch> touchFrom(const std::string& text) {
  const std::size_t colon = text.rfind(": ");
  if (colon == std::string::npos || !text.ends_with(" s")) return {};
  const auto contact_s = parseNumber<double>(
      std::string_view(text).substr(colon + 2, text.size() - colon - 2 - std::string_view(" s").size()));
  return contact_s ? std::optional(Touch{text.substr(0, colon), *contact_s}) : std::nullopt;
}

void countInto(std::vector<TouchCount>& counts, const Touch& touch) {
  auto found = std::ranges::find(counts, touch.what, &TouchCount::what);
  if (found == counts.end()) found = counts.insert(found, {touch.what, 0, 0.0});
  ++found->times;
  found->contact_s += touch.contact_s;
}

std::string touchesText(const std::vector<TouchCount>& counts) {
  std::string text;
  for (const TouchCount& count : counts)
    text += fmt::format("{}{} {}, {:.1f} s", text.empty() ? "" : "; ", count.what,
                        count.times == 1 ? std::string("once") : fmt::format("{} times", count.times), count.contact_s);
  return text;
}

}  // namespace app
