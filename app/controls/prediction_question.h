// What the surgeon expects before the first cut, asked in the picture: 1, 2 or 3 is the difficulty, + and - the minutes
// by one, Enter goes on; Enter without either leaves it unsaid. While it is open no other key means anything but
// movement, pedal and Esc. Also read from text: "difficulty=moderate,minutes=12". Pure; main thread.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "render/display/window.h"

namespace app {

inline constexpr std::array<std::string_view, 3> kDifficulties = {"easy", "moderate", "difficult"};
inline constexpr int kMostPredictedMinutes = 240;

struct PredictionAnswer {
  std::string difficulty;      ///< one of kDifficulties; empty: not said
  std::optional<int> minutes;  ///< none: not said
};

/// Throws UsageError with what is accepted.
PredictionAnswer predictionAnswerFrom(const std::string& text);

class PredictionQuestion {
 public:
  void open() { open_ = true; }
  bool isOpen() const { return open_; }
  /// "How difficult? 1 easy, 2 moderate, 3 difficult …" with what was chosen so far.
  std::string text() const;
  /// True: the key belongs to the question.
  bool take(const render::KeyPressed& key);
  /// Once, when it was answered.
  std::optional<PredictionAnswer> takeAnswer();

 private:
  bool open_ = false, answered_ = false;
  PredictionAnswer answer_;
};

}  // namespace app
