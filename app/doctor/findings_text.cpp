#include "app/doctor/findings_text.h"

#include <fmt/core.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/text/wrapped_text.h"

namespace app {
namespace {

struct Mark {
  const char *word, *colour;
};

Mark markOf(Health health) {
  constexpr Mark kMarks[] = {{"ok", "\033[32m"}, {"look", "\033[33m"}, {"MISSING", "\033[31;1m"}, {"-", "\033[2m"}};
  return kMarks[static_cast<int>(health)];
}

int countOf(const std::vector<Finding>& findings, Health health) {
  return static_cast<int>(std::ranges::count(findings, health, &Finding::health));
}

}  // namespace

int missingCount(const std::vector<Finding>& findings) { return countOf(findings, Health::missing); }

std::string asText(const std::vector<Finding>& findings, const TerminalFormat& look) {
  std::size_t longest_id = 0;
  for (const Finding& one : findings) longest_id = std::max(longest_id, one.id.size());
  constexpr std::size_t kMarkWidth = 7;
  const std::size_t indent = 2 + kMarkWidth + 2 + longest_id + 2;

  std::string text;
  for (const Finding& one : findings) {
    const Mark mark = markOf(one.health);
    const std::string word = fmt::format("{:{}}", mark.word, kMarkWidth);
    text += "  " + (look.coloured ? mark.colour + word + "\033[0m" : word);
    text += fmt::format("  {:{}}  ", one.id, longest_id);
    text += wrappedText(one.sentence, indent, look.width) + "\n";
    if (!one.next_step.empty())
      text += std::string(indent, ' ') + "→ " + wrappedText(one.next_step, indent + 2, look.width) + "\n";
  }
  const int missing = missingCount(findings), warned = countOf(findings, Health::warn);
  text += fmt::format("\n  {} in order, {} to look at, {} missing, {} not needed.\n", countOf(findings, Health::ok),
                      warned, missing, countOf(findings, Health::not_needed));
  return text;
}

std::string asJson(const std::vector<Finding>& findings) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const Finding& one : findings)
    checks.push_back(
        {{"id", one.id}, {"state", nameOf(one.health)}, {"sentence", one.sentence}, {"next_step", one.next_step}});
  const nlohmann::ordered_json all = {{"checks", checks}, {"missing", missingCount(findings)}};
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
