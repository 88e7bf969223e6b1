#include "app/commands/outside_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "app/commands/stop_signals.h"

extern char** environ;

namespace app {
namespace {

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

OutsideEnd runToEnd(const OutsideProgram& program) {
  constexpr const char* kNothing = "/dev/null";
  std::vector<std::string> words = program.words, environment = program.environment;
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, kNothing, O_RDONLY, 0);
  if (program.is_silent) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      ::posix_spawn_file_actions_addopen(&files, stream, kNothing, O_WRONLY, 0);
  } else {
    ::posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  }
  // A group of its own, so that what it starts ends with it.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  const StopSignals signals;
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, words.front().c_str(), &files, &attributes, pointersTo(words).data(),
                                   environment.empty() ? environ : pointersTo(environment).data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) return {OutsideEnd::Kind::not_started, error};

  const auto end = std::chrono::steady_clock::now() + program.limit;
  int status = 0;
  for (pid_t ended = 0; (ended = ::waitpid(process, &status, WNOHANG)) != process;) {
    if (ended < 0 && errno != EINTR) return {OutsideEnd::Kind::unknown, errno};
    const bool is_late = std::chrono::steady_clock::now() > end;
    if (is_late || signals.isAsked()) {
      ::kill(-process, SIGKILL);
      ::waitpid(process, &status, 0);
      return {is_late ? OutsideEnd::Kind::late : OutsideEnd::Kind::stopped, 0};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return {OutsideEnd::Kind::ended, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
}

}  // namespace app
