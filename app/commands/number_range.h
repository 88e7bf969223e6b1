// A check for numbers on the command line that, unlike the library's own, refuses what is not a number.
#pragma once

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>

namespace app {

inline CLI::Validator numberRange(double low, double high) {
  const auto text = [](double value) {
    std::string t = std::to_string(value);
    t.erase(t.find_last_not_of('0') + 1);
    return t.back() == '.' ? t.substr(0, t.size() - 1) : t;
  };
  const std::string words = text(low) + " to " + text(high);
  return {[=](const std::string& given) {
            double value = 0.0;
            const bool inside = CLI::detail::lexical_cast(given, value) && value >= low && value <= high;
            return inside ? std::string() : "give a number from " + words;
          },
          words, "numberRange"};
}

}  // namespace app
