#include "calibration/opencv_module.h"

#include <dlfcn.h>

namespace calibration {
namespace {

const OpenCvModule* opened() {
  // Found by the program's own search path: beside what was built, or lib/molar of what was installed. Never closed.
  void* library = dlopen("molar_pictures.so", RTLD_NOW | RTLD_LOCAL);
  void* found = library != nullptr ? dlsym(library, "molarOpenCvModule") : nullptr;
  if (found == nullptr) {
    const char* why = dlerror();
    throw CalibrationError("molar_pictures.so, cameras and picture files: it cannot be loaded (" +
                           std::string(why != nullptr ? why : "no reason given") + "), install Molar again");
  }
  return reinterpret_cast<const OpenCvModule* (*)()>(found)();
}

}  // namespace

const OpenCvModule& openCvModule() {
  static const OpenCvModule* const kModule = opened();
  return *kModule;
}

}  // namespace calibration
