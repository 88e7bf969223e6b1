// Writes OpenCV FileStorage YAML into a string, doubles without loss. Any thread; allocates.
#pragma once

#include <array>
#include <concepts>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace calibration {

class YamlWriter {
 public:
  /// A number, a string, or a list of numbers on one line.
  struct Value {
    Value(int value) : data(value) {}
    Value(double value) : data(value) {}
    template <std::convertible_to<std::string_view> Text>
    Value(const Text& text) : data(std::string(std::string_view(text))) {}
    Value(std::vector<double> list) : data(std::move(list)) {}
    template <std::size_t n>
    Value(const std::array<double, n>& list) : data(std::vector<double>(list.begin(), list.end())) {}
    Value(const glm::ivec2& v) : data(std::vector<int>{v.x, v.y}) {}
    Value(const glm::dvec2& v) : data(std::vector<double>{v.x, v.y}) {}
    Value(const glm::dvec3& v) : data(std::vector<double>{v.x, v.y, v.z}) {}

    std::variant<int, double, std::string, std::vector<int>, std::vector<double>> data;
  };
  struct Field {
    std::string key;
    Value value;
  };
  using Fields = std::initializer_list<Field>;

  YamlWriter();
  ~YamlWriter();
  YamlWriter(const YamlWriter&) = delete;
  YamlWriter& operator=(const YamlWriter&) = delete;

  void put(const std::string& key, const Value& value);
  void put(Fields fields);
  void matrix(const std::string& key, const glm::dmat4& m);  ///< 4x4, row-major in the file
  void map(const std::string& key, Fields fields);

  void openMap(const std::string& key = {});  ///< without key: an entry of the open list
  void openList(const std::string& key);
  void close();
  void entry(const Value& value) { put({}, value); }  ///< of the open list
  void entry(Fields fields);                          ///< the same: a map on one line

  /// The complete text; call once.
  std::string text();

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace calibration
