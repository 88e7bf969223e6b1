#include "assets/import/dicom/dicom_verdict.h"

#include <array>
#include <cstdio>

namespace assets {

std::string lineOf(const DicomVerdict& verdict) {
  return verdict.sentence.starts_with("scan") ? verdict.sentence : "scan: " + verdict.sentence;
}

std::string withThousands(unsigned long long number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

std::string shortNumber(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string number = text.data();
  if (number.find('.') == std::string::npos) return number;
  number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return number;
}

std::string ordinal(std::size_t number) {
  const bool is_teen = number % 100 / 10 == 1;
  const std::size_t last = is_teen ? 0 : number % 10;
  return std::to_string(number) + (last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th");
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace assets
