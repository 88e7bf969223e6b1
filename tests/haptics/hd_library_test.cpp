#include "haptics/device/openhaptics/hd_library.h"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <link.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "haptics/device/haptic_device.h"
#include "haptics/device/openhaptics/find_open_haptics.h"
#include "tests/haptics/stand_in_hd/stand_in_hd.h"

namespace haptics {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kFolder = STAND_IN_FOLDER;
const std::string kWhole = kFolder + "/whole/libHD.so.3.5";

/// A folder of the test's own, gone with it; the environment as it was.
class Surroundings {
 public:
  Surroundings() {
    std::string pattern = (fs::temp_directory_path() / "molar_hd_").string() + std::string(6, 'X');
    folder_ = mkdtemp(pattern.data());
    set("GTDD_HOME", folder_.string());
    for (const char* name : {"MOLAR_OPENHAPTICS", "OH_SDK_BASE"}) unsetenv(name);
  }
  ~Surroundings() {
    fs::remove_all(folder_);
    for (const char* name : {"GTDD_HOME", "MOLAR_OPENHAPTICS", "OH_SDK_BASE"}) unsetenv(name);
  }
  void set(const char* name, const std::string& value) { setenv(name, value.c_str(), 1); }
  const fs::path& folder() const { return folder_; }
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }

 private:
  fs::path folder_;
};

int copiesLoaded() {
  int copies = 0;
  const auto count = [](dl_phdr_info* object, std::size_t, void* into) {
    if (fs::path(object->dlpi_name).filename().string().starts_with("libHD.so")) ++*static_cast<int*>(into);
    return 0;
  };
  dl_iterate_phdr(count, &copies);
  return copies;
}

// Those that load nothing, or something broken, come first: what is loaded stays for the process.

TEST(HdLibrary, ReportsWhatToInstallWhenThereIsNone) {
  Surroundings none;
  EXPECT_THAT(HdLibrary::whyUnavailable(), HasSubstr("libHD.so is not installed: install OpenHaptics"));
  EXPECT_THAT(HdLibrary::whyUnavailable("/nowhere/libHD.so"), HasSubstr("/nowhere/libHD.so: there is no such library"));
  none.set("MOLAR_OPENHAPTICS", "/elsewhere");
  EXPECT_THAT(HdLibrary::whyUnavailable(), HasSubstr("/elsewhere: there is no such library"));
}

TEST(HdLibrary, NamesEveryFunctionThatIsMissing) {
  Surroundings none;
  const std::string why = HdLibrary::whyUnavailable(kFolder + "/lacking_functions/lacking_functions.so");
  EXPECT_THAT(why, HasSubstr("lacks hdEndFrame, hdGetError:"));
}

TEST(HdLibrary, NamesAMissingDependency) {
  Surroundings none;
  const std::string why = HdLibrary::whyUnavailable(kFolder + "/lacking_part/lacking_part.so");
  EXPECT_THAT(why, HasSubstr("lacking_part.so needs libStandInPart.so.5, which is not there"));
}

TEST(HdLibrary, DistinguishesABrokenFileFromAMissingOne) {
  Surroundings place;
  place.write("libHD.so.3.4", "this is no library");
  EXPECT_THAT(HdLibrary::whyUnavailable(place.folder().string()), HasSubstr("cannot be loaded, the linker says \""));
  EXPECT_EQ(HdLibrary::whyUnavailable(place.folder().string()).find('\n'), std::string::npos);
}

TEST(HdLibrary, KnowsThePackageOfEachPart) {
  const auto words = [](const std::string& part) {
    return loadFailureText("libHD.so.3.5", part + ": cannot open shared object file: No such file or directory");
  };
  EXPECT_EQ(words("libncurses.so.5"),
            "OpenHaptics, libHD.so.3.5 needs libncurses.so.5, which is not there: apt install libncurses5 libtinfo5");
  EXPECT_THAT(words("libPhantomIOLib42.so"), HasSubstr("install the Touch device driver from 3D Systems"));
  EXPECT_THAT(words("libPHANToMIO.so.4"), HasSubstr("install the PHANTOM Device Drivers"));
  EXPECT_THAT(words("libraw1394.so.8"), HasSubstr("apt install libraw1394-11"));
  EXPECT_THAT(loadFailureText("libHD.so", "libHD.so: wrong ELF class: ELFCLASS32"), HasSubstr("64-bit"));
}

