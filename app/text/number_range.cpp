#include "app/text/number_range.h"

#include <string>

#include <CLI/CLI.hpp>

namespace app {
namespace {

/// As a person writes it: no zeros behind.
std::string shortText(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

}  // namespace

CLI::Validator numberRange(double low, double high) {
  const std::string words = shortText(low) + " to " + shortText(high);
  return {[=](const std::string& given) {
            double value = 0.0;
            const bool inside = CLI::detail::lexical_cast(given, value) && value >= low && value <= high;
            return inside ? std::string() : "give a number from " + words;
          },
          words, "numberRange"};
}

}  // namespace app
