#include "assets/import/dicom/known_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "assets/scan/header_text.h"

namespace assets {
namespace {

constexpr const char* kOther = "other";

/// The first word of the list that the text holds, as the list writes it.
template <std::size_t Count>
std::string ofList(std::string_view text, const std::array<std::string_view, Count>& words) {
  const std::string lower = lowerCase(std::string(text));
  if (trimmed(lower).empty()) return {};
  for (const std::string_view word : words)
    if (lower.find(lowerCase(std::string(word))) != std::string::npos) return std::string(word);
  return kOther;
}

}  // namespace

std::string knownModality(std::string_view text) {
  constexpr std::array<std::string_view, 24> kCodes = {"CT", "MR", "PT", "NM", "US",  "XA",     "RF",       "CR",
                                                       "DX", "MG", "IO", "PX", "OT",  "SC",     "SR",       "SEG",
                                                       "PR", "KO", "ES", "XC", "OPT", "RTDOSE", "RTSTRUCT", "REG"};
  const auto found = std::ranges::find(kCodes, text);
  return found == kCodes.end() ? kOther : std::string(*found);
}

std::string knownManufacturer(std::string_view text) {
  constexpr std::array<std::string_view, 30> kMakers = {
      "Siemens",         "GE Medical", "Philips",  "Toshiba",    "Canon",
      "Hitachi",         "Fujifilm",   "Shimadzu", "Carestream", "Planmeca",
      "Vatech",          "NewTom",     "Sirona",   "KaVo",       "Imaging Sciences",
      "Instrumentarium", "Soredex",    "Morita",   "QR s.r.l.",  "Acteon",
      "Owandy",          "MyRay",      "Cefla",    "PreXion",    "Asahi",
      "Rayscan",         "Genoray",    "HDX",      "LargeV",     "Meyer"};
  return ofList(text, kMakers);
}

std::string knownModel(std::string_view text) {
  constexpr std::array<std::string_view, 36> kModels = {
      "SOMATOM",   "LightSpeed", "Revolution", "Discovery", "BrightSpeed", "Optima",       "Brilliance", "Ingenuity",
      "iCT",       "Aquilion",   "ProMax",     "Viso",      "i-CAT",       "CS 9300",      "CS 9600",    "CS 8100",
      "NewTom 5G", "NewTom VGi", "GALILEOS",   "Orthophos", "Axeos",       "3D Accuitomo", "Veraview",   "OP300",
      "OP 3D",     "SCANORA",    "CRANEX",     "PaX-i3D",   "PaX",         "Green",        "Trium",      "X-Mind",
      "Hyperion",  "Alphard",    "DENTRI",     "RAYSCAN"};
  return ofList(text, kModels);
}

std::string knownKernel(std::string_view text) {
  const std::string word = trimmed(text);
  if (word.empty()) return {};
  constexpr std::array<std::string_view, 10> kWords = {"STANDARD", "BONE", "BONEPLUS", "SOFT",  "DETAIL",
                                                       "EDGE",     "LUNG", "SHARP",    "ULTRA", "CHST"};
  if (std::ranges::find(kWords, word) != kWords.end()) return word;
  const auto is_alnum = [](unsigned char c) { return std::isalnum(c) != 0; };
  const auto digits = std::ranges::count_if(word, [](unsigned char c) { return std::isdigit(c) != 0; });
  const bool is_code = word.size() <= 5 && std::ranges::all_of(word, is_alnum) && digits > 0 && digits <= 3;
  return is_code ? word : kOther;
}

}  // namespace assets
