#include "app/text/help_page.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "app/text/list.h"
#include "app/text/wrapped_text.h"

namespace app {
namespace {

/// Longer names have their explanation on the next line.
constexpr std::size_t kNameColumn = 30;

std::string title(const std::string& words, const TerminalFormat& format) {
  return format.coloured ? "\n\033[1m" + words + "\033[0m\n" : "\n" + words + "\n";
}

std::string upperCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string entry(const std::string& head, const std::string& about, const TerminalFormat& format) {
  std::string line = "  " + head;
  if (line.size() + 2 > kNameColumn)
    line += "\n" + std::string(kNameColumn, ' ');
  else
    line.resize(kNameColumn, ' ');
  return line + wrappedText(about, kNameColumn, format.width) + "\n";
}

/// Every choice stands in the text already, or there are none.
bool isExplained(const OptionHelp& option) {
  return std::ranges::all_of(option.choices,
                             [&](const std::string& choice) { return option.about.find(choice) != std::string::npos; });
}

std::string optionEntry(const OptionHelp& option, const TerminalFormat& format) {
  std::string head = option.is_positional ? upperCase(option.names) : joined(split(option.names));
  if (!option.is_positional && !option.value.empty()) head += " " + option.value;
  std::string about = option.about;
  if (!isExplained(option)) about += ": " + joined(option.choices);
  if (!option.range.empty()) about += ", " + option.range;
  if (!option.default_value.empty()) about += " [" + option.default_value + "]";
  if (option.is_required && !option.is_positional) about += " (required)";
  return entry(head, about, format);
}

/// Pairs of group and entries, in the order in which the groups appear.
using Groups = std::vector<std::pair<std::string, std::string>>;

void addTo(Groups& groups, const std::string& group, const std::string& text) {
  for (auto& [name, entries] : groups)
    if (name == group) {
      entries += text;
      return;
    }
  groups.emplace_back(group, text);
}

std::string usage(const std::string& name, const CommandHelp& command) {
  std::string line = name;
  if (!command.commands.empty()) line += command.mayGoWithout() ? " [COMMAND]" : " COMMAND";
  for (const OptionHelp& option : command.options)
    if (!option.is_positional && option.is_required) line += " " + option.names + " " + option.value;
  line += " [OPTIONS]";
  for (const OptionHelp& option : command.options)
    if (option.is_positional)
      line += option.is_required ? " " + upperCase(option.names) : " [" + upperCase(option.names) + "]";
  return line;
}

}  // namespace

std::string helpPage(const std::string& name, const CommandHelp& command, const TerminalFormat& format) {
  std::string page = wrappedText(command.about, 0, format.width) + "\n\n  " + usage(name, command) + "\n";
  if (!command.examples.empty()) {
    page += title(command.commands.empty() ? "Examples" : "Start with", format);
    for (const CommandExample& example : command.examples)
      page += "  " + example.line + "\n      " + wrappedText(example.about, 6, format.width) + "\n";
  }
  Groups groups;
  for (const CommandHelp& each : command.commands) addTo(groups, each.group, entry(each.name, each.about, format));
  for (const bool is_positional : {true, false})
    for (const OptionHelp& option : command.options)
      if (option.is_positional == is_positional) addTo(groups, option.group, optionEntry(option, format));
  for (const auto& [group, entries] : groups) page += title(group, format) + entries;
  if (!command.commands.empty()) page += "\n" + name + " COMMAND --help explains a command.\n";
  if (!command.footer.empty()) page += "\n" + command.footer + (command.footer.ends_with('\n') ? "" : "\n");
  return page;
}

}  // namespace app
