#include "app/doctor/machine.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "app/text/parse_number.h"

namespace app {
namespace {

constexpr std::size_t kMostLines = 10'000;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

bool mayUse(const std::filesystem::path& node) { return access(node.c_str(), R_OK | W_OK) == 0; }

Machine Machine::here(const std::filesystem::path& sessions) {
  Machine machine;
  machine.sessions = sessions;
  machine.home = variable("HOME");
  machine.runtime = variable("XDG_RUNTIME_DIR");
  if (machine.runtime.empty()) machine.runtime = "/run/user/" + std::to_string(getuid());
  if (const passwd* entry = getpwuid(getuid())) machine.user = entry->pw_name;
  return machine;
}

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; lines.size() < kMostLines && std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::optional<std::string> firstLine(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!stream) return {};
  std::getline(stream, line);
  return std::string(trimmed(line));
}

std::vector<std::filesystem::path> entriesOf(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code none;
  for (std::filesystem::directory_iterator at(folder, none), end; at != end; at.increment(none)) {
    entries.push_back(at->path());
    if (none) break;
  }
  std::ranges::sort(entries);
  return entries;
}

std::optional<bool> hasCapability(const Machine& machine, unsigned number) {
  constexpr std::string_view kEffective = "CapEff:";
  for (const std::string& line : linesOf(machine.proc / "self/status"))
    if (line.starts_with(kEffective))
      if (const auto bits = parseNumber<std::uint64_t>(trimmed(std::string_view(line).substr(kEffective.size())), 16))
        return (*bits >> number & 1u) != 0;
  return {};
}

std::optional<double> softLimit(const Machine& machine, std::string_view resource) {
  for (const std::string& line : linesOf(machine.proc / "self/limits")) {
    if (!line.starts_with(resource)) continue;
    const std::string_view rest = trimmed(std::string_view(line).substr(resource.size()));
    const std::string_view soft = rest.substr(0, rest.find(' '));
    if (soft == "unlimited") return -1.0;
    if (const auto value = parseNumber<double>(soft)) return value;
  }
  return {};
}

}  // namespace app
