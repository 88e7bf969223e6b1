#include "app/text/command_line.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "app/text/help_page.h"
#include "app/text/list.h"
#include "app/text/suggestion.h"
#include "app/text/terminal_format.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// Unlike CLI::Range it refuses text that is not a number.
template <class Number>
CLI::Validator numberRange(Number low, Number high) {
  const std::string words = fmt::format("{:.9g} to {:.9g}", static_cast<double>(low), static_cast<double>(high));
  return {[=](const std::string& given) {
            Number value{};
            const bool inside = CLI::detail::lexical_cast(given, value) && value >= low && value <= high;
            if (inside) return std::string();
            return std::string(std::is_integral_v<Number> ? "give a whole number from " : "give a number from ") +
                   words;
          },
          words, "numberRange"};
}

/// "iso is none of …" in the words of a person; CLI::IsMember prints a set.
CLI::Validator oneOfNames(const std::vector<std::string>& names) {
  return {[=](const std::string& given) {
            if (std::ranges::count(names, given) > 0) return std::string();
            return given + " is not possible, give one of " + joined(names);
          },
          "{" + joined(names, {}, ",") + "}", "oneOf"};
}

/// CLI11's name of a type, as people write it.
std::string valueName(const std::string& type) {
  return type == "FLOAT" || type == "INT" || type == "UINT" ? "NUMBER" : type;
}

/// CLI11 has them only as text of its help: "TEXT:{iso,dvr}".
std::vector<std::string> choicesIn(const std::string& type) {
  const std::size_t from = type.find('{'), end = type.rfind('}');
  if (from == std::string::npos || end == std::string::npos || end < from) return {};
  const auto choices = split(std::string_view(type).substr(from + 1, end - from - 1));
  return {choices.begin(), choices.end()};
}

OptionHelp helpOn(const CLI::Option& option) {
  OptionHelp help;
  help.names = option.get_name(false, true);
  help.about = option.get_description();
  help.is_required = option.get_required();
  help.is_positional = option.get_positional();
  help.group = option.get_group();
  if (option.get_items_expected_max() == 0) return help;
  const std::string type = option.get_type_name();
  help.choices = choicesIn(type);
  const std::size_t colon = type.find(':');
  help.value = valueName(type.substr(0, colon));
  if (const std::string rest = colon == std::string::npos ? "" : type.substr(colon + 1);
      rest.find(" to ") != std::string::npos && help.choices.empty())
    help.range = rest;
  help.default_value = option.get_default_str();
  // A list is shown as its values.
  if (help.default_value.starts_with('['))
    help.default_value = help.default_value.substr(1, help.default_value.size() - 2);
  return help;
}

}  // namespace

Option& Option::required() { return chained(option_->required()); }
Option& Option::valueNamed(const std::string& name) { return chained(option_->type_name(name)); }
Option& Option::showsDefault() { return chained(option_->capture_default_str()); }
Option& Option::oneOf(const std::vector<std::string>& values) { return chained(option_->check(oneOfNames(values))); }
Option& Option::from(double low, double high) { return chained(option_->check(numberRange(low, high))); }
Option& Option::wholeFrom(int low, int high) { return chained(option_->check(numberRange(low, high))); }
Option& Option::existingFolder() { return chained(option_->check(CLI::ExistingDirectory)); }
Option& Option::numbers(int count) { return chained(option_->expected(count)->delimiter(',')); }
Option& Option::separatedByCommas() { return chained(option_->delimiter(',')); }
Option& Option::hidden() { return chained(option_->group("")); }
Option& Option::needs(const Option& other) { return chained(option_->needs(other.option_)); }
Option& Option::excludes(const Option& other) { return chained(option_->excludes(other.option_)); }

