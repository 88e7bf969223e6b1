#include <algorithm>
#include <cctype>
#include <filesystem>
#include <tuple>
#include <vector>

#include "calibration/webcam/image_reader.h"
#include "calibration/webcam/image_source.h"

namespace calibration {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 10'000;

bool isPicture(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

/// By the last number in the name, compared by length and digits, then by name.
std::tuple<std::size_t, std::string, std::string> orderOf(const fs::path& path) {
  const std::string name = path.stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto last = std::find_if(name.rbegin(), name.rend(), is_digit);
  const auto first = std::find_if_not(last, name.rend(), is_digit);
  std::string number(first.base(), last.base());
  number.erase(0, std::min(number.find_first_not_of('0'), number.size()));
  return {number.size(), number, name};
}

class PictureFolder final : public ImageSource {
 public:
  explicit PictureFolder(std::string path) : path_(std::move(path)), files_(imageFilesIn(path_)) {}

  GreyImage take() override {
    if (next_ == files_.size())
      throw CalibrationError(name() + ": its " + std::to_string(next_) + " images are all used, add more");
    return readGreyImage(files_[next_++]);
  }
  std::string name() const override { return "folder " + path_; }

 private:
  std::string path_;
  std::vector<std::string> files_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<std::string> imageFilesIn(const std::string& folder) {
  const std::string name = "folder " + folder;
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (isPicture(entry->path()) && entry->is_regular_file(error)) files.push_back(entry->path());
    if (files.size() > kMaxFiles) throw CalibrationError(name + ": more than 10,000 images, give another folder");
  }
  if (error) throw CalibrationError(name + ": it cannot be read, check the path");
  if (files.empty()) throw CalibrationError(name + ": no PNG or JPEG in it, check the path");
  std::ranges::sort(files, {}, orderOf);
  return {files.begin(), files.end()};
}

std::unique_ptr<ImageSource> imageFolder(const std::string& path) { return std::make_unique<PictureFolder>(path); }

}  // namespace calibration