TEST(FindOpenHaptics, ReadsTheConfigurationsAndReportsWhyTheyCannotBeOpened) {
  Surroundings home;
  EXPECT_TRUE(findOpenHaptics("/nowhere/libHD.so").empty());
  home.write("config/Default Device.config", "[Device]\n Channel = 3 \nSerial=1\n");
  home.write("config/Left.config", "Channel=notanumber\nChannel=123456789012345678901234567890\n");
  home.write("config/notes.txt", "Channel=4\n");
  const auto found = findOpenHaptics("/nowhere/libHD.so");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "Phantom or Touch \"Default Device\"");
  EXPECT_THAT(found[0].location, HasSubstr("Default Device.config, channel 3"));
  EXPECT_THAT(found[1].location, testing::EndsWith("Left.config"));
  for (const FoundDevice& device : found) {
    EXPECT_EQ(device.address, "");
    EXPECT_EQ(device.provenance, Provenance::vendor_library);
    EXPECT_THAT(device.advice, HasSubstr("there is no such library"));
  }
}

TEST(FindOpenHaptics, SearchesHomeByDefault) {
  Surroundings home;
  unsetenv("GTDD_HOME");
  const std::string before = std::getenv("HOME") ? std::getenv("HOME") : "";
  setenv("HOME", home.folder().c_str(), 1);
  home.write(".3dsystems/config/Right.config", "");
  const auto found = findOpenHaptics("/nowhere/libHD.so");
  setenv("HOME", before.c_str(), 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "Phantom or Touch \"Right\"");
}

TEST(HdLibraryLoaded, IsFoundThroughTheEnvironment) {
  Surroundings place;
  // What is loaded is remembered by this name, so it stays.
  const fs::path sdk = fs::path(kFolder) / "sdk", library = sdk / "lib/lin-x86_64/libHD.so.3.4";
  fs::create_directories(library.parent_path());
  std::error_code is_there_already;
  fs::create_symlink(kWhole, library, is_there_already);
  place.set("OH_SDK_BASE", sdk.string());
  EXPECT_EQ(HdLibrary::whyUnavailable(), "");
  place.set("MOLAR_OPENHAPTICS", kFolder + "/whole");
  EXPECT_EQ(HdLibrary::whyUnavailable(), "");
}

TEST(HdLibraryLoaded, OnceAndForGood) {
  Surroundings place;
  hd::DeviceId (*init)(const char*) = nullptr;
  { init = HdLibrary(kWhole).functions().init_device; }
  const HdLibrary again(kWhole), anywhere;
  EXPECT_EQ(again.functions().init_device, init);
  EXPECT_EQ(anywhere.functions().init_device, init);
  EXPECT_EQ(copiesLoaded(), 1);

  // Another file would be a second driver in one process.
  fs::copy_file(kWhole, place.folder() / "libHD.so.3.0");
  const std::string copy = (place.folder() / "libHD.so.3.0").string();
  EXPECT_THAT(HdLibrary::whyUnavailable(copy), HasSubstr("another copy is loaded already"));
  EXPECT_EQ(copiesLoaded(), 1);
}

TEST(FindOpenHapticsLoaded, StartsNoDevice) {
  Surroundings home;
  auto found = findOpenHaptics(kWhole);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].address, "openhaptics");
  EXPECT_THAT(found[0].advice, HasSubstr("Touch_Setup"));
  home.write("config/Default Device.config", "Channel=0\n");
  home.write("config/Left.config", "Channel=1\n");
  found = findOpenHaptics(kWhole);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].address, "openhaptics");
  EXPECT_EQ(found[1].address, "openhaptics:Left");
  EXPECT_THAT(found[1].driver, HasSubstr("libHD.so.3"));
  EXPECT_EQ(found[1].advice, "");

  void* library = dlopen(kWhole.c_str(), RTLD_NOW | RTLD_NOLOAD);
  ASSERT_NE(library, nullptr);
  const auto door = reinterpret_cast<stand_in::StandIn* (*)()>(dlsym(library, "standIn"))();
  EXPECT_THAT(door->seen.events, testing::IsEmpty());
}

}  // namespace
}  // namespace haptics
