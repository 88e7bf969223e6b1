#include "app/start_screen/kept_choices.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>

#include "app/session/data_folder.h"
#include "app/start_screen/start_menu.h"
#include "app/text/message.h"
#include "calibration/output_file.h"

namespace app {
namespace {

constexpr std::size_t kLongestLine = 200;

std::filesystem::path choicesFile() { return dataFolder("start-choices"); }

}  // namespace

std::vector<std::string> keptChoices() {
  std::vector<std::string> words;
  try {
    std::ifstream file(choicesFile());
    for (std::string line; words.size() < kStartLists && std::getline(file, line);) {
      if (line.size() > kLongestLine) return {};
      words.push_back(line);
    }
  } catch (const std::exception&) {  // no data folder
  }
  return words;
}

void keepChoices(const std::vector<std::string>& words) {
  try {
    const std::filesystem::path path = choicesFile();
    makeDataFolder(path.parent_path());
    std::string text;
    for (const std::string& line : words) text += line + "\n";
    calibration::OutputFile(path.string(), true).commit(text);
  } catch (const std::exception& error) {
    printMessage("what was chosen is not kept for the next start: " + calibration::withoutTemporaryNames(error.what()));
  }
}

}  // namespace app
