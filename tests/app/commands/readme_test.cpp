// Commands, options and files quoted in the READMEs exist. Commands and options are taken from `molar completion`, keys
// from the help of `rehearse`.

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/commands/program.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFloors[] = {"app", "assets", "calibration", "haptics", "render", "tests"};

std::vector<std::string> wordsIn(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string textOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Quotes in a README: code in backticks, lines of shell blocks.
struct Readme {
  fs::path path;
  std::vector<std::string> spans, lines;

  explicit Readme(const fs::path& file) : path(file) {
    std::istringstream stream(textOf(file));
    std::string prose;
    bool in_shell = false, in_block = false;
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with("```")) {
        in_block = !in_block;
        in_shell = in_block && line == "```sh";
      } else if (in_shell) {
        lines.push_back(line);
      } else if (!in_block) {
        prose += line + "\n";
      }
    }
    static const std::regex kSpan("`([^`]+)`");
    for (std::sregex_iterator at(prose.begin(), prose.end(), kSpan), end; at != end; ++at) spans.push_back((*at)[1]);
  }
};

class ReadmeTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    for (const char* floor : kFloors)
      for (const auto& entry : fs::recursive_directory_iterator(root_ / floor)) files_.push_back(entry.path());
    for (const auto& entry : fs::directory_iterator(root_)) files_.push_back(entry.path());
    for (const fs::path& file : files_)
      if (file.filename() == "README.md") readmes_.emplace_back(file);
    for (const auto& entry : fs::directory_iterator(root_ / ".github")) readmes_.emplace_back(entry.path());
    for (const fs::path& file : files_)
      if (fs::is_directory(file) && file.filename() != "build") folders_.insert(file.filename().string());

    // `'calibrate fit') words='--json --out' …`: options of a command, and the commands within it.
    static const std::regex kWords("'([a-z ]*)'\\) words='([^']*)'");
    const std::string script = molar("completion").out;
    for (std::sregex_iterator at(script.begin(), script.end(), kWords), end; at != end; ++at) {
      const std::vector<std::string> words = wordsIn((*at)[2]);
      takes_[(*at)[1]] = {words.begin(), words.end()};
      options_.insert(words.begin(), words.end());
    }
  }

  /// `line` begins with "molar".
  void expectTaken(const std::string& line, const Readme& readme) const {
    const std::string place = readme.path.string() + ": " + line;
    std::string command;
    bool names_command = true;
    for (std::string word : wordsIn(line.substr(5))) {
      if (word.starts_with("#") || word == "&&" || word == "|") return;
      std::erase_if(word, [](char c) { return c == '[' || c == ']' || c == '(' || c == ')' || c == '"'; });
      word = word.substr(0, word.find_first_of(",;:="));
      if (word.starts_with("--")) {
        EXPECT_TRUE(takes_.at(command).contains(word)) << place << ": no option " << word;
        names_command = false;
      } else if (names_command && takes_.contains(command.empty() ? word : command + " " + word)) {
        command += (command.empty() ? "" : " ") + word;
      } else {
        // Placeholders are in capitals or have a dot.
        EXPECT_TRUE(!command.empty() || std::isupper(static_cast<unsigned char>(word[0])))
            << place << ": no command " << word;
        names_command = false;
      }
    }
  }

  bool isThere(const std::string& name, const Readme& readme) const {
    for (const fs::path& at : {root_ / name, readme.path.parent_path() / name})
      for (const char* ending : {"", ".h", ".cpp"})
        if (fs::exists(at.string() + ending)) return true;
    return std::ranges::any_of(files_, [&](const fs::path& file) {
      const std::string there = "/" + file.string();
      return there.ends_with("/" + name) || there.ends_with("/" + name + ".h") || there.ends_with("/" + name + ".cpp");
    });
  }

  const fs::path root_ = MOLAR_SOURCE_DIR;
  std::vector<fs::path> files_;
  std::vector<Readme> readmes_;
  std::set<std::string> folders_, options_;
  std::map<std::string, std::set<std::string>> takes_;
};

TEST_F(ReadmeTest, QuotesExistingCommandsAndOptions) {
  ASSERT_FALSE(takes_.empty());
  std::size_t looked_at = 0;
  for (const Readme& readme : readmes_) {
    for (const std::string& span : readme.spans) {
      if (span.starts_with("molar ")) expectTaken(span, readme), ++looked_at;
      static const std::regex kOption("^(--[a-z][a-z-]*)");
      std::smatch option;
      if (std::regex_search(span, option, kOption)) {
        EXPECT_TRUE(options_.contains(option[1])) << readme.path << ": no command has " << option[1];
        ++looked_at;
      }
    }
    for (const std::string& line : readme.lines)
      if (const std::size_t at = line.find("molar "); at != std::string::npos && (at == 0 || line[at - 1] == '/'))
        expectTaken(line.substr(at), readme), ++looked_at;
  }
  EXPECT_GT(looked_at, 50u);
}

TEST_F(ReadmeTest, QuotesExistingFiles) {
  std::size_t looked_at = 0;
  for (const Readme& readme : readmes_)
    for (const std::string& span : readme.spans) {
      // A path in the tree or the name of a source, not a user's file.
      static const std::regex kPlace("[A-Za-z0-9_.]+(/[A-Za-z0-9_.]+)+/?"),
          kSource("[a-z0-9_]+\\.(cpp|h|glsl|cmake|sh|md)");
      const bool is_place = std::regex_match(span, kPlace) && folders_.contains(span.substr(0, span.find('/')));
      if (!is_place && !std::regex_match(span, kSource)) continue;
      const std::string name = span.ends_with('/') ? span.substr(0, span.size() - 1) : span;
      EXPECT_TRUE(isThere(name, readme)) << readme.path << ": there is no " << span;
      ++looked_at;
    }
  EXPECT_GT(looked_at, 100u);
}

TEST_F(ReadmeTest, QuotesEveryKeyOfARehearsalAndNoOther) {
  const std::string help = molar("rehearse --help").out;
  std::istringstream lines(help.substr(help.find("Keys:\n") + 6));
  std::set<std::string> keys;
  for (std::string line; std::getline(lines, line) && line.starts_with("  ");) {
    std::string names = line.substr(2, 13);  // "1 - 7", "Q, E", "-", "Right drag"
    names.erase(names.find_last_not_of(' ') + 1);
    static const std::regex kBetween(", | - ");
    for (std::sregex_token_iterator name(names.begin(), names.end(), kBetween, -1), end; name != end; ++name)
      keys.insert(*name);
  }
  ASSERT_TRUE(keys.contains("Esc"));
  const std::string text = textOf(root_ / "README.md");
  for (const std::string& key : keys)
    EXPECT_TRUE(text.find("`" + key + "`") != std::string::npos || text.find("| " + key) != std::string::npos) << key;
  const Readme readme(root_ / "README.md");
  for (const std::string& span : readme.spans)
    if (span.size() == 1) {
      EXPECT_TRUE(keys.contains(span)) << span << " is no key";
    }
}

}  // namespace
}  // namespace app
