#include "app/report/markup.h"

#include <cmath>

#include <fmt/core.h>

namespace app {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (c == '\'')
      safe += "&#39;";
    else if (static_cast<unsigned char>(c) >= ' ')
      safe += c;
  }
  return safe;
}

std::string fixedText(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  if (text[0] != '-') return text;
  return (text.find_first_not_of("0.", 1) == std::string::npos ? "" : "\u2212") + text.substr(1);
}

std::string signedText(double value, int digits) {
  const std::string text = fixedText(value, digits);
  return value > 0.0 && text.find_first_not_of("0.") != std::string::npos ? "+" + text : text;
}

std::string shortText(double value) {
  return fixedText(value, std::abs(value) < 10.0 ? 2 : std::abs(value) < 100.0 ? 1 : 0);
}

std::string timeText(const std::string& utc) {
  return utc.size() == 20 && utc[10] == 'T' ? utc.substr(0, 10) + " " + utc.substr(11, 5) + " UTC" : utc;
}

}  // namespace app
