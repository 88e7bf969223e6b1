// A machine laid out in a temporary folder, with /proc, /sys, /dev and /etc. For tests.
#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "app/doctor/machine.h"

namespace app {

class PaperMachine {
 public:
  explicit PaperMachine(const std::string& name)
      : root_(std::filesystem::path(testing::TempDir()) / ("molar_machine_" + name)) {
    std::filesystem::remove_all(root_);
    for (const char* folder : {"proc", "sys", "dev", "etc", "run", "home", "sessions"})
      std::filesystem::create_directories(root_ / folder);
  }
  ~PaperMachine() { std::filesystem::remove_all(root_); }
  PaperMachine(const PaperMachine&) = delete;
  PaperMachine& operator=(const PaperMachine&) = delete;

  /// "sys/kernel/realtime", "1".
  void write(const std::string& path, const std::string& text) {
    std::filesystem::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text << "\n";
  }
  void close(const std::string& path) { closed_.insert(root_ / path); }

  /// A unit at USB port `port` of bus 1, with the node the bus has for it.
  void plugIn(const std::string& port, const std::string& vendor, const std::string& product, int device) {
    const std::string at = "sys/bus/usb/devices/" + port + "/";
    write(at + "idVendor", vendor);
    write(at + "idProduct", product);
    write(at + "busnum", "1");
    write(at + "devnum", std::to_string(device));
    write(nodeOf(device), "");
  }
  static std::string nodeOf(int device) {
    const std::string number = std::to_string(device);
    return "dev/bus/usb/001/" + std::string(3 - number.size(), '0') + number;
  }
  void giveInterface(const std::string& port, const std::string& inside, const std::string& node) {
    write("sys/bus/usb/devices/" + port + ":1.0/" + inside + "/" + node + "/dev", "1:1");
    write("dev/" + node, "");
  }

  Machine machine() const {
    Machine machine;
    machine.proc = root_ / "proc";
    machine.sys = root_ / "sys";
    machine.dev = root_ / "dev";
    machine.etc = root_ / "etc";
    machine.runtime = root_ / "run";
    machine.home = root_ / "home";
    machine.sessions = root_ / "sessions";
    machine.user = "eva";
    machine.may_use = [closed = closed_](const std::filesystem::path& node) { return !closed.contains(node); };
    return machine;
  }
  std::filesystem::path at(const std::string& path) const { return root_ / path; }

 private:
  std::filesystem::path root_;
  std::set<std::filesystem::path> closed_;
};

}  // namespace app
