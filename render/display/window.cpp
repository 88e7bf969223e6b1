#include "render/display/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <limits>
#include <span>
#include <utility>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

static_assert(static_cast<int>(Key::space) == GLFW_KEY_SPACE && static_cast<int>(Key::escape) == GLFW_KEY_ESCAPE &&
              static_cast<int>(Key::end) == GLFW_KEY_END && static_cast<int>(Key::erase) == GLFW_KEY_DELETE &&
              static_cast<int>(Key::left) == GLFW_KEY_LEFT && static_cast<int>(Key::page_down) == GLFW_KEY_PAGE_DOWN &&
              static_cast<int>(Key::f1) == GLFW_KEY_F1 && static_cast<int>(Key::left_alt) == GLFW_KEY_LEFT_ALT &&
              keyOf('A') == static_cast<Key>(GLFW_KEY_A));

MouseButton buttonOf(int glfw_button) {
  if (glfw_button == GLFW_MOUSE_BUTTON_LEFT) return MouseButton::left;
  if (glfw_button == GLFW_MOUSE_BUTTON_RIGHT) return MouseButton::right;
  return glfw_button == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::middle : MouseButton::none;
}

MouseButton heldButton(GLFWwindow* window) {
  for (const int button : {GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE})
    if (glfwGetMouseButton(window, button) == GLFW_PRESS) return buttonOf(button);
  return MouseButton::none;
}

// Last error message of GLFW, one line.
std::string lastError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

void startLibrary() {
  if (glfwInit() != GLFW_TRUE)
    throw GpuError("no window, display: " + lastError() +
                   "; start a desktop session, or give --headless where a command has it");
}

std::span<GLFWmonitor*> connectedMonitors() {
  int count = 0;
  GLFWmonitor** const all = glfwGetMonitors(&count);
  return {all, static_cast<std::size_t>(count)};
}

// The requested monitor, or the primary one for a full screen; null: the window system chooses.
GLFWmonitor* monitorFor(const Window::Options& options) {
  if (options.monitor) {
    const auto index = static_cast<std::size_t>(*options.monitor);
    return index < connectedMonitors().size() ? connectedMonitors()[index] : nullptr;
  }
  return options.full_screen ? glfwGetPrimaryMonitor() : nullptr;
}

}  // namespace

struct Window::Impl {
  explicit Impl(const Options& options);
  ~Impl();
  void listen();

  static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
  glm::dvec2 framebufferScale() const;
  GLFWmonitor* panel() const;

  GLFWwindow* window = nullptr;
  bool owns_library = true;  ///< the first window, with which the others share
  std::vector<WindowEvent> events;
  glm::dvec2 pointer_px{0.0};
};

Window::Impl::Impl(const Options& options) : owns_library(options.share_with == nullptr) {
  startLibrary();
  // GLFW stays initialised on failure: the caller tries another window.
  const auto refuse = [&](const std::string& what, const std::string& to_do) {
    throw GpuError(what + ", display: " + lastError() + "; " + to_do);
  };
  GLFWmonitor* const monitor = monitorFor(options);
  if (options.monitor && monitor == nullptr)
    refuse("monitor " + std::to_string(*options.monitor + 1) + " is not connected", "connect it or choose another");
  const GLFWvidmode* const desktop = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  glm::ivec2 size = options.size_px;
  if (options.full_screen && desktop != nullptr) size = {desktop->width, desktop->height};

  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUSED, options.focused ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_FOCUS_ON_SHOW, options.focused ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // with two full screens, the one without focus stays
  glfwWindowHint(GLFW_STEREO, options.quad_buffer ? GLFW_TRUE : GLFW_FALSE);
  GLFWwindow* const shared = options.share_with != nullptr ? options.share_with->impl_->window : nullptr;
  window = glfwCreateWindow(size.x, size.y, options.title.c_str(), options.full_screen ? monitor : nullptr, shared);
  if (window == nullptr && options.quad_buffer)
    refuse("no quad-buffered stereo", "it needs GLX and a professional graphics card with stereo enabled");
  if (window == nullptr) {
    // Not every driver supports reset notification.
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);
    window = glfwCreateWindow(size.x, size.y, options.title.c_str(), options.full_screen ? monitor : nullptr, shared);
  }
  if (window == nullptr) refuse("no window with OpenGL 4.5", "update the graphics driver or use --headless");
  if (!options.full_screen && options.monitor) {
    glm::ivec2 corner{0};
    glfwGetMonitorPos(monitor, &corner.x, &corner.y);
    glfwSetWindowPos(window, corner.x, corner.y);
  }
  if (!options.full_screen && options.at_px) glfwSetWindowPos(window, options.at_px->x, options.at_px->y);
  glfwMakeContextCurrent(window);
  glfwSwapInterval(options.wait_for_refresh ? 1 : 0);
  listen();
}

Window::Impl::~Impl() {
  glfwDestroyWindow(window);
  if (owns_library) glfwTerminate();
}

