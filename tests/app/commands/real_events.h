// A screen of a test's own, a hand on its mouse, and a program beside it: events reach the program through the X server
// as those of a person do. POSIX, Xvfb and XTest; one thread.
#pragma once

#include <chrono>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <glm/glm.hpp>

// Xlib's macros take words that others need.
#undef None
#undef Bool
#undef Status
#undef Success

namespace app {

/// A virtual screen for nobody else: other windows would take pointer and keys.
class PrivateScreen {
 public:
  explicit PrivateScreen(glm::ivec2 px) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    server_ = fork();
    if (server_ == 0) {
      close(ends[0]);
      if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
      const std::string size = std::to_string(px.x) + "x" + std::to_string(px.y) + "x24", end = std::to_string(ends[1]);
      execlp("Xvfb", "Xvfb", "-displayfd", end.c_str(), "-screen", "0", size.c_str(), "-nolisten", "tcp", "-noreset",
             nullptr);
      _exit(127);
    }
    close(ends[1]);
    // The number comes once it can be connected to.
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) name_ += c;
    close(ends[0]);
    if (name_.empty()) throw std::runtime_error("Xvfb does not start: apt-get install xvfb");
    name_ = ":" + name_;
  }
  ~PrivateScreen() {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  PrivateScreen(const PrivateScreen&) = delete;
  PrivateScreen& operator=(const PrivateScreen&) = delete;

  const std::string& name() const { return name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

/// Mouse and keyboard of that screen.
class ScreenHand {
 public:
  enum Button : unsigned { left = 1, middle = 2, right = 3, wheel_up = 4, wheel_down = 5 };

  explicit ScreenHand(const PrivateScreen& screen) : display_(XOpenDisplay(screen.name().c_str())) {
    if (display_ == nullptr) throw std::runtime_error("no connection to " + screen.name());
    // A window may be closed between being listed and being looked at: Xlib would end the test.
    XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
  }
  ~ScreenHand() { XCloseDisplay(display_); }
  ScreenHand(const ScreenHand&) = delete;
  ScreenHand& operator=(const ScreenHand&) = delete;

  void moveTo(glm::ivec2 px) {
    XTestFakeMotionEvent(display_, -1, px.x, px.y, CurrentTime);
    XSync(display_, False);
  }
  void press(Button button, bool down) {
    XTestFakeButtonEvent(display_, button, down ? True : False, CurrentTime);
    XSync(display_, False);
  }
  void click(Button button) { press(button, true), press(button, false); }
  void drag(Button button, glm::ivec2 from_px, glm::ivec2 by_px) {
    moveTo(from_px);
    press(button, true);
    moveTo(from_px + by_px);
    press(button, false);
  }
  /// The window under the mouse gets the keys: nobody manages windows here, and one that closes leaves them to none.
  void takeKeys() {
    XSetInputFocus(display_, PointerRoot, RevertToPointerRoot, CurrentTime);
    XSync(display_, False);
  }
  /// A window of that title.
  bool sees(const std::string& title) {
    Window root = 0, parent = 0, *windows = nullptr;
    unsigned count = 0;
    if (XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &windows, &count) == 0) return false;
    bool is_there = false;
    for (unsigned n = 0; n < count && !is_there; ++n) {
      char* name = nullptr;
      if (XFetchName(display_, windows[n], &name) == 0) continue;
      is_there = title == name;
      XFree(name);
    }
    if (windows != nullptr) XFree(windows);
    return is_there;
  }
  void controlKey(KeySym symbol) {
    const KeyCode control = XKeysymToKeycode(display_, XK_Control_L);
    XTestFakeKeyEvent(display_, control, True, CurrentTime);
    key(symbol);
    XTestFakeKeyEvent(display_, control, False, CurrentTime);
    XSync(display_, False);
  }
  void key(KeySym symbol) {
    const KeyCode code = XKeysymToKeycode(display_, symbol);
    XTestFakeKeyEvent(display_, code, True, CurrentTime);
    XTestFakeKeyEvent(display_, code, False, CurrentTime);
    XSync(display_, False);
  }

 private:
  Display* display_;
};

/// A shell command with its words line by line, as it says them. It never outlives the test: what does not end by
/// itself within the limit is ended, with all that it started.
class RunningProgram {
 public:
  /// `patience`: how long its end is waited for; longer than a busy machine needs.
  explicit RunningProgram(const std::string& command, std::chrono::milliseconds patience = std::chrono::minutes(2))
      : patience_(patience) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) {
      setpgid(0, 0);
      dup2(ends[1], STDOUT_FILENO), dup2(ends[1], STDERR_FILENO);
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    close(ends[1]);
    output_ = ends[0];
    if (child_ < 0) throw std::runtime_error("not started: " + command);
    // Whichever of the two comes first.
    setpgid(child_, child_);
  }
  ~RunningProgram() {
    if (!status_) end(SIGTERM, std::chrono::seconds(5));
    if (!status_) end(SIGKILL, patience_);
    close(output_);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// None: nothing new for so long, or it has ended.
  std::optional<std::string> nextLine(std::chrono::milliseconds within) {
    const auto until = std::chrono::steady_clock::now() + within;
    for (;;) {
      if (const auto end = said_.find('\n'); end != std::string::npos) {
        const std::string line = said_.substr(0, end);
        said_.erase(0, end + 1);
        return line;
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
      pollfd output{output_, POLLIN, 0};
      if (has_ended_ || left.count() <= 0 || poll(&output, 1, static_cast<int>(left.count())) <= 0) return {};
      char text[4096];
      const ssize_t count = read(output_, text, sizeof text);
      has_ended_ = count <= 0;
      if (count > 0) said_.append(text, static_cast<std::size_t>(count));
    }
  }
  bool hasEnded() const { return has_ended_; }
  /// Waits for its end; 128 + SIGKILL: it did not come, and it was ended.
  int exitStatus() {
    wait(patience_);
    if (!status_) end(SIGKILL, patience_);
    if (!status_) return -1;
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128 + WTERMSIG(*status_);
  }

 private:
  /// Its output is read meanwhile, so that it is not held up by that.
  void wait(std::chrono::milliseconds within) {
    const auto until = std::chrono::steady_clock::now() + within;
    while (!status_ && std::chrono::steady_clock::now() < until) {
      int status = 0;
      if (waitpid(child_, &status, WNOHANG) == child_) status_ = status;
      if (!status_ && !has_ended_) nextLine(std::chrono::milliseconds(5));
      if (!status_ && has_ended_) poll(nullptr, 0, 5);
    }
  }
  void end(int signal_number, std::chrono::milliseconds within) {
    kill(-child_, signal_number);
    wait(within);
  }

  std::chrono::milliseconds patience_;
  pid_t child_ = -1;
  int output_ = -1;
  std::optional<int> status_;
  std::string said_;
  bool has_ended_ = false;
};

}  // namespace app
