#include "app/sound/silence_libraries.h"

#include <dlfcn.h>

#include <initializer_list>

namespace app {
namespace {

void dropReport(const char*, int, const char*, int, const char*, ...) {}
void dropLine(const char*) {}

}  // namespace

void silenceSoundLibraries() {
  using Report = void (*)(const char*, int, const char*, int, const char*, ...);
  using Line = void (*)(const char*);
  if (void* const set = dlsym(RTLD_DEFAULT, "snd_lib_error_set_handler"))
    reinterpret_cast<int (*)(Report)>(set)(dropReport);
  for (const char* name : {"jack_set_error_function", "jack_set_info_function"})
    if (void* const set = dlsym(RTLD_DEFAULT, name)) reinterpret_cast<void (*)(Line)>(set)(dropLine);
}

}  // namespace app
