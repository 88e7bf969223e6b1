// Ends in the way named by its first argument while a device pushes, and writes the device's commands to the file of
// its second argument: two doubles each, force in N and motors on (1) or off (0). For emergency_exit_test.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>

#include "app/device/emergency_exit.h"
#include "haptics/device/paced_device.h"

namespace {

using namespace std::chrono_literals;

std::atomic<bool> crashing{false};

class WrittenDevice final : public haptics::PacedDevice {
 public:
  explicit WrittenDevice(double* told) : told_(told) {
    capabilities_.has_motors = true;
    capabilities_.min_rate_Hz = 500.0;
  }
  ~WrittenDevice() override { stop(); }
  const haptics::DeviceCapabilities& capabilities() const override { return capabilities_; }
  haptics::HandleState sense(double) noexcept override { return {}; }
  void drive(const haptics::MotorCommand& command) noexcept override { write(command); }
  void motorsOff() noexcept override {
    PacedDevice::motorsOff();
    write({});
  }

 private:
  void write(const haptics::MotorCommand& command) {
    told_[0] = glm::length(command.wrench_D().force_N.xyz);
    told_[1] = command.motorsOn() ? 1.0 : 0.0;
  }
  double* told_;
  haptics::DeviceCapabilities capabilities_;
};

class Pusher final : public haptics::DeviceLoop {
 public:
  Pusher(haptics::HapticDevice& device, std::string end)
      : DeviceLoop(device, 1000.0, std::nullopt), end_(std::move(end)) {}
  ~Pusher() override { stop(); }

 private:
  Answer answer(const haptics::HandleState&, const haptics::TickTiming&) noexcept override {
    if (ticks() == 100 && end_ == "segv-in-tick") std::raise(SIGSEGV);
    if (ticks() == 100 && end_ == "hang-in-tick") std::this_thread::sleep_for(30s);
    if (crashing.load()) std::this_thread::sleep_for(20ms);
    return {{{{1.0, 0.0, 0.0}}, {}}};
  }
  std::string end_;
};

/// One thread crashes while another that has crashed still waits for the motors, which tick slowly.
void crashTwice(const haptics::DeviceLoop& loop) {
  std::thread second([&] {
    while (!loop.isForceDisabled()) {
    }
    std::raise(SIGSEGV);
  });
  crashing.store(true);
  std::raise(SIGSEGV);
  second.join();
}

void exitWith7(int) { std::_Exit(7); }

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string end = argv[1];
  const int file = open(argv[2], O_RDWR | O_CREAT, 0600);
  if (file < 0 || ftruncate(file, 2 * sizeof(double)) != 0) return 2;
  auto* told = static_cast<double*>(mmap(nullptr, 2 * sizeof(double), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  if (told == MAP_FAILED) return 2;

  // On the stack: what exit() does not destroy.
  WrittenDevice device(told);
  Pusher loop(device, end);
  loop.start();
  if (end == "handler-of-before" || end == "handler-comes-back") std::signal(SIGUSR1, exitWith7);
  if (end == "ignored") std::signal(SIGUSR1, SIG_IGN);
  if (end == "handler-comes-back") {
    const app::EmergencyExit emergency(loop);
  }
  if (end == "handler-comes-back") std::raise(SIGUSR1);
  // However busy the machine is.
  app::EmergencyExit emergency(loop, 60s);
  while (loop.ticks() < 50) std::this_thread::sleep_for(1ms);
  if (end == "two-crashes") crashTwice(loop);
  if (end == "handler-of-before" || end == "ignored") std::raise(SIGUSR1);
  if (end == "ignored") std::_Exit(8);
  if (end == "abort") std::abort();
  if (end == "segv") std::raise(SIGSEGV);
  if (end == "user-signal") std::raise(SIGUSR1);
  if (end == "alarm") std::raise(SIGALRM);
  if (end == "cpu-limit") std::raise(SIGXCPU);
  if (end == "exit") std::exit(3);
  if (end == "throw") throw std::runtime_error("nobody catches this");
  if (end == "kill-without-guard") std::raise(SIGKILL);
  if (end == "hang-in-tick")
    while (loop.watchdogTrips() == 0) std::this_thread::sleep_for(1ms);
  else
    std::this_thread::sleep_for(60s);
  std::_Exit(4);
}
