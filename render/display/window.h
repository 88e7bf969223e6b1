// A window with an OpenGL 4.5 core context, and what the user does in it as plain values. GLFW inside.
// The context is current on the constructing thread from construction to destruction. Main thread only; one at a time.
// Positions in px of the framebuffer from its top left. Not for quad-buffered stereo.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace render {

/// Printable keys are their upper-case ASCII letter; the rest are named here.
enum class Key : int {
  unknown = -1,
  space = 32,
  escape = 256,
  enter,
  tab,
  backspace,
  insert,
  erase,
  right,
  left,
  down,
  up,
  page_up,
  page_down,
  home,
  end,
  left_shift = 340,
  left_control,
  left_alt,
};
constexpr Key keyOf(char upper_case) { return static_cast<Key>(upper_case); }

enum class MouseButton { none, left, right, middle };

/// The pointer moved; `button` is the one held down, for dragging.
struct PointerMoved {
  glm::dvec2 to_px{0.0}, by_px{0.0};
  MouseButton button = MouseButton::none;
};
/// Notches away from the user.
struct WheelTurned {
  double notches = 0.0;
};
struct KeyPressed {
  Key key = Key::unknown;
  bool down = false;
  bool repeated = false;
  bool shift = false;
};
struct CloseAsked {};

using WindowEvent = std::variant<PointerMoved, WheelTurned, KeyPressed, CloseAsked>;

class Window {
 public:
  struct Options {
    std::string title = "Molar";
    glm::ivec2 size_px{1280, 800};
    bool full_screen = false;
    bool wait_for_refresh = true;  ///< vsync
    bool visible = true;
    bool debugging = false;  ///< KHR_debug context
  };

  /// Throws GpuError without display or without OpenGL 4.5.
  explicit Window(const Options& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// What happened since the last call, in order.
  std::vector<WindowEvent> takeEvents();
  /// Shows what was drawn into the window's framebuffer.
  void present();
  void setTitle(const std::string& title);
  glm::ivec2 framebufferSize_px() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