// The monitor that shows most of the window.
GLFWmonitor* Window::Impl::panel() const {
  if (GLFWmonitor* full = glfwGetWindowMonitor(window)) return full;
  glm::ivec2 at{0}, size{0};
  glfwGetWindowPos(window, &at.x, &at.y);
  glfwGetWindowSize(window, &size.x, &size.y);
  GLFWmonitor* best = nullptr;
  int most = std::numeric_limits<int>::min();
  for (GLFWmonitor* monitor : connectedMonitors()) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    if (mode == nullptr) continue;
    glm::ivec2 corner{0};
    glfwGetMonitorPos(monitor, &corner.x, &corner.y);
    const glm::ivec2 shared =
        glm::min(at + size, corner + glm::ivec2(mode->width, mode->height)) - glm::max(at, corner);
    const int area = shared.x > 0 && shared.y > 0 ? shared.x * shared.y : 0;
    if (area > most) most = area, best = monitor;
  }
  return best;
}

glm::dvec2 Window::Impl::framebufferScale() const {
  glm::ivec2 inside{1}, pixels{1};
  glfwGetWindowSize(window, &inside.x, &inside.y);
  glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
  return glm::dvec2(pixels) / glm::dvec2(glm::max(inside, glm::ivec2(1)));
}

// Queues GLFW's callbacks as events.
void Window::Impl::listen() {
  glfwSetWindowUserPointer(window, this);
  glfwGetCursorPos(window, &pointer_px.x, &pointer_px.y);
  pointer_px *= framebufferScale();
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    Impl& self = of(w);
    const glm::dvec2 to_px = glm::dvec2(x, y) * self.framebufferScale();
    self.events.push_back(PointerMoved{to_px, to_px - self.pointer_px, heldButton(w)});
    self.pointer_px = to_px;
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    of(w).events.push_back(ButtonPressed{buttonOf(button), action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window,
                        [](GLFWwindow* w, double, double notches) { of(w).events.push_back(WheelTurned{notches}); });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    of(w).events.push_back(KeyPressed{static_cast<Key>(key), action != GLFW_RELEASE, action == GLFW_REPEAT,
                                      (modifiers & GLFW_MOD_SHIFT) != 0, (modifiers & GLFW_MOD_CONTROL) != 0});
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned letter) {
    of(w).events.push_back(LetterTyped{static_cast<char32_t>(letter)});
  });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { of(w).events.push_back(CloseRequested{}); });
}

Window::Window(const Options& options) : impl_(std::make_unique<Impl>(options)) {}

Window::~Window() = default;

void Window::makeCurrent() { glfwMakeContextCurrent(impl_->window); }

std::vector<WindowEvent> Window::takeEvents() {
  glfwPollEvents();
  return std::exchange(impl_->events, {});
}

void Window::present() { glfwSwapBuffers(impl_->window); }

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(impl_->window, title.c_str()); }

glm::ivec2 Window::framebufferSize_px() const {
  glm::ivec2 px{0};
  glfwGetFramebufferSize(impl_->window, &px.x, &px.y);
  return px;
}

DesktopBox Window::desktopBox() const {
  DesktopBox box;
  glfwGetWindowPos(impl_->window, &box.at_px.x, &box.at_px.y);
  glfwGetWindowSize(impl_->window, &box.size_px.x, &box.size_px.y);
  return box;
}

DesktopBox Window::panelBox() const {
  DesktopBox box;
  GLFWmonitor* const panel = impl_->panel();
  if (panel != nullptr) glfwGetMonitorWorkarea(panel, &box.at_px.x, &box.at_px.y, &box.size_px.x, &box.size_px.y);
  return box;
}

glm::ivec2 Window::positionOnPanel_px() const {
  glm::ivec2 at{0}, corner{0};
  glfwGetWindowPos(impl_->window, &at.x, &at.y);
  if (GLFWmonitor* panel = impl_->panel()) glfwGetMonitorPos(panel, &corner.x, &corner.y);
  return glm::ivec2(glm::round(glm::dvec2(at - corner) * impl_->framebufferScale()));
}

double Window::refresh_Hz() const {
  GLFWmonitor* panel = impl_->panel();
  const GLFWvidmode* mode = panel != nullptr ? glfwGetVideoMode(panel) : nullptr;
  return mode != nullptr && mode->refreshRate > 0 ? mode->refreshRate : 60.0;
}

std::vector<Monitor> monitors() {
  startLibrary();
  std::vector<Monitor> found;
  for (GLFWmonitor* one : connectedMonitors()) {
    Monitor monitor;
    monitor.name = glfwGetMonitorName(one);
    glfwGetMonitorPos(one, &monitor.at_px.x, &monitor.at_px.y);
    if (const GLFWvidmode* mode = glfwGetVideoMode(one)) {
      monitor.px = {mode->width, mode->height};
      if (mode->refreshRate > 0) monitor.refresh_Hz = mode->refreshRate;
    }
    found.push_back(monitor);
  }
  return found;
}

}  // namespace render
