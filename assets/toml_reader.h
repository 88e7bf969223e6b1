// A small TOML file as typed answers: table by table, key by key, with the range each number must keep. Every refusal
// is one line (LoadError) that names file, line and key; what nobody asked for is refused too (refuseUnknownKeys), so
// that a misspelt key is never silently a default. Start-up and, for files read anew while running, the frame loop;
// never the servo. Files up to 64 kB. The one home of toml++.
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
  /// `where` names the file in refusals.
  TomlReader(std::string_view text, std::string where);
  ~TomlReader();
  TomlReader(TomlReader&&) noexcept;
  TomlReader& operator=(TomlReader&&) noexcept;

  static TomlReader fromFile(const std::string& path);

  /// The empty name is the file's own level, above every [table].
  bool has(const std::string& table) const;
  bool has(const std::string& table, const std::string& key) const;
  std::vector<std::string> keysOf(const std::string& table) const;
  /// Where a value stands, for logs.
  int lineOf(const std::string& table, const std::string& key) const;

  // Without `fallback` the key must be there.
  double number(const std::string& table, const std::string& key, const NumberRange& range,
                std::optional<double> fallback = {});
  std::int64_t integer(const std::string& table, const std::string& key, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> fallback = {});
  bool boolean(const std::string& table, const std::string& key, std::optional<bool> fallback = {});
  std::string text(const std::string& table, const std::string& key, std::optional<std::string> fallback = {});
  /// One of `choices`; the index into them.
  std::size_t choice(const std::string& table, const std::string& key, std::initializer_list<std::string_view> choices,
                     std::optional<std::size_t> fallback = {});
  /// One number counts as a list of one.
  std::vector<double> numbers(const std::string& table, const std::string& key, const NumberRange& range,
                              std::size_t least, std::size_t most);
  glm::dvec3 vector(const std::string& table, const std::string& key, double largest);
  /// A list of points, none among them.
  std::vector<glm::dvec3> vectors(const std::string& table, const std::string& key, double largest, std::size_t most);

  /// Refuses the first key or table that was not asked for.
  void refuseUnknownKeys() const;
  [[noreturn]] void refuse(const std::string& table, const std::string& key, const std::string& reason) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

/// Whole file, at most 64 kB; throws LoadError.
std::string readSmallFile(const std::string& path);

/// The text as a TOML value, in quotes.
std::string quotedToml(const std::string& text);

/// 0.8, not 0.800000: a number as a person writes it.
std::string numberText(double value);

}  // namespace assets
