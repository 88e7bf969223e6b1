#include "render/display/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>
#include <utility>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

static_assert(static_cast<int>(Key::space) == GLFW_KEY_SPACE && static_cast<int>(Key::escape) == GLFW_KEY_ESCAPE &&
              static_cast<int>(Key::end) == GLFW_KEY_END && static_cast<int>(Key::erase) == GLFW_KEY_DELETE &&
              static_cast<int>(Key::left) == GLFW_KEY_LEFT && static_cast<int>(Key::page_down) == GLFW_KEY_PAGE_DOWN &&
              static_cast<int>(Key::left_alt) == GLFW_KEY_LEFT_ALT && keyOf('A') == static_cast<Key>(GLFW_KEY_A));

MouseButton heldButton(GLFWwindow* window) {
  const auto is_held = [window](int button) { return glfwGetMouseButton(window, button) == GLFW_PRESS; };
  if (is_held(GLFW_MOUSE_BUTTON_LEFT)) return MouseButton::left;
  if (is_held(GLFW_MOUSE_BUTTON_RIGHT)) return MouseButton::right;
  if (is_held(GLFW_MOUSE_BUTTON_MIDDLE)) return MouseButton::middle;
  return MouseButton::none;
}

// Last complaint of GLFW, as one line.
std::string complaint() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

}  // namespace

struct Window::Impl {
  explicit Impl(const Options& options);
  ~Impl();
  void listen();

  static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
  glm::dvec2 framebufferScale() const;

  GLFWwindow* window = nullptr;
  std::vector<WindowEvent> events;
  glm::dvec2 pointer_px{0.0};
};

Window::Impl::Impl(const Options& options) {
  if (glfwInit() != GLFW_TRUE)
    throw GpuError("no window, display: " + complaint() + "; start a desktop session or use --headless");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debugging ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  GLFWmonitor* const monitor = options.full_screen ? glfwGetPrimaryMonitor() : nullptr;
  glm::ivec2 size = options.size_px;
  if (monitor != nullptr)
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) size = {mode->width, mode->height};
  window = glfwCreateWindow(size.x, size.y, options.title.c_str(), monitor, nullptr);
  if (window == nullptr) {
    const std::string reason = complaint();
    glfwTerminate();
    throw GpuError("no window with OpenGL 4.5, display: " + reason + "; update the graphics driver or use --headless");
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(options.wait_for_refresh ? 1 : 0);
  listen();
}

Window::Impl::~Impl() {
  glfwDestroyWindow(window);
  glfwTerminate();
}

glm::dvec2 Window::Impl::framebufferScale() const {
  glm::ivec2 inside{1}, pixels{1};
  glfwGetWindowSize(window, &inside.x, &inside.y);
  glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
  return glm::dvec2(pixels) / glm::dvec2(glm::max(inside, glm::ivec2(1)));
}

// GLFW's callbacks become events in the order they come.
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
  glfwSetScrollCallback(window,
                        [](GLFWwindow* w, double, double notches) { of(w).events.push_back(WheelTurned{notches}); });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    of(w).events.push_back(KeyPressed{static_cast<Key>(key), action != GLFW_RELEASE, action == GLFW_REPEAT,
                                      (modifiers & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { of(w).events.push_back(CloseAsked{}); });
}

Window::Window(const Options& options) : impl_(std::make_unique<Impl>(options)) {}

Window::~Window() = default;

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

}  // namespace render
