#include "assets/toml_reader.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "assets/load_error.h"

namespace assets {
namespace {

constexpr std::size_t kMaxText = 300;

std::string nameOf(const std::string& table, const std::string& key) {
  if (table.empty()) return key;
  return key.empty() ? "[" + table + "]" : "[" + table + "] " + key;
}

std::string rangeText(const NumberRange& range) {
  const std::string unit = range.unit.empty() ? "" : " " + std::string(range.unit);
  return numberText(range.low) + " to " + numberText(range.high) + unit;
}

/// None unless it is a list of numbers within the range.
std::optional<std::vector<double>> numbersIn(const toml::node& node, const NumberRange& range) {
  const toml::array* list = node.as_array();
  if (!list) return std::nullopt;
  std::vector<double> values;
  for (const toml::node& one : *list) {
    const std::optional<double> value = one.is_number() ? one.value<double>() : std::nullopt;
    if (!value || !(*value >= range.low && *value <= range.high)) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

}  // namespace

std::string quotedToml(const std::string& text) {
  std::ostringstream quoted;
  quoted << toml::value<std::string>(text);
  return quoted.str();
}

std::string numberText(double value) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9).ptr;
  return {text.data(), end};
}

std::string exactText(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string readSmallFile(const std::string& path, std::size_t max_bytes, const std::string& if_missing) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw LoadError(path + ": there is no such regular file; " + if_missing);
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 16 * 1024> block;
  while (text.size() <= max_bytes && file) {
    file.read(block.data(), block.size());
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad() || !(text.size() > max_bytes || file.eof()))
    throw LoadError(path + ": it cannot be read, check its permissions");
  if (text.size() > max_bytes)
    throw LoadError(path + ": it is larger than " + std::to_string(max_bytes / 1024) + " kB, check the file");
  return text;
}

struct TomlReader::Document {
  std::string where;
  toml::table root;
  std::set<std::pair<std::string, std::string>> used;

  /// Null: there is none.
  const toml::table* tableOf(const std::string& name) const {
    const toml::node* at = &root;
    for (std::size_t from = 0; at && from < name.size();) {
      const std::size_t end = std::min(name.find('.', from), name.size());
      const std::string part = name.substr(from, end - from);
      std::size_t number = 0;
      if (const toml::array* const list = at->as_array())
        at = std::from_chars(part.data(), part.data() + part.size(), number).ec == std::errc() && number > 0
                 ? list->get(number - 1)
                 : nullptr;
      else
        at = at->as_table() ? at->as_table()->get(part) : nullptr;
      from = end + 1;
    }
    return at ? at->as_table() : nullptr;
  }
  const toml::node* find(const std::string& table, const std::string& key) const {
    const toml::table* at = tableOf(table);
    return at ? at->get(key) : nullptr;
  }
  const toml::node* use(const std::string& table, const std::string& key) {
    used.emplace(table, key);
    return find(table, key);
  }
  /// Something of this table or of one within it.
  bool isUsed(const std::string& table) const {
    return std::ranges::any_of(
        used, [&](const auto& one) { return one.first == table || one.first.starts_with(table + "."); });
  }
};

TomlReader::TomlReader(std::string_view text, std::string where) : document_(std::make_unique<Document>()) {
  document_->where = std::move(where);
  try {
    document_->root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw LoadError(document_->where + ": line " + std::to_string(error.source().begin.line) + ": not valid TOML (" +
                    printable(std::string(error.description()), 40) + "), correct it");
  }
}

TomlReader::~TomlReader() = default;
TomlReader::TomlReader(TomlReader&&) noexcept = default;
TomlReader& TomlReader::operator=(TomlReader&&) noexcept = default;

TomlReader TomlReader::fromFile(const std::string& path) { return {readSmallFile(path), path}; }

bool TomlReader::has(const std::string& table) const { return document_->tableOf(table) != nullptr; }

bool TomlReader::has(const std::string& table, const std::string& key) const {
  return document_->find(table, key) != nullptr;
}

bool TomlReader::isList(const std::string& table, const std::string& key) const {
  const toml::node* const node = document_->find(table, key);
  return node != nullptr && node->is_array();
}

std::vector<std::string> TomlReader::keysOf(const std::string& table) const {
  std::vector<std::string> keys;
  if (const toml::table* at = document_->tableOf(table))
    for (const auto& [key, node] : *at)
      if (!node.is_table()) keys.emplace_back(key.str());
  return keys;
}

int TomlReader::lineOf(const std::string& table, const std::string& key) const {
  const toml::node* node = document_->find(table, key);
  if (!node) node = document_->tableOf(table);
  return node ? static_cast<int>(node->source().begin.line) : 0;
}

void TomlReader::refuse(const std::string& table, const std::string& key, const std::string& reason) const {
  const int line = lineOf(table, key);
  throw LoadError(document_->where + ": " + (line > 0 ? "line " + std::to_string(line) + ": " : "") +
                  nameOf(printable(table, 40), printable(key, 40)) + ": " + reason);
}

double TomlReader::number(const std::string& table, const std::string& key, const NumberRange& range,
                          std::optional<double> fallback) {
  const toml::node* node = document_->use(table, key);
  if (!node && fallback) return *fallback;
  if (!node) refuse(table, key, "it is missing, give " + rangeText(range));
  const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value) refuse(table, key, "it is not a number, give " + rangeText(range));
  if (!(*value >= range.low && *value <= range.high))
    refuse(table, key, numberText(*value) + " is out of range, give " + rangeText(range));
  return *value;
}

