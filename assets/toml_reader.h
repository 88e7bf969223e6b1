// Typed access to a small TOML file, table by table and key by key, with a range for every number. Every error is one
// line (LoadError) with file, line and key. Keys that were never read are errors too (refuseUnknownKeys), so a misspelt
// key does not silently leave a default. A table within a table is named with a dot: "outer.inner"; the tables of a
// list [[name]] are "name.1", "name.2" …. Start-up, or the frame loop for files re-read while running; never the servo.
// Files up to 64 kB unless stated. The only user of toml++.
#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace assets {

struct NumberRange {
  double low = 0.0, high = 0.0;
  std::string_view unit = "";
};

class TomlReader {
 public:
  /// `where` names the file in messages.
  TomlReader(std::string_view text, std::string where);
  ~TomlReader();
  TomlReader(TomlReader&&) noexcept;
  TomlReader& operator=(TomlReader&&) noexcept;

  static TomlReader fromFile(const std::string& path);

  /// The empty name is the top level of the file.
  bool has(const std::string& table) const;
  bool has(const std::string& table, const std::string& key) const;
  bool isList(const std::string& table, const std::string& key) const;
  std::vector<std::string> keysOf(const std::string& table) const;
  int lineOf(const std::string& table, const std::string& key) const;

  // Without `fallback` the key is required.
  double number(const std::string& table, const std::string& key, const NumberRange& range,
                std::optional<double> fallback = {});
  std::int64_t integer(const std::string& table, const std::string& key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = {});
  bool boolean(const std::string& table, const std::string& key, std::optional<bool> fallback = {});
  std::string text(const std::string& table, const std::string& key, std::optional<std::string> fallback = {});
  /// Index into `choices`.
  std::size_t choice(const std::string& table, const std::string& key, std::initializer_list<std::string_view> choices,
                     std::optional<std::size_t> fallback = {});
  /// A list of lines of text.
  std::vector<std::string> texts(const std::string& table, const std::string& key, std::size_t max_count);
  /// How many tables the list [[list]] of the top level has.
  std::size_t tables(const std::string& list, std::size_t min_count, std::size_t max_count);
  /// A single number is read as a list of one.
  std::vector<double> numbers(const std::string& table, const std::string& key, const NumberRange& range,
                              std::size_t min_count, std::size_t max_count);
  glm::dvec3 vector(const std::string& table, const std::string& key, double limit);
  /// A list of points, possibly empty; each coordinate within -limit..limit.
  std::vector<glm::dvec3> vectors(const std::string& table, const std::string& key, double limit,
                                  std::size_t max_count);

  /// Throws for the first key or table that was not read.
  void refuseUnknownKeys() const;
  [[noreturn]] void refuse(const std::string& table, const std::string& key, const std::string& reason) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

/// Content of a regular file of at most `max_bytes`. Throws LoadError; `if_missing` says what to do without the file.
std::string readSmallFile(const std::string& path, std::size_t max_bytes = 64 * 1024,
                          const std::string& if_missing = "check the name");

/// The text as a TOML value, in quotes.
std::string quotedToml(const std::string& text);

/// Up to 9 digits, without trailing zeros: 0.8.
std::string numberText(double value);

/// The shortest text that reads back as the same number.
std::string exactText(double value);

}  // namespace assets
