#include "app/doctor/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/doctor/paper_machine.h"

namespace app {
namespace {

using testing::HasSubstr;

TEST(DoctorGraphics, NeedsOpenGLAndWarnsOfAProgramThatDraws) {
  EXPECT_EQ(checkGraphics({}).health, Health::missing);
  EXPECT_EQ(checkGraphics(GraphicsFacts{"4.5", "NVIDIA H200", false}).health, Health::ok);
  const Finding slow = checkGraphics(GraphicsFacts{"4.5", "llvmpipe", true});
  EXPECT_EQ(slow.health, Health::warn);
  EXPECT_THAT(slow.sentence, HasSubstr("llvmpipe"));
}

TEST(DoctorScreens, NeedADisplayAndListWhatIsThere) {
  EXPECT_EQ(checkScreens({}).health, Health::missing);
  EXPECT_EQ(checkStereo({}).health, Health::not_needed);
  const ScreenFacts two{{{"DP-1", 1920, 1080, 120.0}, {"DP-2", 1920, 1080, 60.0}}, true};
  EXPECT_EQ(checkScreens(two).health, Health::ok);
  EXPECT_EQ(checkScreens(two).sentence, "DP-1 1920 × 1080 px at 120 Hz, DP-2 1920 × 1080 px at 60 Hz.");
  EXPECT_THAT(checkStereo(two).sentence, HasSubstr("two windows"));
  EXPECT_THAT(checkStereo(two).sentence, testing::StartsWith("Quad-buffered"));
  const ScreenFacts slow{{{"HDMI-1", 3840, 2160, 30.0}}, false};
  EXPECT_EQ(checkScreens(slow).health, Health::warn);
  EXPECT_THAT(checkStereo(slow).sentence, HasSubstr("No quad-buffered"));
}

TEST(DoctorSound, ReadsCardsAndSockets) {
  PaperMachine paper("sound");
  EXPECT_EQ(checkSound(paper.machine()).health, Health::warn);
  paper.write("proc/asound/cards", "--- no soundcards ---");
  EXPECT_EQ(checkSound(paper.machine()).health, Health::warn);
  paper.write("proc/asound/cards", " 0 [PCH            ]: HDA-Intel - HDA Intel PCH\n                      at 0xf7");
  EXPECT_EQ(checkSound(paper.machine()).health, Health::ok);
  EXPECT_THAT(checkSound(paper.machine()).sentence, HasSubstr("without a sound server"));
  paper.write("run/pulse/native", "");
  EXPECT_EQ(checkSound(paper.machine()).sentence, "HDA-Intel - HDA Intel PCH, by PulseAudio.");
  paper.write("run/pipewire-0", "");
  EXPECT_THAT(checkSound(paper.machine()).sentence, HasSubstr("PipeWire"));
}

TEST(DoctorPedal, NamesThePedalAndWhetherItMayBeRead) {
  PaperMachine paper("pedal");
  EXPECT_EQ(checkPedal(paper.machine()).health, Health::not_needed);
  paper.write("sys/class/input/event3/device/name", "VEC Footpedal");
  paper.write("sys/class/input/event3/device/capabilities/key", "7 0 0 0 0");
  EXPECT_EQ(checkPedal(paper.machine()).health, Health::ok);
  EXPECT_THAT(checkPedal(paper.machine()).sentence, HasSubstr("VEC Footpedal"));
  paper.close("dev/input/event3");
  EXPECT_EQ(checkPedal(paper.machine()).health, Health::warn);
}

TEST(DoctorPermissions, FindEveryNodeOfEveryUnit) {
  PaperMachine paper("permissions");
  paper.plugIn("1-1", "046d", "c077", 3);
  EXPECT_EQ(checkPermissions(paper.machine()).health, Health::not_needed) << "a mouse is no haptic device";
  paper.plugIn("1-2", "2988", "0302", 4);
  paper.giveInterface("1-2", "tty", "ttyACM0");
  paper.plugIn("1-3", "1234", "0006", 5);
  paper.giveInterface("1-3", "0003:1234:0006.0001/hidraw", "hidraw2");
  EXPECT_EQ(checkPermissions(paper.machine()).health, Health::ok);
  for (const std::string node : {"dev/bus/usb/001/004", "dev/bus/usb/001/005", "dev/ttyACM0", "dev/hidraw2"}) {
    PaperMachine closed("permissions_closed");
    closed.plugIn("1-2", "2988", "0302", 4);
    closed.giveInterface("1-2", "tty", "ttyACM0");
    closed.plugIn("1-3", "1234", "0006", 5);
    closed.giveInterface("1-3", "0003:1234:0006.0001/hidraw", "hidraw2");
    closed.close(node);
    const Finding finding = checkPermissions(closed.machine());
    EXPECT_EQ(finding.health, Health::missing) << node;
    EXPECT_THAT(finding.sentence, HasSubstr(closed.at(node).string()));
    EXPECT_THAT(finding.next_step, HasSubstr("--udev-rules"));
  }
}

TEST(DoctorModemManager, IsMissingForSerialUnitsWithoutAUdevRule) {
  PaperMachine paper("modem");
  paper.write("proc/812/comm", "ModemManagerX");
  paper.write("proc/driver/comm", "ModemManager");
  EXPECT_EQ(checkModemManager(paper.machine()).health, Health::ok);
  paper.write("proc/813/comm", "ModemManager");
  EXPECT_EQ(checkModemManager(paper.machine()).health, Health::warn);
  paper.plugIn("1-2", "0301", "2988", 4);
  EXPECT_EQ(checkModemManager(paper.machine()).health, Health::warn) << "no serial port";
  paper.giveInterface("1-2", "tty", "ttyACM0");
  EXPECT_EQ(checkModemManager(paper.machine()).health, Health::missing);
  paper.write("etc/udev/rules.d/70-molar.rules", "# 2988 ID_MM_DEVICE_IGNORE");
  EXPECT_EQ(checkModemManager(paper.machine()).health, Health::missing) << "a comment is no rule";
  paper.write("etc/udev/rules.d/70-molar.rules", R"(ATTRS{idVendor}=="2988", ENV{ID_MM_DEVICE_IGNORE}="1")");
  EXPECT_EQ(checkModemManager(paper.machine()).health, Health::ok);
}

TEST(DoctorOpenHaptics, IsNeededByOwnersOfAPhantomAlone) {
  PaperMachine paper("vendor");
  EXPECT_EQ(checkVendorLibrary(paper.machine(), "").health, Health::ok);
  EXPECT_EQ(checkVendorLibrary(paper.machine(), "libHD.so is not there").health, Health::not_needed);
  paper.plugIn("1-1", "0403", "cb48", 3);
  EXPECT_EQ(checkVendorLibrary(paper.machine(), "libHD.so is not there").health, Health::not_needed);
  paper.plugIn("1-2", "2988", "0304", 4);
  const Finding finding = checkVendorLibrary(paper.machine(), "libHD.so is not there");
  EXPECT_EQ(finding.health, Health::missing);
  EXPECT_THAT(finding.sentence, HasSubstr("libHD.so is not there."));
}

TEST(DoctorClock, NeedsHighResolutionAndAFastSource) {
  PaperMachine paper("clock");
  const std::string file = "sys/devices/system/clocksource/clocksource0/current_clocksource";
  EXPECT_EQ(checkClock(paper.machine(), 1.0).health, Health::ok);
  paper.write(file, "tsc");
  EXPECT_EQ(checkClock(paper.machine(), 1.0).sentence, "Time comes from clock tsc, in steps of 1 ns.");
  EXPECT_EQ(checkClock(paper.machine(), 4e6).health, Health::missing);
  paper.write(file, "hpet");
  EXPECT_EQ(checkClock(paper.machine(), 1.0).health, Health::warn);
  EXPECT_GT(clockResolution_ns(), 0.0);
}

TEST(DoctorWakeUps, AreSortedAndEvaluatedAtNinetyNinePerCent) {
  const WakeUps measured = measureWakeUps();
  EXPECT_LE(0.0, measured.median_us);
  EXPECT_LE(measured.median_us, measured.p99_us);
  EXPECT_LE(measured.p99_us, measured.worst_us);
  EXPECT_EQ(checkWakeUps({4.0, 90.0, 3000.0}).health, Health::ok);
  EXPECT_EQ(checkWakeUps({4.0, 900.0, 3000.0}).health, Health::warn);
}

TEST(DoctorLimits, PrintTheLinesForAUserWithoutTheRights) {
  PaperMachine paper("limits");
  const char* limits = "Limit                     Soft Limit           Hard Limit           Units\n";
  paper.write("proc/self/status", "Name:\tmolar\nCapEff:\t0000000000000000");
  paper.write("proc/self/limits", std::string(limits) +
                                      "Max locked memory         8388608              8388608              bytes\n"
                                      "Max realtime priority     0                    99");
  const Finding priority = checkPriorityLimit(paper.machine()), memory = checkMemoryLimit(paper.machine());
  EXPECT_EQ(priority.health, Health::warn);
  EXPECT_THAT(priority.next_step, HasSubstr("eva - rtprio 46\\n"));
  EXPECT_THAT(priority.next_step, HasSubstr("/etc/security/limits.d/"));
  EXPECT_EQ(memory.health, Health::warn);
  EXPECT_THAT(memory.sentence, HasSubstr("Only 8 MB"));
  EXPECT_THAT(memory.next_step, HasSubstr("eva - memlock unlimited"));

  paper.write("proc/self/limits", std::string(limits) +
                                      "Max locked memory         unlimited            unlimited            bytes\n"
                                      "Max realtime priority     95                   95");
  EXPECT_EQ(checkPriorityLimit(paper.machine()).health, Health::ok);
  EXPECT_EQ(checkMemoryLimit(paper.machine()).health, Health::ok);
}

TEST(DoctorLimits, WarnOfAnyFiniteMemlockLimit) {
  PaperMachine paper("finite");
  paper.write("proc/self/limits", "Max locked memory         8589934592           8589934592           bytes\n");
  const Finding memory = checkMemoryLimit(paper.machine());
  EXPECT_EQ(memory.health, Health::warn);
  EXPECT_THAT(memory.sentence, HasSubstr("Only 8192 MB may be kept"));
}

TEST(DoctorLimits, RequireNoMorePriorityThanServoAndUsbThreadTake) {
  PaperMachine paper("priorities");
  paper.write("proc/self/limits", "Max realtime priority     45                   45");
  EXPECT_EQ(checkPriorityLimit(paper.machine()).health, Health::warn);
  paper.write("proc/self/limits", "Max realtime priority     46                   46");
  const Finding enough = checkPriorityLimit(paper.machine());
  EXPECT_EQ(enough.health, Health::ok);
  EXPECT_THAT(enough.sentence, HasSubstr("priority 45, below the interrupts"));
  const Finding of_choice = checkPriorityLimit(paper.machine(), 60);
  EXPECT_EQ(of_choice.health, Health::warn);
  EXPECT_THAT(of_choice.next_step, HasSubstr("eva - rtprio 61\\n"));
  EXPECT_THAT(checkMemoryLimit(paper.machine(), 60).next_step, HasSubstr("eva - rtprio 61\\n"));
}

TEST(DoctorLimits, RequireTheInterruptsAboveTheServo) {
  PaperMachine paper("interrupts");
  paper.write("proc/self/limits", "Max realtime priority     95                   95");
  const auto put = [&](const std::string& process, const std::string& name, int priority) {
    paper.write("proc/" + process + "/comm", name);
    paper.write("proc/" + process + "/stat",
                process + " (" + name +
                    ") S 2 0 0 0 -1 2129984 0 0 0 0 0 0 0 0 -51 0 1 0 158 0 0 18446744073709551615 "
                    "0 0 0 0 0 0 0 2147483647 0 0 0 0 17 1 " +
                    std::to_string(priority) + " 1 0 0 0 0 0 0 0 0 0 0 0");
  };
  put("71", "irq/30-xhci (a b)", 50);
  put("72", "kworker/0:1", 1);
  EXPECT_EQ(checkPriorityLimit(paper.machine()).health, Health::ok);
  const Finding chosen = checkPriorityLimit(paper.machine(), 60);
  EXPECT_EQ(chosen.health, Health::warn);
  EXPECT_THAT(chosen.sentence,
              HasSubstr("irq/30-xhci (a b) has real-time priority 50, the servo that may wait for it 60"));
  EXPECT_THAT(chosen.next_step, HasSubstr("--priority of 48 or less"));
  EXPECT_EQ(checkPriorityLimit(paper.machine(), 48).health, Health::ok);
  put("73", "irq/31-ehci", 20);
  const Finding low = checkPriorityLimit(paper.machine());
  EXPECT_EQ(low.health, Health::warn);
  EXPECT_THAT(low.sentence, HasSubstr("irq/31-ehci has real-time priority 20"));
  EXPECT_THAT(low.next_step, HasSubstr("chrt -f -p 50 73"));
}

TEST(DoctorLimits, AreIgnoredWithTheCapability) {
  PaperMachine paper("capabilities");
  paper.write("proc/self/status", "CapEff:\t0000000000804000");
  EXPECT_EQ(checkPriorityLimit(paper.machine()).health, Health::ok);
  EXPECT_EQ(checkMemoryLimit(paper.machine()).health, Health::ok);
  paper.write("proc/self/status", "CapEff:\tgarbage");
  EXPECT_EQ(checkPriorityLimit(paper.machine()).health, Health::warn);
}

TEST(DoctorProcessors, NeedMoreThanOneCoreAtFullSpeed) {
  PaperMachine paper("processors");
  paper.write("sys/devices/system/cpu/cpu0/online", "1");
  paper.write("sys/devices/system/cpu/cpufreq/policy0", "");
  EXPECT_EQ(checkProcessors(paper.machine()).health, Health::warn) << "one core";
  paper.write("sys/devices/system/cpu/cpu1/online", "1");
  EXPECT_EQ(checkProcessors(paper.machine()).health, Health::ok);
  paper.write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
  paper.write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave");
  EXPECT_EQ(checkProcessors(paper.machine()).health, Health::warn);
  paper.write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance");
  paper.write("sys/devices/system/cpu/isolated", "1");
  paper.write("sys/kernel/realtime", "1");
  EXPECT_EQ(checkProcessors(paper.machine()).sentence, "2 cores, governor performance, isolated: 1, real-time kernel.");
}

TEST(DoctorDisk, MustTakeRecordingsAndHaveRoom) {
  EXPECT_EQ(checkDisk("here", {}).health, Health::missing);
  EXPECT_EQ(checkDisk("here", {100.0, 300.0, true}).health, Health::missing);
  EXPECT_EQ(checkDisk("here", {1500.0, 300.0, true}).health, Health::warn);
  EXPECT_EQ(checkDisk("here", {90'000.0, 2.0, true}).health, Health::warn);
  EXPECT_EQ(checkDisk("here", {90'000.0, 300.0, true}).sentence, "here: 90.0 GB free, written at 300 MB/s.");
  const PaperMachine paper("disk");
  const DiskFacts facts = probeDisk(paper.machine().sessions);
  EXPECT_TRUE(facts.is_writable);
  EXPECT_GT(facts.free_MB, 0.0);
  EXPECT_TRUE(std::filesystem::is_empty(paper.machine().sessions)) << "nothing is left behind";
  EXPECT_FALSE(probeDisk(paper.at("nowhere")).is_writable);
}

TEST(DoctorChecks, SayOneSentenceEachOnAnEmptyMachine) {
  const PaperMachine paper("empty");
  const Machine machine = paper.machine();
  for (const Finding& one : {checkSound(machine), checkPedal(machine), checkPermissions(machine),
                             checkModemManager(machine), checkVendorLibrary(machine, ""), checkClock(machine, 1.0),
                             checkPriorityLimit(machine), checkMemoryLimit(machine), checkProcessors(machine)}) {
    EXPECT_FALSE(one.id.empty());
    EXPECT_TRUE(one.sentence.ends_with(".")) << one.sentence;
    EXPECT_NE(one.health, Health::missing) << one.id << ": what cannot be seen is not missing";
    EXPECT_FALSE(one.health == Health::warn && one.next_step.empty()) << one.id;
  }
}

}  // namespace
}  // namespace app
