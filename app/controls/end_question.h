// The question before the end: Esc in the surgeon's window asks, Esc or Enter then ends, any other key goes on and does
// nothing else. Pure; main thread.
#pragma once

#include "render/display/window.h"

namespace app {

class EndQuestion {
 public:
  static constexpr const char* kText = "End? Esc again or Enter ends, any other key goes on";

  enum class Answer { not_concerned, taken, end };
  /// `taken`: the key belongs to the question and means nothing else. Key repeats neither ask nor answer.
  Answer take(const render::KeyPressed& key);
  bool isOpen() const { return open_; }

 private:
  bool open_ = false;
};

}  // namespace app
