// A window with an OpenGL 4.5 core context, and its input as plain values. GLFW inside. Main thread only.
// Its context is current on the constructing thread from construction on, or after makeCurrent(). A second window may
// share textures with a first one, which must outlive it; framebuffers are never shared.
// Positions in px of the framebuffer from its top left.
// Quad-buffered stereo is requested from GLX; drivers without it refuse the window (GLFW error 0x10009), which is
// thrown.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace render {

/// Printable keys have the value of their upper-case ASCII letter.
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
  f1 = 290,
  keypad_subtract = 333,
  keypad_add,
  left_shift = 340,
  left_control,
  left_alt,
  right_shift = 344,
};
constexpr Key keyOf(char upper_case) { return static_cast<Key>(upper_case); }

enum class MouseButton { none, left, right, middle };

/// `button` is the one held down, for dragging.
struct PointerMoved {
  glm::dvec2 to_px{0.0}, by_px{0.0};
  MouseButton button = MouseButton::none;
};
struct ButtonPressed {
  MouseButton button = MouseButton::none;
  bool down = false;
};
/// Notches, positive away from the user.
struct WheelTurned {
  double notches = 0.0;
};
struct KeyPressed {
  Key key = Key::unknown;
  bool down = false;
  bool repeated = false;
  bool shift = false, control = false;
};
/// What a key or several of them write.
struct LetterTyped {
  char32_t letter = 0;
};
struct CloseRequested {};

using WindowEvent = std::variant<PointerMoved, ButtonPressed, WheelTurned, KeyPressed, LetterTyped, CloseRequested>;

/// On the desktop, px from its top left.
struct DesktopBox {
  glm::ivec2 at_px{0}, size_px{0};
  friend bool operator==(const DesktopBox&, const DesktopBox&) = default;
};

struct Monitor {
  std::string name;
  glm::ivec2 at_px{0}, px{0};  ///< on the desktop, from its top left
  double refresh_Hz = 60.0;
};

/// In the system's order, the primary one first. Throws GpuError without display.
std::vector<Monitor> monitors();

class Window {
 public:
  struct Options {
    std::string title = "Molar";
    glm::ivec2 size_px{1280, 800};
    bool full_screen = false;
    std::optional<glm::ivec2> at_px = {};  ///< of the desktop; none: the system's choice
    std::optional<int> monitor = {};       ///< index of monitors(); full screen without it: the primary one
    bool wait_for_refresh = true;          ///< vsync
    bool visible = true;
    bool focused = true;                 ///< takes the keyboard focus when it opens
    bool quad_buffer = false;            ///< left and right back buffers
    const Window* share_with = nullptr;  ///< shares textures with it
  };

  /// Throws GpuError without a display, without OpenGL 4.5, without the requested stereo or monitor.
  explicit Window(const Options& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Makes its context current.
  void makeCurrent();
  /// Events since the last call, in order.
  std::vector<WindowEvent> takeEvents();
  /// Swaps buffers. Its context must be current.
  void present();
  void setTitle(const std::string& title);
  glm::ivec2 framebufferSize_px() const;
  /// Where it is on the desktop, without its frame.
  DesktopBox desktopBox() const;
  /// That of the panel that shows most of it.
  DesktopBox panelBox() const;
  /// Top left of the framebuffer on the panel that shows most of it, px from the panel's top left.
  glm::ivec2 positionOnPanel_px() const;
  /// Refresh rate of that panel.
  double refresh_Hz() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
