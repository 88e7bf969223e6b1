#include "app/text/shell_completion.h"

#include <vector>

#include "app/text/list.h"

namespace app {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Three tables of the script, a line per command or option.
struct Tables {
  std::string commands, values, words;

  void add(const std::string& path, const CommandHelp& command) {
    std::vector<std::string> offered;
    for (const CommandHelp& each : command.commands) offered.push_back(each.name);
    for (const OptionHelp& option : command.options) {
      if (option.is_positional) continue;
      // "-h,--help" is two.
      for (const std::string_view part : split(option.names)) {
        const std::string& name = offered.emplace_back(part);
        if (option.value.empty()) continue;
        values += "    " + quoted(path + " " + name) + ") values=" + quoted(joined(option.choices, {}, " ")) + " ;;\n";
      }
    }
    words += "    " + quoted(path) + ") words=" + quoted(joined(offered, {}, " ")) +
             (command.commands.empty() ? "" : " has_commands=1") + " ;;\n";
    for (const CommandHelp& each : command.commands) {
      const std::string inner = path.empty() ? each.name : path + " " + each.name;
      commands += "      " + quoted(path + " " + each.name) + ") command=" + quoted(inner) + " ;;\n";
      add(inner, each);
    }
  }
};

}  // namespace

std::string bashCompletion(const std::string& name, const CommandHelp& program) {
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
