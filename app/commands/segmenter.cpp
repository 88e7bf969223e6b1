#include "app/commands/segmenter.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "app/commands/outside_program.h"
#include "app/commands/private_folder.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCt = "{ct}", kLabels = "{labels}";

std::string replacedAll(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// NIfTI-1, one file, int16; its axes point right, anterior and superior (nifti1.h).
void writeNifti(const std::string& path, const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield) {
  std::string header(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(header.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::array<std::int16_t, 5> dimensions = {3, static_cast<std::int16_t>(grid.size.x),
                                                  static_cast<std::int16_t>(grid.size.y),
                                                  static_cast<std::int16_t>(grid.size.z), 1};
  for (std::size_t n = 0; n < dimensions.size(); ++n) put(40 + 2 * n, dimensions[n]);
  put(70, std::int16_t{4});
  put(72, std::int16_t{16});
  const auto spacing = static_cast<float>(grid.spacing_mm);
  put(76, 1.0F);
  for (std::size_t axis = 1; axis <= 3; ++axis) put(76 + 4 * axis, spacing);
  put(108, 352.0F);
  put(112, 1.0F);
  put(123, std::uint8_t{2});  // mm
  put(254, std::int16_t{1});
  const glm::dvec3 ras(-1.0, -1.0, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t row = 280 + 16 * static_cast<std::size_t>(axis);
    put(row + 4 * static_cast<std::size_t>(axis), static_cast<float>(ras[axis] * grid.spacing_mm));
    put(row + 12, static_cast<float>(ras[axis] * grid.origin_P_mm[axis]));
  }
  std::memcpy(header.data() + 344, "n+1", 4);
  std::ofstream file(path, std::ios::binary);
  file << header;
  file.write(reinterpret_cast<const char*>(hounsfield.data()), static_cast<std::streamsize>(2 * hounsfield.size()));
  if (!file.flush()) throw assets::LoadError("--segment-with: the scan cannot be written for it; free some space");
}

/// What programs need to start and to find their models; no tokens.
std::vector<std::string> plainEnvironment(const std::string& folder) {
  std::vector<std::string> environment = {"TMPDIR=" + folder};
  for (const char* name :
       {"PATH", "HOME", "LANG", "LC_ALL", "LD_LIBRARY_PATH", "PYTHONPATH", "VIRTUAL_ENV", "CONDA_PREFIX",
        "CUDA_VISIBLE_DEVICES", "OMP_NUM_THREADS", "nnUNet_results", "TOTALSEG_HOME_DIR"})
    if (const char* value = std::getenv(name)) environment.push_back(std::string(name) + "=" + value);
  return environment;
}

/// Throws LoadError where it does not end well.
void mustEndWell(const OutsideEnd& end, std::chrono::seconds limit) {
  const std::string option = "--segment-with: ";
  switch (end.kind) {
    case OutsideEnd::Kind::ended:
      if (end.status == 0) return;
      throw assets::LoadError(option + "it ended with status " + std::to_string(end.status) +
                              "; what it said stands above");
    case OutsideEnd::Kind::not_started:
      throw assets::LoadError(option + "its program cannot be started (" + std::string(std::strerror(end.status)) +
                              "); check the name");
    case OutsideEnd::Kind::late:
      throw assets::LoadError(option + "it took longer than " + std::to_string(limit.count() / 60) +
                              " minutes and was stopped");
    case OutsideEnd::Kind::stopped:
      throw assets::LoadError(option + "stopped, nothing was imported");
    case OutsideEnd::Kind::unknown:
      throw assets::LoadError(option + "how it ended cannot be told; retry");
  }
}

}  // namespace

std::vector<std::string> wordsOfCommand(const std::string& line) {
  std::vector<std::string> words;
  bool is_in_word = false;
  char quote = '\0';
  for (const char letter : line) {
    if (quote != '\0') {
      if (letter == quote)
        quote = '\0';
      else
        words.back() += letter;
      continue;
    }
    const bool is_space = letter == ' ' || letter == '\t';
    if (!is_space && !is_in_word) words.emplace_back();
    is_in_word = !is_space;
    if (letter == '\'' || letter == '"')
      quote = letter;
    else if (!is_space)
      words.back() += letter;
  }
  if (quote != '\0') throw UsageError("--segment-with: a quote is not closed");
  return words;
}

Segmenter::Segmenter(const std::string& command) : words_(wordsOfCommand(command)) {
  const auto holds = [&](std::string_view mark) {
    for (std::size_t n = 1; n < words_.size(); ++n)
      if (words_[n].find(mark) != std::string::npos) return true;
    return false;
  };
  if (!holds(kCt) || !holds(kLabels))
    throw UsageError(
        "--segment-with: give a program and its words with {ct} and {labels} among them, as in 'TotalSegmentator -i "
        "{ct} "
        "-o {labels} --ml -ta teeth'");
}

Segmenter::~Segmenter() = default;

std::string Segmenter::folder() const { return folder_ ? folder_->path() : std::string(); }

std::string Segmenter::labels(const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                              std::chrono::seconds limit) {
  std::error_code none;
  folder_ = std::make_unique<PrivateFolder>((fs::temp_directory_path(none) / "molar_").string(), "--segment-with");
  const std::string ct = folder_->file("ct.nii"), made = folder_->file("labels.nii.gz");
  writeNifti(ct, grid, hounsfield);
  std::vector<std::string> words = words_;
  for (std::string& word : words) word = replacedAll(replacedAll(word, kCt, ct), kLabels, made);
  mustEndWell(runToEnd({.words = words, .environment = plainEnvironment(folder_->path()), .limit = limit}), limit);
  std::error_code error;
  if (!fs::is_regular_file(made, error))
    throw assets::LoadError("--segment-with: it left no label map where {labels} says; see its help");
  fs::remove(ct, error);
  return made;
}

}  // namespace app
