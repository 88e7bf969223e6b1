#include "haptics/device/pedal/input_traits.h"

#include <linux/input-event-codes.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>

namespace haptics {
namespace {

constexpr std::size_t kWord_bits = 64, kMostWords = 16;  // KEY_MAX needs twelve

constexpr std::array<std::uint16_t, 26> kLetters = {KEY_A, KEY_B, KEY_C, KEY_D, KEY_E, KEY_F, KEY_G, KEY_H, KEY_I,
                                                    KEY_J, KEY_K, KEY_L, KEY_M, KEY_N, KEY_O, KEY_P, KEY_Q, KEY_R,
                                                    KEY_S, KEY_T, KEY_U, KEY_V, KEY_W, KEY_X, KEY_Y, KEY_Z};

std::string lineOf(const std::filesystem::path& file) {
  std::string line;
  std::ifstream stream(file);
  std::getline(stream, line);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return line;
}

std::uint16_t hexadecimalOf(const std::string& text) {
  std::uint16_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

int numberOf(const std::string& node) {
  int number = 0;
  std::from_chars(node.data() + 5, node.data() + node.size(), number);
  return number;
}

}  // namespace

bool InputTraits::hasKey(std::uint16_t code) const { return std::ranges::binary_search(keys, code); }

int InputTraits::letters() const {
  return static_cast<int>(std::ranges::count_if(kLetters, [this](std::uint16_t code) { return hasKey(code); }));
}

std::vector<std::uint16_t> bitsInText(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word && words.size() <= kMostWords;) words.push_back(word);
  if (words.size() > kMostWords) return {};
  std::vector<std::uint16_t> bits;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[words.size() - 1 - i];
    std::uint64_t value = 0;
    if (std::from_chars(word.data(), word.data() + word.size(), value, 16).ptr != word.data() + word.size()) return {};
    for (std::size_t bit = 0; bit < kWord_bits; ++bit)
      if ((value >> bit & 1u) != 0) bits.push_back(static_cast<std::uint16_t>(i * kWord_bits + bit));
  }
  return bits;
}

std::vector<InputTraits> inputDevices(const std::filesystem::path& class_folder) {
  std::vector<InputTraits> devices;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(class_folder, none)) {
    const std::string node = entry.path().filename().string();
    if (!node.starts_with("event")) continue;
    const std::filesystem::path device = entry.path() / "device";
    InputTraits traits;
    traits.node = node;
    traits.name = lineOf(device / "name");
    traits.vendor = hexadecimalOf(lineOf(device / "id/vendor"));
    traits.product = hexadecimalOf(lineOf(device / "id/product"));
    traits.keys = bitsInText(lineOf(device / "capabilities/key"));
    traits.axes = bitsInText(lineOf(device / "capabilities/abs"));
    const std::vector<std::uint16_t> relative = bitsInText(lineOf(device / "capabilities/rel"));
    traits.moves_a_pointer = std::ranges::find(relative, std::uint16_t{REL_X}) != relative.end();
    devices.push_back(std::move(traits));
  }
  std::ranges::sort(devices, {}, [](const InputTraits& one) { return numberOf(one.node); });
  return devices;
}

}  // namespace haptics
