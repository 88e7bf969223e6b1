#include "app/device/check/dialogue.h"

#include <algorithm>
#include <istream>
#include <ostream>

#include <fmt/core.h>

#include "app/text/parse_number.h"

namespace app {

void Dialogue::say(const std::string& text) { words_ << text << "\n" << std::flush; }

std::optional<std::string> Dialogue::line(const std::string& prompt) {
  if (over_) return {};
  words_ << prompt << std::flush;
  std::string text;
  over_ = !std::getline(answers_, text);
  std::erase_if(text, [](unsigned char c) { return c <= ' '; });
  if (over_ || text == "q" || text == "Q") {
    over_ = true;
    words_ << "\n";
    return {};
  }
  return text;
}

bool Dialogue::confirm(const std::string& to_do) { return line("  " + to_do + " [Enter] ").has_value(); }

std::optional<char> Dialogue::choice(const std::string& question, std::string_view letters) {
  while (const auto text = line("  " + question + " ")) {
    if (!text->empty() && letters.find(text->front()) != std::string_view::npos) return text->front();
    say("  Answer with one of these letters: " + std::string(letters) + "; q leaves.");
  }
  return {};
}

std::optional<double> Dialogue::number(const std::string& question, double min, double max) {
  while (auto text = line("  " + question + " ")) {
    std::ranges::replace(*text, ',', '.');
    if (const auto value = parseNumber<double>(*text); value && *value >= min && *value <= max) return value;
    say(fmt::format("  Give a number from {:g} to {:g}; q leaves.", min, max));
  }
  return {};
}

}  // namespace app
