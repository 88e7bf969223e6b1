#include "app/evaluation/rule.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "app/text/list.h"

namespace app {
namespace {

constexpr int kDeepest = 20;

bool isWordLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_';
}

}  // namespace

/// By descent: either < both < negation < comparison.
class Rule::Parser {
 public:
  Parser(std::string_view text, const std::vector<RuleMeasure>& known) : text_(text), known_(known) {}

  std::vector<Term> parse() {
    next();
    either();
    if (!token_.empty()) refuse("\"" + std::string(token_) + "\" is too much here");
    return std::move(terms_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const {
    throw RuleError("at letter " + std::to_string(at_ + 1) + ": " + reason);
  }

  /// The next word, number with its sign, operator or bracket; empty: the end.
  void next() {
    while (end_ < text_.size() && text_[end_] == ' ') ++end_;
    at_ = end_;
    if (end_ == text_.size()) {
      token_ = {};
      return;
    }
    const char first = text_[end_++];
    if (isWordLetter(first) || first == '-') {
      // Also a number like 1e-3 and a unit like N/mm or 1/s.
      const bool is_number = first == '-' || (first >= '0' && first <= '9');
      const auto goes_on = [&](char c) {
        const bool is_exponent = is_number && c == '-' && text_[end_ - 1] == 'e';
        return isWordLetter(c) || c == '/' || is_exponent;
      };
      while (end_ < text_.size() && goes_on(text_[end_])) ++end_;
    } else if (std::string_view("<>=").find(first) != std::string_view::npos) {
      if (end_ < text_.size() && text_[end_] == '=') ++end_;
    } else if (first != '(' && first != ')') {
      refuse("give measures, numbers with units, < <= > >= ==, and, or, not and brackets");
    }
    token_ = text_.substr(at_, end_ - at_);
  }
  bool take(std::string_view word) {
    if (token_ != word) return false;
    next();
    return true;
  }
  std::size_t add(Term term) {
    if (terms_.size() == kMostTerms) refuse("the rule is too long, make it simpler");
    terms_.push_back(std::move(term));
    return terms_.size() - 1;
  }

  std::size_t either() {
    std::size_t left = both();
    while (take("or")) {
      const std::size_t right = both();
      left = add({Kind::either, {}, 0.0, left, right});
    }
    return left;
  }
  std::size_t both() {
    std::size_t left = negation();
    while (take("and")) {
      const std::size_t right = negation();
      left = add({Kind::both, {}, 0.0, left, right});
    }
    return left;
  }
  std::size_t negation() {
    if (++depth_ > kDeepest) refuse("there are too many brackets or not, make it simpler");
    std::size_t made = 0;
    if (take("not")) {
      made = add({Kind::negation, {}, 0.0, negation(), 0});
    } else if (take("(")) {
      made = either();
      if (!take(")")) refuse("a bracket is not closed");
    } else {
      made = comparison();
    }
    --depth_;
    return made;
  }

  std::size_t comparison() {
    if (token_.empty()) refuse("a comparison is missing, like O1.removed >= 20 mm3");
    const auto known = std::ranges::find(known_, token_, &RuleMeasure::id);
    if (known == known_.end()) {
      std::vector<std::string> ids;
      for (const RuleMeasure& one : known_) ids.emplace_back(one.id);
      refuse("\"" + std::string(token_) + "\" is no measure that is followed live, give one of " + joined(ids));
    }
    Term term;
    term.id = known->id;
    next();
    term.kind = comparator();
    const auto [end, error] = std::from_chars(token_.data(), token_.data() + token_.size(), term.number);
    if (token_.empty() || error != std::errc() || end != token_.data() + token_.size() || !std::isfinite(term.number))
      refuse("give a number after the comparison");
    next();
    readUnit(*known);
    return add(std::move(term));
  }

  Kind comparator() {
    constexpr std::array<std::string_view, 5> kWritten{"<", "<=", ">", ">=", "=="};
    const auto found = std::ranges::find(kWritten, token_);
    if (found == kWritten.end()) refuse("give < <= > >= or == after the measure");
    next();
    return static_cast<Kind>(found - kWritten.begin());
  }

  void readUnit(const RuleMeasure& measure) {
    const bool is_unit = !token_.empty() && isWordLetter(token_.front()) && token_ != "and" && token_ != "or";
    if (measure.unit.empty()) {
      if (is_unit) refuse(std::string(measure.id) + " is a pure number, leave \"" + std::string(token_) + "\" out");
      return;
    }
    if (!is_unit || token_ != measure.unit)
      refuse(std::string(measure.id) + " is in " + std::string(measure.unit) + ", write that after the number");
    next();
  }

  std::string_view text_;
  const std::vector<RuleMeasure>& known_;
  std::string_view token_;
  std::size_t at_ = 0, end_ = 0;
  int depth_ = 0;
  std::vector<Term> terms_;
};

Rule Rule::from(std::string_view text, const std::vector<RuleMeasure>& known) {
  if (text.size() > kLongest)
    throw RuleError("it is longer than " + std::to_string(kLongest) + " bytes, make it simpler");
  Rule rule;
  rule.text_ = text;
  rule.terms_ = Parser(text, known).parse();
  return rule;
}

std::vector<std::string> Rule::measures() const {
  std::vector<std::string> ids;
  for (const Term& term : terms_)
    if (!term.id.empty() && std::ranges::find(ids, term.id) == ids.end()) ids.push_back(term.id);
  return ids;
}

std::optional<bool> Rule::Comparison::holds(const std::optional<double>& value) const {
  if (!value) return {};
  if (comparator == "==") return *value == limit;
  if (comparator == "!=") return *value != limit;
  if (comparator.front() == '<') return comparator == "<" ? *value < limit : *value <= limit;
  return comparator == ">" ? *value > limit : *value >= limit;
}

std::vector<Rule::Comparison> Rule::comparisons() const {
  constexpr std::array<const char*, 5> kAsWritten{"<", "<=", ">", ">=", "=="}, kTurned{">=", ">", "<=", "<", "!="};
  // From the whole rule down to its parts, which stand before it.
  std::vector<bool> is_turned(terms_.size(), false);
  for (std::size_t n = terms_.size(); n-- > 0;) {
    const Term& term = terms_[n];
    if (term.kind < Kind::negation) continue;
    is_turned[term.left] = is_turned[n] != (term.kind == Kind::negation);
    if (term.kind != Kind::negation) is_turned[term.right] = is_turned[n];
  }
  std::vector<Comparison> all;
  for (std::size_t n = 0; n < terms_.size(); ++n) {
    const Term& term = terms_[n];
    if (term.kind >= Kind::negation) continue;
    const auto kind = static_cast<std::size_t>(term.kind);
    all.push_back({term.id, is_turned[n] ? kTurned[kind] : kAsWritten[kind], term.number});
  }
  return all;
}

std::optional<bool> Rule::holds(const std::function<std::optional<double>(std::string_view id)>& value_of) const {
  std::array<std::optional<bool>, kMostTerms> found;
  for (std::size_t n = 0; n < terms_.size(); ++n) {
    const Term& term = terms_[n];
    const std::optional<bool> left = found[term.left], right = found[term.right];
    const auto compared = [&](const auto& compare) {
      const std::optional<double> value = value_of(term.id);
      return value ? std::optional<bool>(compare(*value, term.number)) : std::nullopt;
    };
    switch (term.kind) {
      case Kind::less:
        found[n] = compared(std::less<>());
        break;
      case Kind::at_most:
        found[n] = compared(std::less_equal<>());
        break;
      case Kind::more:
        found[n] = compared(std::greater<>());
        break;
      case Kind::at_least:
        found[n] = compared(std::greater_equal<>());
        break;
      case Kind::equal:
        found[n] = compared(std::equal_to<>());
        break;
      case Kind::negation:
        if (left) found[n] = !*left;
        break;
      case Kind::both:
        if ((left && !*left) || (right && !*right))
          found[n] = false;
        else if (left && right)
          found[n] = true;
        break;
      case Kind::either:
        if ((left && *left) || (right && *right))
          found[n] = true;
        else if (left && right)
          found[n] = false;
        break;
    }
  }
  return found[terms_.size() - 1];
}

}  // namespace app
