#include "render/gpu/offscreen_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <string>
#include <vector>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

bool contains(const char* extensions, const char* name) {
  return extensions != nullptr && std::string(extensions).find(name) != std::string::npos;
}

// Displays to try: graphics cards, then Mesa's surfaceless platform, software devices, the default display.
std::vector<EGLDisplay> candidateDisplays() {
  std::vector<EGLDisplay> cards, others;
  const char* const client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (contains(client, "EGL_MESA_platform_surfaceless"))
    others.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (contains(client, "EGL_EXT_platform_device") && contains(client, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 8> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count))
      for (EGLint i = 0; i < count; ++i) {
        const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
        const char* const extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
        (contains(extensions, "EGL_MESA_device_software") ? others : cards)
            .push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
      }
  }
  others.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  cards.insert(cards.end(), others.begin(), others.end());
  return cards;
}

// An OpenGL 4.5 core context current without a surface, or EGL_NO_CONTEXT.
EGLContext contextOn(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return EGL_NO_CONTEXT;
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const std::array<EGLint, 5> requested{EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, requested.data(), &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
  const std::array<EGLint, 7> attributes{
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) return EGL_NO_CONTEXT;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return context;
  eglDestroyContext(display, context);
  return EGL_NO_CONTEXT;
}

}  // namespace

OffscreenContext::OffscreenContext() {
  for (const EGLDisplay display : candidateDisplays()) {
    context_ = contextOn(display);
    display_ = display;
    if (context_ != EGL_NO_CONTEXT) break;
  }
  if (context_ == EGL_NO_CONTEXT)
    throw GpuError("no OpenGL 4.5 core context, EGL without display: install libegl-mesa0 and libgl1-mesa-dri");
}

// Terminates the driver's threads here rather than after main, where leak checkers report them.
OffscreenContext::~OffscreenContext() {
  makeCurrent();
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void OffscreenContext::makeCurrent() { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }

}  // namespace render
