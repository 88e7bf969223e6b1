#include "app/text/command_line.h"

#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "app/text/list.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// Unlike CLI::Range it refuses text that is not a number.
CLI::Validator numberRange(double low, double high) {
  const std::string words = fmt::format("{:.9g} to {:.9g}", low, high);
  return {[=](const std::string& given) {
            double value = 0.0;
            const bool inside = CLI::detail::lexical_cast(given, value) && value >= low && value <= high;
            return inside ? std::string() : "give a number from " + words;
          },
          words, "numberRange"};
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
  if (option.get_items_expected_max() == 0) return help;
  const std::string type = option.get_type_name();
  help.choices = choicesIn(type);
  help.value = type.substr(0, type.find(':'));
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
Option& Option::oneOf(const std::vector<std::string>& values) { return chained(option_->check(CLI::IsMember(values))); }
Option& Option::from(double low, double high) { return chained(option_->check(numberRange(low, high))); }
Option& Option::wholeFrom(int low, int high) { return chained(option_->check(CLI::Range(low, high))); }
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

template <class Value>
Option CommandLine::option(const std::string& name, Value& value, const std::string& help) {
  return Option(*app_.add_option(name, value, help));
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
  return Option(*app_.add_option_function<std::string>(name, std::move(take), help));
}

Option CommandLine::flag(const std::string& name, bool& value, const std::string& help) {
  return Option(*app_.add_flag(name, value, help));
}

void CommandLine::footer(const std::string& text) { app_.footer(text); }

CommandHelp CommandLine::help() const {
  CommandHelp help{app_.get_name(), app_.get_description(), app_.get_footer(), {}, {}};
  for (const CLI::Option* option : app_.get_options())
    if (!option->get_group().empty()) help.options.push_back(helpOn(*option));
  for (const auto& command : commands_) help.commands.push_back(command->help());
  return help;
}

int CommandLine::run(int argc, const char* const* argv) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version exit with 0.
    if (error.get_exit_code() == 0) return app_.exit(error);
    throw UsageError("command line: " + std::string(error.what()) + ", see molar --help or molar COMMAND --help");
  }
  // The innermost command that was given.
  const CommandLine* chosen = this;
  for (const CommandLine* next = this; next != nullptr;) {
    chosen = next;
    next = nullptr;
    for (const auto& command : chosen->commands_)
      if (command->app_.parsed()) next = command.get();
  }
  return chosen->action_();
}

}  // namespace app
