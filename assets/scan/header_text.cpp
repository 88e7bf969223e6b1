#include "assets/scan/header_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <set>

#include "assets/load_error.h"

namespace assets {

namespace {

constexpr std::size_t kMaxHeader = 1 << 20;
constexpr std::string_view kWhite = " \t\r\n\v\f";

std::string_view withoutPlus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

template <class Number>
std::optional<Number> numberIn(std::string_view word) {
  word = withoutPlus(word);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace

void refuseScan(const std::string& path, const std::string& reason) { throw LoadError(path + ": " + reason); }

void refuseSeveralValues(const std::string& path) {
  refuseScan(path, "its voxels are vectors, colours or complex numbers; give a volume with one value per voxel");
}

HeaderText::HeaderText(const RegularFile& file) : file_(file) {
  text_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kMaxHeader)));
  text_.resize(file.readAt(0, text_));
}

std::optional<std::string> HeaderText::line() {
  if (at_ >= text_.size()) {
    if (text_.size() < file_.size()) refuseScan(file_.path(), "its header does not end; export the volume again");
    return std::nullopt;
  }
  ++line_number_;
  const std::size_t end = text_.find('\n', at_);
  if (end == std::string::npos && text_.size() < file_.size())
    refuseScan(file_.path(), "line " + std::to_string(line_number_) + " of its header does not end; export it again");
  std::string found = text_.substr(at_, end == std::string::npos ? end : end - at_);
  at_ = end == std::string::npos ? text_.size() : end + 1;
  if (!found.empty() && found.back() == '\r') found.pop_back();
  return found;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kWhite);
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(kWhite) + 1 - from));
}

std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t from = text.find_first_not_of(kWhite); from != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kWhite, from), text.size());
    words.emplace_back(text.substr(from, end - from));
    from = text.find_first_not_of(kWhite, end);
  }
  return words;
}

std::string printableExcerpt(std::string_view text) {
  constexpr std::size_t kMax = 40;
  std::string shown(text.substr(0, kMax));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return "'" + shown + (text.size() > kMax ? "...'" : "'");
}

std::optional<std::int64_t> parseInteger(std::string_view word) { return numberIn<std::int64_t>(word); }

std::optional<double> parseReal(std::string_view word) { return numberIn<double>(word); }

std::optional<std::vector<double>> parseReals(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& word : wordsOf(text)) {
    const auto number = parseReal(word);
    if (!number || numbers.size() == count) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

std::optional<double> millimetresPer(const std::string& unit) {
  static const std::map<double, std::set<std::string>> kSpellings = {
      {1.0, {"", "none", "???", "?", "mm", "millimeter", "millimeters", "millimetre", "millimetres"}},
      {1.0e3, {"m", "meter", "meters", "metre", "metres"}},
      {10.0, {"cm", "centimeter", "centimetre"}},
      {1.0e-3, {"um", "\xc2\xb5m", "\xce\xbcm", "micron", "microns", "micrometer", "micrometers", "micrometre"}}};
  for (const auto& [mm, spellings] : kSpellings)
    if (spellings.contains(lowerCase(unit))) return mm;
  return std::nullopt;
}

}  // namespace assets