std::int64_t TomlReader::integer(const std::string& table, const std::string& key, std::int64_t low, std::int64_t high,
                                 std::optional<std::int64_t> fallback) {
  const toml::node* node = document_->use(table, key);
  if (!node && fallback) return *fallback;
  const std::string range = "give a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  if (!node) refuse(table, key, "it is missing, " + range);
  const std::optional<std::int64_t> value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < low || *value > high) refuse(table, key, range);
  return *value;
}

bool TomlReader::boolean(const std::string& table, const std::string& key, std::optional<bool> fallback) {
  const toml::node* node = document_->use(table, key);
  if (!node && fallback) return *fallback;
  if (!node || !node->is_boolean()) refuse(table, key, "give true or false");
  return *node->value<bool>();
}

std::string TomlReader::text(const std::string& table, const std::string& key, std::optional<std::string> fallback) {
  const toml::node* node = document_->use(table, key);
  if (!node && fallback) return *fallback;
  if (!node) refuse(table, key, "it is missing, give a text in quotes");
  const std::optional<std::string> value = node->is_string() ? node->value<std::string>() : std::nullopt;
  if (!value || *value != printable(*value, kMaxText))
    refuse(table, key, "give one line of text in quotes, at most 300 bytes");
  return *value;
}

std::size_t TomlReader::choice(const std::string& table, const std::string& key,
                               std::initializer_list<std::string_view> choices, std::optional<std::size_t> fallback) {
  const toml::node* node = document_->use(table, key);
  if (!node && fallback) return *fallback;
  const std::string given = node && node->is_string() ? *node->value<std::string>() : std::string();
  std::string words;
  std::size_t index = 0;
  for (const std::string_view one : choices) {
    if (node && node->is_string() && one == given) return index;
    words += (index++ == 0 ? "\"" : ", \"") + std::string(one) + "\"";
  }
  refuse(table, key, (node ? "no such choice, give one of " : "it is missing, give one of ") + words);
}

std::vector<std::string> TomlReader::texts(const std::string& table, const std::string& key, std::size_t max_count) {
  const toml::node* node = document_->use(table, key);
  const toml::array* const list = node ? node->as_array() : nullptr;
  std::vector<std::string> texts;
  for (std::size_t i = 0; list && i < list->size() && i < max_count; ++i)
    if (const auto text = (*list)[i].value<std::string>();
        (*list)[i].is_string() && *text == printable(*text, kMaxText))
      texts.push_back(*text);
  if (!list || texts.size() != list->size())
    refuse(table, key, "give a list of at most " + std::to_string(max_count) + " texts in quotes");
  return texts;
}

std::size_t TomlReader::tables(const std::string& list, std::size_t min_count, std::size_t max_count) {
  const toml::node* node = document_->use("", list);
  const toml::array* const array = node ? node->as_array() : nullptr;
  const bool are_tables =
      array && std::all_of(array->begin(), array->end(), [](const toml::node& one) { return one.is_table(); });
  if (!are_tables || array->size() < min_count || array->size() > max_count)
    refuse("", list,
           "give " + std::to_string(min_count) + " to " + std::to_string(max_count) + " tables, each after [[" + list +
               "]]");
  return array->size();
}

std::vector<double> TomlReader::numbers(const std::string& table, const std::string& key, const NumberRange& range,
                                        std::size_t min_count, std::size_t max_count) {
  const toml::node* node = document_->use(table, key);
  const std::string want = "give a list of " + std::to_string(min_count) + " to " + std::to_string(max_count) +
                           " numbers from " + rangeText(range);
  if (!node) refuse(table, key, "it is missing, " + want);
  if (min_count <= 1 && node->is_number()) return {number(table, key, range)};
  const auto values = numbersIn(*node, range);
  if (!values || values->size() < min_count || values->size() > max_count) refuse(table, key, want);
  return *values;
}

glm::dvec3 TomlReader::vector(const std::string& table, const std::string& key, double limit) {
  const std::vector<double> v = numbers(table, key, {-limit, limit, ""}, 3, 3);
  return {v[0], v[1], v[2]};
}

std::vector<glm::dvec3> TomlReader::vectors(const std::string& table, const std::string& key, double limit,
                                            std::size_t max_count) {
  const toml::node* node = document_->use(table, key);
  const NumberRange range{-limit, limit, ""};
  const toml::array* list = node ? node->as_array() : nullptr;
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; list && i < list->size() && i <= max_count; ++i)
    if (const auto v = numbersIn((*list)[i], range); v && v->size() == 3)
      points.emplace_back((*v)[0], (*v)[1], (*v)[2]);
  if (!list || points.size() != list->size() || points.size() > max_count)
    refuse(table, key,
           "give a list of at most " + std::to_string(max_count) + " points of three numbers from " + rangeText(range));
  return points;
}

void TomlReader::refuseUnknownKeys() const {
  const std::function<void(const std::string&, const toml::table&)> check = [&](const std::string& path,
                                                                                const toml::table& table) {
    const auto inner = [&](const auto& key) { return (path.empty() ? "" : path + ".") + std::string(key.str()); };
    for (const auto& [key, node] : table)
      if (!document_->used.contains({path, std::string(key.str())}) && !node.is_table())
        refuse(path, std::string(key.str()), "no such key here, remove it or correct its spelling");
    for (const auto& [key, node] : table) {
      if (const toml::table* const own = node.as_table()) {
        if (!document_->isUsed(inner(key)))
          refuse(inner(key), "", "no such table here, remove it or correct its spelling");
        check(inner(key), *own);
      } else if (const toml::array* const list = node.as_array()) {
        for (std::size_t i = 0; i < list->size(); ++i)
          if (const toml::table* const one = (*list)[i].as_table())
            check(inner(key) + "." + std::to_string(i + 1), *one);
      }
    }
  };
  check("", document_->root);
}

}  // namespace assets
