#include "app/text/shell_completion.h"

#include <algorithm>
#include <vector>

namespace app {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// "-h,--help" is two.
std::vector<std::string> namesOf(const OptionWords& option) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= option.names.size();) {
    const std::size_t comma = std::min(option.names.find(',', at), option.names.size());
    names.push_back(option.names.substr(at, comma - at));
    at = comma + 1;
  }
  return names;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

/// The three tables, a line per command or option.
struct Tables {
  std::string commands, values, words;

  void add(const std::string& path, const CommandWords& command) {
    std::vector<std::string> offered;
    for (const CommandWords& each : command.commands) offered.push_back(each.name);
    for (const OptionWords& option : command.options) {
      if (option.is_by_place) continue;
      for (const std::string& name : namesOf(option)) {
        offered.push_back(name);
        if (option.value.empty()) continue;
        values += "    " + quoted(path + " " + name) + ") values=" + quoted(joined(option.choices)) + " ;;\n";
      }
    }
    words += "    " + quoted(path) + ") words=" + quoted(joined(offered)) +
             (command.commands.empty() ? "" : " has_commands=1") + " ;;\n";
    for (const CommandWords& each : command.commands) {
      const std::string inner = path.empty() ? each.name : path + " " + each.name;
      commands += "      " + quoted(path + " " + each.name) + ") command=" + quoted(inner) + " ;;\n";
      add(inner, each);
    }
  }
};

}  // namespace

std::string bashCompletion(const std::string& name, const CommandWords& program) {
  Tables tables;
  tables.add("", program);
  const std::string function = "_" + name;
  return "# Completion of " + name + " for bash.\n" + function +
         "() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} command= values=none words= has_commands= n\n"
         "  for ((n = 1; n < COMP_CWORD; ++n)); do\n"
         "    case \"$command ${COMP_WORDS[n]}\" in\n" +
         tables.commands +
         "    esac\n"
         "  done\n"
         "  case \"$command ${COMP_WORDS[COMP_CWORD - 1]}\" in\n" +
         tables.values +
         "  esac\n"
         "  case \"$command\" in\n" +
         tables.words +
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [ \"$values\" != none ]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$values\" -- \"$word\")\n"
         "  elif [ -n \"$has_commands\" ] || [[ $word == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "complete -o default -F " +
         function + " " + name + "\n";
}

}  // namespace app
