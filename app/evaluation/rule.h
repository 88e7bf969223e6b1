// A rule of a task: "O1.removed >= 20 mm3 and not S1.canal < 1 mm". Measures by their ids (reference/product 4), each
// number with the unit of its measure; < <= > >= ==, and, or, not, ( ). A comparison with a measure that has no value
// yet is neither true nor false, and a rule holds only where it is true for certain. Plain values; any thread; 50 ns a
// comparison.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// A measure that rules may name.
struct RuleMeasure {
  std::string_view id, unit;  ///< unit empty: a pure number
};

/// One line: what is wrong, and where in the rule.
struct RuleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Rule {
 public:
  static constexpr std::size_t kLongest = 300, kMostTerms = 40;

  /// Throws RuleError: not a rule, a measure that is not in `known`, another unit than its own.
  static Rule from(std::string_view text, const std::vector<RuleMeasure>& known);

  const std::string& text() const { return text_; }
  /// Ids, each once.
  std::vector<std::string> measures() const;
  /// Its comparisons in the order written, each turned round where a `not` stands before it: "S1.canal >= 2 mm".
  struct Comparison {
    std::string id, comparator;  ///< < <= > >= == !=
    double limit = 0.0;
    /// None: the measure has no value.
    std::optional<bool> holds(const std::optional<double>& value) const;
  };
  std::vector<Comparison> comparisons() const;
  /// None: a measure that decides has no value.
  std::optional<bool> holds(const std::function<std::optional<double>(std::string_view id)>& value_of) const;

 private:
  enum class Kind : std::uint8_t { less, at_most, more, at_least, equal, negation, both, either };
  /// In the order of evaluation; `left` and `right` are places of terms before it.
  struct Term {
    Kind kind = Kind::less;
    std::string id;
    double number = 0.0;
    std::size_t left = 0, right = 0;
  };
  class Parser;

  std::string text_;
  std::vector<Term> terms_;
};

}  // namespace app
