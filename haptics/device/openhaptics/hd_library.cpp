#include "haptics/device/openhaptics/hd_library.h"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

namespace fs = std::filesystem;

/// One scheduler in a process, whatever the number of objects.
std::atomic<bool> scheduler_is_taken{false};

constexpr std::array<const char*, 4> kNames{"libHD.so.3.5", "libHD.so.3.4", "libHD.so.3.0", "libHD.so"};

std::string fromEnvironment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

void addNamesIn(const fs::path& folder, std::vector<std::string>& files) {
  for (const char* name : kNames) files.push_back((folder / name).string());
}

/// The file or folder that the user chose; empty: none.
std::string chosenPath(const std::string& path) { return path.empty() ? fromEnvironment("MOLAR_OPENHAPTICS") : path; }

std::vector<std::string> candidates(const std::string& chosen) {
  std::vector<std::string> files;
  std::error_code ignored;
  if (!chosen.empty() && fs::is_directory(chosen, ignored)) {
    addNamesIn(chosen, files);
  } else if (!chosen.empty()) {
    files.push_back(fs::absolute(chosen).string());
  } else {
    files.assign(kNames.begin(), kNames.end());
    const std::string base = fromEnvironment("OH_SDK_BASE");
    if (!base.empty()) addNamesIn(fs::path(base) / "lib/lin-x86_64", files);
  }
  return files;
}

/// The copy that this process has loaded already.
std::string loadedAlready() {
  std::string found;
  const auto visit = [](dl_phdr_info* object, std::size_t, void* into) {
    const std::string name = object->dlpi_name ? object->dlpi_name : "";
    if (fs::path(name).filename().string().starts_with("libHD.so")) *static_cast<std::string*>(into) = name;
    return 0;
  };
  dl_iterate_phdr(visit, &found);
  return found;
}

struct Opened {
  void* library = nullptr;
  std::string path;
  std::string why_not;
};

std::string fileOf(void* library, const std::string& asked) {
  link_map* map = nullptr;
  const bool known = dlinfo(library, RTLD_DI_LINKMAP, &map) == 0 && map && map->l_name && *map->l_name;
  return known ? map->l_name : asked;
}

Opened openFirstOf(const std::vector<std::string>& files) {
  Opened opened;
  for (const std::string& file : files) {
    // Never closed: the driver fails when it is loaded twice.
    opened.library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (opened.library) {
      opened.path = fileOf(opened.library, file);
      return opened;
    }
    const char* text = dlerror();
    const std::string said = text ? text : "";
    const bool absent = said.starts_with(file + ": cannot open shared object file: No such file");
    if (!absent && opened.why_not.empty()) opened.why_not = loadFailureText(file, said);
  }
  return opened;
}

std::string absenceText(const std::string& chosen) {
  if (chosen.empty())
    return "OpenHaptics, libHD.so is not installed: install OpenHaptics for Linux and the device driver from 3D "
           "Systems, or name the file in MOLAR_OPENHAPTICS";
  return "OpenHaptics, " + chosen + ": there is no such library, correct the path or unset MOLAR_OPENHAPTICS";
}

Opened openLibrary(const std::string& path) {
  const std::string chosen = chosenPath(path);
  const std::vector<std::string> files = candidates(chosen);
  const std::string loaded = loadedAlready();
  std::error_code ignored;
  const auto is_there = [&](const std::string& file) { return fs::exists(file, ignored); };
  const auto is_loaded = [&](const std::string& file) { return fs::equivalent(file, loaded, ignored); };
  if (!loaded.empty() && (chosen.empty() || std::ranges::any_of(files, is_loaded))) return openFirstOf({loaded});
  if (!loaded.empty() && std::ranges::any_of(files, is_there))
    return {nullptr, "",
            "OpenHaptics, " + chosen + ": another copy is loaded already, " + loaded +
                ", and its driver allows one; start the program again with the one you want"};
  Opened opened = openFirstOf(files);
  if (!opened.library && opened.why_not.empty()) opened.why_not = absenceText(chosen);
  return opened;
}

/// All functions, or the names of those that are not there.
std::optional<std::string> resolve(void* library, HdFunctions& f) {
  std::string missing;
  const auto find = [&](auto& function, const char* name) {
    void* symbol = dlsym(library, name);
    if (!symbol) missing += missing.empty() ? name : std::string(", ") + name;
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(symbol);
  };
  find(f.init_device, "hdInitDevice");
  find(f.disable_device, "hdDisableDevice");
  find(f.make_current_device, "hdMakeCurrentDevice");
  find(f.begin_frame, "hdBeginFrame");
  find(f.end_frame, "hdEndFrame");
  find(f.enable, "hdEnable");
  find(f.disable, "hdDisable");
  find(f.get_booleanv, "hdGetBooleanv");
  find(f.get_integerv, "hdGetIntegerv");
  find(f.get_doublev, "hdGetDoublev");
  find(f.get_string, "hdGetString");
  find(f.set_doublev, "hdSetDoublev");
  find(f.get_error, "hdGetError");
  find(f.check_calibration, "hdCheckCalibration");
  find(f.update_calibration, "hdUpdateCalibration");
  find(f.set_scheduler_rate, "hdSetSchedulerRate");
  find(f.start_scheduler, "hdStartScheduler");
  find(f.stop_scheduler, "hdStopScheduler");
  find(f.schedule_asynchronous, "hdScheduleAsynchronous");
  find(f.unschedule, "hdUnschedule");
  if (missing.empty()) return std::nullopt;
  return missing;
}

std::string nextStepFor(const std::string& part) {
  if (part == "libncurses.so.5" || part == "libtinfo.so.5") return "apt install libncurses5 libtinfo5";
  if (part.starts_with("libPhantomIOLib")) return "install the Touch device driver from 3D Systems and run ldconfig";
  if (part.starts_with("libPHANToMIO")) return "install the PHANTOM Device Drivers from 3D Systems and run ldconfig";
  if (part.starts_with("libraw1394")) return "apt install libraw1394-11 and link its library to the name " + part;
  return "install it where the system's linker looks";
}

}  // namespace

std::string loadFailureText(const std::string& file, const std::string& linker_text) {
  const std::string name = linker_text.substr(0, linker_text.find(": "));
  const bool is_part = linker_text.find(": cannot open shared object file") != std::string::npos && name != file;
  if (is_part) return "OpenHaptics, " + file + " needs " + name + ", which is not there: " + nextStepFor(name);
  return "OpenHaptics, " + file + " cannot be loaded, the linker says \"" + linker_text +
         "\": install OpenHaptics 3.4 or newer for 64-bit Linux";
}

HdLibrary::HdLibrary(const std::string& path) {
  const Opened opened = openLibrary(path);
  if (!opened.library) throw DeviceError(opened.why_not, DeviceTrouble::no_driver);
  path_ = opened.path;
  if (const auto missing = resolve(opened.library, functions_))
    throw DeviceError("OpenHaptics, " + path_ + " lacks " + *missing + ": install OpenHaptics 3.0 or newer",
                      DeviceTrouble::no_driver);
}

bool HdLibrary::claimScheduler() { return !scheduler_is_taken.exchange(true); }

void HdLibrary::releaseScheduler() { scheduler_is_taken.store(false); }

std::string HdLibrary::whyUnavailable(const std::string& path) {
  try {
    const HdLibrary library(path);
    return {};
  } catch (const DeviceError& error) {
    return error.what();
  }
}

}  // namespace haptics
