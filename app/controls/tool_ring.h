// The instruments of the tray in a ring around a place on the screen: the hand moves towards one to choose it. Chosen
// by direction alone (app/view/ring_shape), so that the hand need not reach it; near the middle none is. The first
// stands at the top, the others clockwise. Places on the screen as the viewer sees it, from its top left, y downwards;
// all in shares of the screen's height. Pure values; main thread.
#pragma once

#include <cstddef>
#include <optional>

#include <glm/glm.hpp>

namespace app {

/// More names than that do not fit around one place.
inline constexpr std::size_t kMostInRing = 12;

class ToolRing {
 public:
  /// `tools`: 1 to kMostInRing of the tray, of which `in_hand` is in the hand. `at`: of the hand now.
  void open(std::size_t tools, std::size_t in_hand, const glm::dvec2& at);
  bool isOpen() const { return tools_ > 0; }
  std::size_t tools() const { return tools_; }
  std::size_t inHand() const { return in_hand_; }
  /// Where it was opened.
  const glm::dvec2& middle() const { return middle_; }

  /// The hand is there now.
  void moveTo(const glm::dvec2& at);
  /// None: in the middle.
  std::optional<std::size_t> chosen() const { return chosen_; }
  /// Closes it; what was chosen, if it is not in the hand already.
  std::optional<std::size_t> take();
  void cancel() { tools_ = 0, chosen_.reset(); }

 private:
  std::size_t tools_ = 0, in_hand_ = 0;
  glm::dvec2 middle_{0.0};
  std::optional<std::size_t> chosen_;
};

}  // namespace app
