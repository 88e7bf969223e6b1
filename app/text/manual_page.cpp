#include "app/text/manual_page.h"

#include <algorithm>
#include <cctype>

#include "app/text/list.h"

namespace app {
namespace {

/// Escapes groff's control characters. Hyphens become \-, which can be copied from the page as a minus.
std::string escaped(const std::string& text) {
  std::string out;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    begins_line = c == '\n';
  }
  return out;
}

std::string heading(const std::string& words) { return ".SH " + words + "\n"; }
std::string bold(const std::string& words) { return "\\fB" + escaped(words) + "\\fR"; }
std::string italic(const std::string& words) { return "\\fI" + escaped(words) + "\\fR"; }

std::string dashed(std::string name) {
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string synopsis(const std::string& name, const CommandHelp& command) {
  std::string line = bold(name);
  for (const OptionHelp& option : command.options)
    if (!option.is_positional && option.is_required) line += " " + bold(option.names) + " " + italic(option.value);
  line += " [" + italic("OPTIONS") + "]";
  for (const OptionHelp& option : command.options)
    if (option.is_positional)
      line += option.is_required ? " " + italic(upper(option.names)) : " [" + italic(upper(option.names)) + "]";
  if (!command.commands.empty())
    line += command.mayGoWithout() ? " [" + italic("COMMAND") + "]" : " " + italic("COMMAND");
  return line + "\n";
}

std::string entry(const std::string& head, const std::string& about) {
  return ".TP\n" + head + "\n" + escaped(about) + "\n";
}

/// "-h, --help", each name bold.
std::string boldNames(const std::string& names) {
  return joined(split(names), [](std::string_view name) { return bold(std::string(name)); });
}

std::string entryOf(const OptionHelp& option) {
  std::string head = option.is_positional ? italic(upper(option.names)) : boldNames(option.names);
  if (!option.is_positional && !option.value.empty()) head += " " + italic(option.value);
  std::string about = option.about;
  if (!option.choices.empty()) about += (about.empty() ? "One of " : ". One of ") + joined(option.choices);
  if (!option.range.empty()) about += ", " + option.range;
  if (!option.default_value.empty()) about += " [" + option.default_value + "]";
  return entry(head, about);
}

}  // namespace

std::string manualFile(const std::string& name) { return dashed(name) + ".1"; }

std::string manualPage(const std::string& name, const CommandHelp& command, const std::string& program) {
  std::string page = ".TH \"" + upper(dashed(name)) + "\" 1 \"\" \"" + program + "\" \"Molar\"\n";
  page += heading("NAME") + escaped(dashed(name)) + " \\- " + escaped(command.about) + "\n";
  page += heading("SYNOPSIS") + synopsis(name, command);
  if (!command.commands.empty()) {
    page += heading("COMMANDS");
    for (const CommandHelp& each : command.commands)
      page += entry("\\fB" + escaped(dashed(name + " " + each.name)) + "\\fR(1)", each.about);
  }
  if (!command.examples.empty()) page += heading("EXAMPLES");
  for (const CommandExample& example : command.examples) page += entry(bold(example.line), example.about);
  page += heading("OPTIONS");
  for (const bool by_place : {true, false})
    for (const OptionHelp& option : command.options)
      if (option.is_positional == by_place) page += entryOf(option);
  if (!command.footer.empty()) page += heading("NOTES") + ".nf\n" + escaped(command.footer) + "\n.fi\n";
  page += heading("EXIT STATUS") + entry("0", "success") + entry("1", "the answer is \"no\"") +
          entry("2", "bad input, one line: molar: what, where, what to do");
  const std::size_t last = name.rfind(' ');
  if (last != std::string::npos)
    page += heading("SEE ALSO") + "\\fB" + escaped(dashed(name.substr(0, last))) + "\\fR(1)\n";
  return page;
}

}  // namespace app
