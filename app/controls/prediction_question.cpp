#include "app/controls/prediction_question.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr int kFirstMinutes = 15;

/// Movement, pedal, and what ends the rehearsal.
bool isOfTheHand(render::Key key) {
  using render::Key;
  return key == Key::space || key == Key::escape || (key >= Key::right && key <= Key::up) || key == Key::left_shift ||
         key == Key::right_shift || key == render::keyOf('Q') || key == render::keyOf('E');
}

}  // namespace

PredictionAnswer predictionAnswerFrom(const std::string& text) {
  PredictionAnswer answer;
  for (const std::string_view part : split(text)) {
    const std::size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    const std::string_view value = equals == std::string_view::npos ? "" : part.substr(equals + 1);
    if (key == "difficulty" && answer.difficulty.empty()) {
      if (std::ranges::find(kDifficulties, value) == kDifficulties.end())
        throw UsageError("--predict " + text + ": difficulty takes one of " + joined(kDifficulties));
      answer.difficulty = value;
    } else if (key == "minutes" && !answer.minutes) {
      answer.minutes = parseNumber<int>(value);
      if (!answer.minutes || *answer.minutes < 1 || *answer.minutes > kMostPredictedMinutes)
        throw UsageError(
            fmt::format("--predict {}: minutes takes a whole number from 1 to {}", text, kMostPredictedMinutes));
    } else {
      throw UsageError("--predict " + text + ": give difficulty=moderate,minutes=12, or one of the two");
    }
  }
  return answer;
}

std::string PredictionQuestion::text() const {
  std::string words = "How difficult?";
  for (std::size_t n = 0; n < kDifficulties.size(); ++n)
    words += answer_.difficulty == kDifficulties[n] ? fmt::format("  {} [{}]", n + 1, kDifficulties[n])
                                                    : fmt::format("  {} {}", n + 1, kDifficulties[n]);
  words += answer_.minutes ? fmt::format("   {} min (+ -)", *answer_.minutes) : "   minutes? (+ -)";
  const bool is_said = !answer_.difficulty.empty() || answer_.minutes;
  return words + (is_said ? "   Enter: begin" : "   Enter: leave it");
}

bool PredictionQuestion::take(const render::KeyPressed& key) {
  using render::Key;
  if (!open_ || isOfTheHand(key.key)) return false;
  if (!key.down) return true;
  for (std::size_t n = 0; n < kDifficulties.size(); ++n)
    if (key.key == render::keyOf(static_cast<char>('1' + n))) answer_.difficulty = kDifficulties[n];
  const bool more = key.key == render::keyOf('=') || key.key == Key::keypad_add;
  const bool less = key.key == render::keyOf('-') || key.key == Key::keypad_subtract;
  if (more || less)
    answer_.minutes =
        answer_.minutes ? std::clamp(*answer_.minutes + (more ? 1 : -1), 1, kMostPredictedMinutes) : kFirstMinutes;
  if (key.key == Key::enter && !key.repeated) open_ = false, answered_ = true;
  return true;
}

std::optional<PredictionAnswer> PredictionQuestion::takeAnswer() {
  return std::exchange(answered_, false) ? std::optional(answer_) : std::nullopt;
}

}  // namespace app