Option& Option::repeated() {
  option_->type_size(1)->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

CommandLine::CommandLine(const std::string& about, const std::string& version)
    : program_(std::make_unique<CLI::App>(about)), app_(*program_) {
  app_.set_version_flag("--version", version);
  requireCommand();
}

CommandLine::CommandLine(CLI::App& app) : app_(app) {}

CommandLine::~CommandLine() = default;

CommandLine& CommandLine::command(const std::string& name, const std::string& about) {
  commands_.emplace_back(new CommandLine(*app_.add_subcommand(name, about)));
  return *commands_.back();
}

void CommandLine::requireCommand() { app_.require_subcommand(1); }

CommandLine& CommandLine::forEngineers() {
  group_ = "For engineers";
  return *this;
}

Option CommandLine::grouped(CLI::Option* option) const {
  option->group(option_group_);
  return Option(*option);
}

template <class Value>
Option CommandLine::option(const std::string& name, Value& value, const std::string& help) {
  return grouped(app_.add_option(name, value, help));
}

template Option CommandLine::option(const std::string&, std::string&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&);
template Option CommandLine::option(const std::string&, double&, const std::string&);
template Option CommandLine::option(const std::string&, int&, const std::string&);
template Option CommandLine::option(const std::string&, std::uint32_t&, const std::string&);
template Option CommandLine::option(const std::string&, std::uint64_t&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<double>&, const std::string&);
template Option CommandLine::option(const std::string&, std::vector<std::vector<double>>&, const std::string&);
template Option CommandLine::option(const std::string&, std::optional<std::string>&, const std::string&);
template Option CommandLine::option(const std::string&, std::optional<double>&, const std::string&);
template Option CommandLine::option(const std::string&, std::optional<int>&, const std::string&);

Option CommandLine::option(const std::string& name, std::function<void(const std::string&)> take,
                           const std::string& help) {
  return grouped(app_.add_option_function<std::string>(name, std::move(take), help));
}

Option CommandLine::flag(const std::string& name, bool& value, const std::string& help) {
  return grouped(app_.add_flag(name, value, help));
}

void CommandLine::footer(const std::string& text) { app_.footer(text); }

CommandHelp CommandLine::help() const {
  CommandHelp help{app_.get_name(), app_.get_description(), app_.get_footer(), group_, examples_, {}, {}};
  const auto is_last = [&](const CLI::Option* option) {
    return option == app_.get_help_ptr() || option == app_.get_version_ptr();
  };
  for (const bool last : {false, true})
    for (const CLI::Option* option : app_.get_options())
      if (!option->get_group().empty() && is_last(option) == last) help.options.push_back(helpOn(*option));
  for (const bool for_engineers : {false, true})
    for (const auto& command : commands_)
      if ((command->group_ == "For engineers") == for_engineers) help.commands.push_back(command->help());
  return help;
}

const CommandLine& CommandLine::chosen(std::string& name) const {
  for (const auto& command : commands_)
    if (command->app_.parsed() > 0) {
      name += " " + command->app_.get_name();
      return command->chosen(name);
    }
  return *this;
}

namespace {

/// "-h" in "-h,--help".
std::vector<std::string> namesOfOptions(const CommandHelp& command) {
  std::vector<std::string> names;
  for (const OptionHelp& option : command.options)
    for (const std::string_view name : split(option.names))
      if (!option.is_positional) names.emplace_back(name);
  return names;
}

}  // namespace

/// The words up to the first option name commands, as long as those have commands of their own.
void CommandLine::refuseUnknownCommand(int argc, const char* const* argv) const {
  const CommandLine* at = this;
  std::string name = "molar";
  for (int n = 1; n < argc && !at->commands_.empty() && argv[n][0] != '-'; ++n) {
    std::vector<std::string> names;
    const CommandLine* next = nullptr;
    for (const auto& command : at->commands_) {
      names.push_back(command->app_.get_name());
      if (names.back() == argv[n]) next = command.get();
    }
    // It takes words of its own beside commands.
    if (next == nullptr && at->action_) return;
    if (next == nullptr) {
      const std::string suggestion = didYouMean(argv[n], names);
      throw UsageError(std::string(argv[n]) + ": no such command" + (suggestion.empty() ? "," : suggestion) + " see " +
                       name + " --help");
    }
    name += " " + std::string(argv[n]);
    at = next;
  }
}

void CommandLine::refuseParse(const std::string& what, const std::vector<std::string>& unexpected) const {
  std::string name = "molar";
  const CommandLine& command = chosen(name);
  // "rehearse ", empty for the program.
  const std::string subject = name == "molar" ? "" : name.substr(6) + " ";
  const std::string see = " see " + name + " --help";
  const std::vector<std::string> names = namesOfOptions(command.help());
  for (const std::string& word : unexpected) {
    if (!word.starts_with('-')) continue;
    const std::string option = word.substr(0, word.find('='));
    const std::string suggestion = didYouMean(option, names);
    throw UsageError(subject + option + ": no such option" + (suggestion.empty() ? "," : suggestion) + see);
  }
  if (!unexpected.empty()) throw UsageError(subject + unexpected.front() + ": one word too many," + see);
  if (!command.commands_.empty() && !command.action_)
    throw UsageError((subject.empty() ? name : subject.substr(0, subject.size() - 1)) + ": a command is missing," +
                     see);
  throw UsageError(subject + what + "," + see);
}

int CommandLine::run(int argc, const char* const* argv) {
  const auto print_help = [&] {
    std::string name = "molar";
    const CommandHelp help = chosen(name).help();
    std::fputs(helpPage(name, help, terminalFormat()).c_str(), stdout);
    return 0;
  };
  if (argc < 2) return print_help();
  refuseUnknownCommand(argc, argv);
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return print_help();
  } catch (const CLI::ParseError& error) {
    // The version exits with 0.
    if (error.get_exit_code() == 0) return app_.exit(error);
    refuseParse(error.what(), app_.remaining(true));
  }
  std::string name;
  return chosen(name).action_();
}

}  // namespace app
