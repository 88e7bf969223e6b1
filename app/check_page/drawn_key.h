// What a part of a page was drawn of, as bytes: equal ones draw the same pixels. Plain value; any one thread; 1 ns a
// number.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace app {

class DrawnKey {
 public:
  template <class Value>
  DrawnKey& add(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
    return add(&value, sizeof value);
  }
  DrawnKey& add(const std::string& words) { return add(words.size()).add(words.data(), words.size()); }
  template <class Value>
  DrawnKey& add(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    return add(values.size()).add(values.data(), values.size() * sizeof(Value));
  }
  friend bool operator==(const DrawnKey&, const DrawnKey&) = default;

 private:
  DrawnKey& add(const void* from, std::size_t bytes) {
    if (bytes > 0) bytes_.append(static_cast<const char*>(from), bytes);
    return *this;
  }
  std::string bytes_;
};

}  // namespace app
