#include "app/controls/end_question.h"

namespace app {
namespace {

/// Pressed on the way to another key.
bool isModifier(render::Key key) {
  const int code = static_cast<int>(key);
  return code >= static_cast<int>(render::Key::left_shift);
}

}  // namespace

EndQuestion::Answer EndQuestion::take(const render::KeyPressed& key) {
  const bool escape = key.key == render::Key::escape;
  if (!open_) {
    if (!escape) return Answer::not_concerned;
    open_ = key.down && !key.repeated;
    return Answer::taken;
  }
  // A pedal held before the question may be released during it.
  if (!key.down) return escape ? Answer::taken : Answer::not_concerned;
  if (key.repeated || isModifier(key.key)) return Answer::taken;
  open_ = false;
  return escape || key.key == render::Key::enter ? Answer::end : Answer::taken;
}

}  // namespace app
