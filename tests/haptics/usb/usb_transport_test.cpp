#include "haptics/device/usb/usb_transport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "haptics/device/haptic_device.h"
#include "haptics/device/monotonic_clock.h"
#include "tests/haptics/usb/held_clock.h"
#include "tests/haptics/usb/simulated_usb.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;
using simulated_usb::Bus;
using simulated_usb::Bytes;
using simulated_usb::HeldClock;

/// Sends the last bytes it received, a count in front, once per millisecond; keeps everything it received.
class Echo : public simulated_usb::Device {
 public:
  void onOut(std::uint8_t, std::span<const std::uint8_t> bytes, double) override {
    received.emplace_back(bytes.begin(), bytes.end());
  }
  std::optional<Bytes> onIn(std::uint8_t, double t_s) override {
    if (t_s < next_s) return {};
    next_s = hurries ? t_s : t_s + 1e-3;
    Bytes said(report_bytes);
    if (!said.empty()) said[0] = static_cast<std::uint8_t>(++count);
    if (!received.empty() && said.size() > 1) said[1] = received.back().at(0);
    return said;
  }
  std::optional<Bytes> onControl(const simulated_usb::Setup& setup, std::span<const std::uint8_t> data,
                                 double) override {
    if (setup.request == 99) return {};
    if ((setup.type & 0x80) != 0) return Bytes{setup.request, static_cast<std::uint8_t>(setup.value & 0xff)};
    controlled.assign(data.begin(), data.end());
    return Bytes{};
  }
  std::vector<Bytes> received;
  Bytes controlled;
  std::size_t report_bytes = 4;
  int count = 0;
  bool hurries = false;  ///< several reports at a time
  double next_s = 0.0;
};

simulated_usb::Description interruptDevice() {
  simulated_usb::Description d;
  d.vendor = 0x1234;
  d.product = 6;
  d.serial = "FS0001";
  return d;
}

UsbReport report(std::uint8_t first, std::size_t size = 4) {
  Bytes bytes(size);
  bytes[0] = first;
  return UsbReport(bytes);
}

UsbStream echoStream() {
  UsbStream stream;
  stream.report_bytes = 4;
  stream.rest = report(0);
  return stream;
}

/// However busy the machine is.
template <class Condition>
bool soon(const Condition& holds) {
  for (int i = 0; i < 10'000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

class UsbTransportOnTheBus : public testing::Test {
 protected:
  void SetUp() override {
    if (!Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
    bus.emplace();
    bus->plug(interruptDevice(), echo);
  }
  template <class T>
  T now(const T& value) {
    T copy{};
    bus->locked([&] { copy = value; });
    return copy;
  }
  Echo echo, another;
  HeldClock time;
  std::optional<Bus> bus;
};

TEST_F(UsbTransportOnTheBus, ReadsPipesFromTheDescriptors) {
  UsbTransport usb({0x1234, 6});
  EXPECT_EQ(usb.inPacketBytes(), 64u);
  EXPECT_EQ(usb.outPacketBytes(), 64u);
  EXPECT_EQ(usb.path(), "1-1");
  EXPECT_EQ(usb.serialNumber(), "FS0001");
}

TEST_F(UsbTransportOnTheBus, CarriesReportsBothWays) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  std::uint64_t serial = 0;
  for (int i = 1; i <= 100; ++i) {
    usb.send(report(static_cast<std::uint8_t>(i)), usb.rests());
    ASSERT_TRUE(soon([&] { return usb.newestReport().bytes[1] == i; })) << i;
    EXPECT_GT(usb.newestReport().serial, serial);
    serial = usb.newestReport().serial;
  }
  EXPECT_EQ(usb.state(), UsbState::ok);
  EXPECT_EQ(usb.counters().reports_out, 100u);
}

TEST_F(UsbTransportOnTheBus, ReportsInOneLineWhyItCannotOpen) {
  const auto reason = [](const UsbAddress& address) -> std::string {
    try {
      UsbTransport usb(address);
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(reason({0x1234, 7}), "USB 1234:0007: not on the bus, plug it in and switch it on");
  EXPECT_EQ(reason({0x1234, 6, "1-3"}), "USB 1-3, 1234:0006: not on the bus, plug it in and switch it on");
  EXPECT_THAT(reason({0x1234, 6, "", 1}), testing::HasSubstr("interface 1 has no IN and OUT pipe"));
  bus->set({.claim_refused = true});
  EXPECT_THAT(reason({0x1234, 6}), testing::HasSubstr("in use by another program or driver"));
}

TEST_F(UsbTransportOnTheBus, ClaimsWithoutSupportForDetaching) {
  bus->set({.detach_unserved = true});
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
}

TEST_F(UsbTransportOnTheBus, ChoosesAmongTwinsByPathAndServesBulkPipes) {
  simulated_usb::Description twin = interruptDevice();
  twin.port = "2";
  twin.number = 3;
  twin.serial = "FS0002";
  twin.interface_class = 0xff;
  twin.endpoints = {{0x02, 2, 32}, {0x83, 2, 32}};
  bus->plug(twin, another);
  UsbTransport usb({0x1234, 6, "1-2"});
  EXPECT_EQ(usb.serialNumber(), "FS0002");
  EXPECT_EQ(usb.inPacketBytes(), 32u);
  usb.run(echoStream());
  usb.send(report(77), usb.rests());
  EXPECT_TRUE(soon([&] { return usb.newestReport().bytes[1] == 77; }));
  EXPECT_TRUE(now(echo.received).empty());
}

TEST_F(UsbTransportOnTheBus, RequestsHaveADeadlineBeforeItRuns) {
  UsbTransport usb({0x1234, 6});
  Bytes three{1, 2, 3}, room(8);
  EXPECT_TRUE(usb.control({0x40, 5, 0x1234, 0}, three, 60s).done());
  EXPECT_EQ(now(echo.controlled), three);
  const UsbExchange answer = usb.control({0xc0, 9, 0x0142, 0}, room, 60s);
  EXPECT_TRUE(answer.done());
  ASSERT_EQ(answer.bytes, 2u);
  EXPECT_EQ(room[0], 9);
  EXPECT_EQ(room[1], 0x42);
  EXPECT_EQ(usb.control({0xc0, 99, 0, 0}, room, 60s).outcome, UsbOutcome::stalled);

  EXPECT_TRUE(usb.write(three, 60s).done());
  EXPECT_EQ(now(echo.received), std::vector<Bytes>{three});
  Bytes packet(64);
  const UsbExchange heard = usb.read(packet, 60s);
  EXPECT_TRUE(heard.done());
  EXPECT_EQ(heard.bytes, 4u);
  EXPECT_EQ(packet[1], 1);

  bus->set({.in_silent = true, .out_refused = true});
  EXPECT_EQ(usb.read(packet, 20ms).outcome, UsbOutcome::late);
  EXPECT_EQ(usb.write(three, 20ms).outcome, UsbOutcome::late);
  bus->set({.handle_dead = true});
  EXPECT_FALSE(usb.read(packet, 20ms).done());
  EXPECT_FALSE(usb.control({0x40, 5, 0, 0}, three, 20ms).done());
}

TEST_F(UsbTransportOnTheBus, GivesUpAHandleThatNeverCompletesATransfer) {
  UsbTransport usb({0x1234, 6});
  bus->set({.stuck = true});
  Bytes packet(64);
  EXPECT_EQ(usb.read(packet, 5ms).outcome, UsbOutcome::gone);
  EXPECT_EQ(usb.write(packet, 5ms).outcome, UsbOutcome::gone);
}

TEST_F(UsbTransportOnTheBus, WaitsForAReportUntilTheDeadlineOnly) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.newestReport().serial > 0; }));
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t before = usb.newestReport().serial;
    ASSERT_TRUE(usb.awaitReport(monotonic_ns() + 10'000'000'000));
    const UsbReport& after = usb.newestReport();
    EXPECT_GT(after.serial, before);
    EXPECT_LE(after.received_ns, monotonic_ns());
  }
  bus->set({.in_silent = true});
  EXPECT_TRUE(soon([&] {
    usb.newestReport();
    return !usb.awaitReport(monotonic_ns() + 20'000'000);
  }));
}

TEST_F(UsbTransportOnTheBus, IsLateWithoutReportsAndOkAgainAfterwards) {
  UsbTransport usb({0x1234, 6});
  UsbStream stream = echoStream();
  stream.in_deadline = 30ms;
  usb.run(stream);
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->set({.in_silent = true});
  ASSERT_TRUE(soon([&] { return usb.counters().in_timeouts >= 6; }));
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::late; }));
  bus->set({});
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
}

TEST_F(UsbTransportOnTheBus, CancelsAReportThatIsNotAcceptedAndSendsTheNewest) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->set({.out_refused = true});
  usb.send(report(1), usb.rests());
  const auto timesOut = [&](std::uint64_t times) {
    return soon([&] {
      time.pass(5ms);
      return usb.counters().out_timeouts >= times && usb.state() == UsbState::late;
    });
  };
  ASSERT_TRUE(timesOut(1));
  // One is on its way again and again; of those that come meanwhile only the newest counts.
  for (std::uint8_t i = 2; i <= 9; ++i) usb.send(report(i), usb.rests());
  ASSERT_TRUE(timesOut(2));
  usb.send(report(10), usb.rests());
  bus->set({});
  ASSERT_TRUE(soon([&] { return usb.newestReport().bytes[1] == 10 && usb.state() == UsbState::ok; }));
  EXPECT_LE(now(echo.received).size(), 2u);
  EXPECT_GE(usb.counters().replaced_out, 5u);
}

TEST_F(UsbTransportOnTheBus, ClearsAHaltedPipeAndGoesOn) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->set({.in_halted = true});
  ASSERT_TRUE(soon([&] { return bus->halts_cleared() == 1; }));
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->set({.out_halted = true});
  usb.send(report(1), usb.rests());
  ASSERT_TRUE(soon([&] { return bus->halts_cleared() == 2; }));
  usb.send(report(2), usb.rests());
  EXPECT_TRUE(soon([&] { return usb.newestReport().bytes[1] == 2; }));
  EXPECT_EQ(usb.counters().stalls, 2u);
}

TEST_F(UsbTransportOnTheBus, ClearsAHaltThatStaysNoMoreThanAFewTimes) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->set({.in_halted = true, .halts_stay = true});
  ASSERT_TRUE(soon([&] { return bus->halts_cleared() == 3 && usb.state() == UsbState::stalled; }));
  for (int i = 0; i < 10; ++i) time.passAndSettle(200ms, *bus);
  EXPECT_EQ(bus->halts_cleared(), 3);
  EXPECT_EQ(usb.state(), UsbState::stalled);
  // What goes out still does: the motors can be let go.
  EXPECT_TRUE(usb.sendLast(report(0), 5s));
}

TEST_F(UsbTransportOnTheBus, NeverShowsAReportOfTheWrongLength) {
  UsbTransport usb({0x1234, 6}, time.clock());
  bus->locked([&] { echo.report_bytes = 3; });
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.counters().short_reports >= 3; }));
  EXPECT_EQ(usb.newestReport().serial, 0u);
  bus->locked([&] { echo.report_bytes = 64; });
  ASSERT_TRUE(soon([&] { return usb.counters().overlong_reports >= 3; }));
  bus->locked([&] { echo.report_bytes = 0; });
  const std::uint64_t shorts = usb.counters().short_reports;
  ASSERT_TRUE(soon([&] { return usb.counters().short_reports >= shorts + 3; }));
  EXPECT_EQ(usb.newestReport().serial, 0u);
  // Beyond the packet: the kernel refuses it.
  bus->locked([&] { echo.report_bytes = 65; });
  const std::uint64_t longs = usb.counters().overlong_reports;
  ASSERT_TRUE(soon([&] { return usb.counters().overlong_reports >= longs + 10; }));
  EXPECT_EQ(usb.newestReport().serial, 0u);
  EXPECT_NE(usb.state(), UsbState::ok);
  bus->locked([&] { echo.report_bytes = 4; });
  EXPECT_TRUE(soon([&] { return usb.newestReport().serial > 0 && usb.state() == UsbState::ok; }));
}

TEST_F(UsbTransportOnTheBus, ReceivesReportsInTheirOrder) {
  UsbTransport usb({0x1234, 6}, time.clock());
  UsbStream stream = echoStream();
  std::vector<std::uint8_t> heard;
  stream.reader = [&](std::span<const std::uint8_t> bytes) -> std::optional<UsbReport> {
    heard.push_back(bytes[0]);
    return UsbReport(bytes);
  };
  bus->locked([&] { echo.hurries = true; });
  usb.run(stream);
  ASSERT_TRUE(soon([&] { return usb.newestReport().serial >= 300; }));
  usb.stop();
  for (std::size_t i = 1; i < heard.size(); ++i) ASSERT_EQ(heard[i], static_cast<std::uint8_t>(heard[i - 1] + 1)) << i;
}

TEST_F(UsbTransportOnTheBus, AReaderAssemblesReports) {
  UsbTransport usb({0x1234, 6}, time.clock());
  UsbStream stream = echoStream();
  int pieces = 0;
  stream.reader = [&](std::span<const std::uint8_t> bytes) -> std::optional<UsbReport> {
    if (++pieces % 3 != 0) return {};
    return UsbReport(bytes.first(2));
  };
  usb.run(stream);
  ASSERT_TRUE(soon([&] { return usb.newestReport().serial >= 3; }));
  EXPECT_EQ(usb.newestReport().size, 2);
  usb.stop();
  EXPECT_EQ(usb.counters().reports_in, static_cast<std::uint64_t>(pieces / 3));
}

TEST_F(UsbTransportOnTheBus, ARestVoidsEarlierReports) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  const std::uint32_t before = usb.rests();
  usb.send(report(5), before);
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 1; }));
  usb.rest();
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 2; }));
  for (int i = 0; i < 20; ++i) {
    usb.send(report(6), before);
    HeldClock::settle(*bus);
  }
  usb.send(report(7), usb.rests());
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 3; }));
  const std::vector<Bytes> received = now(echo.received);
  EXPECT_EQ(received[1], Bytes(4, 0));
  EXPECT_EQ(received[2][0], 7);
}

TEST_F(UsbTransportOnTheBus, ARestIsSentUntilItIsAccepted) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  bus->set({.out_refused = true});
  usb.rest();
  ASSERT_TRUE(soon([&] { return usb.counters().out_timeouts >= 3; }));
  EXPECT_TRUE(now(echo.received).empty());
  bus->set({});
  EXPECT_TRUE(soon([&] { return now(echo.received).size() == 1; }));
}

TEST_F(UsbTransportOnTheBus, RestsByItselfWithoutReports) {
  UsbTransport usb({0x1234, 6}, time.clock());
  UsbStream stream = echoStream();
  stream.rest_after = 10ms;
  usb.run(stream);
  usb.send(report(5), usb.rests());
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 1; }));
  time.passAndSettle(9ms, *bus);
  EXPECT_EQ(now(echo.received).size(), 1u) << "not before its time";
  time.pass(1ms);
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 2; }));
  EXPECT_EQ(now(echo.received)[1], Bytes(4, 0));
  time.passAndSettle(50ms, *bus);
  EXPECT_EQ(now(echo.received).size(), 2u) << "once is enough";
  EXPECT_EQ(usb.counters().silences, 1u);
  // A new send restarts the exchange.
  usb.send(report(6), usb.rests());
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 3; }));
  time.pass(10ms);
  ASSERT_TRUE(soon([&] { return now(echo.received).size() == 4; }));
  EXPECT_EQ(now(echo.received)[2][0], 6);
}

TEST_F(UsbTransportOnTheBus, SendsTheLastReportAndNothingAfterIt) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  std::atomic<bool> over{false};
  std::atomic<int> sent{0};
  std::thread servo([&] {
    while (!over.load()) {
      usb.send(report(9), usb.rests());
      sent.fetch_add(1);
      usb.awaitReport(monotonic_ns() + 1'000'000);
      usb.newestReport();
    }
  });
  ASSERT_TRUE(soon([&] { return now(echo.received).size() > 20; }));
  // From two threads at once, as a supervisor and a signal handler might.
  bool taken[2] = {false, false};
  std::thread other([&] { taken[0] = usb.sendLast(report(200), 10s); });
  taken[1] = usb.sendLast(report(200), 10s);
  other.join();
  EXPECT_TRUE(taken[0] && taken[1]);
  const std::size_t received = now(echo.received).size();
  usb.rest();
  EXPECT_TRUE(usb.sendLast(report(100), 10s)) << "the first is what is sent";
  const int sent_then = sent.load();
  EXPECT_TRUE(soon([&] { return sent.load() > sent_then + 20; }));
  HeldClock::settle(*bus);
  over.store(true);
  servo.join();
  usb.stop();
  EXPECT_EQ(now(echo.received).size(), received);
  EXPECT_EQ(now(echo.received).back()[0], 200);
}

TEST_F(UsbTransportOnTheBus, TheLastReportOvertakesOneThatHangs) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  bus->set({.out_refused = true});
  usb.send(report(9), usb.rests());
  ASSERT_TRUE(soon([&] { return usb.counters().out_timeouts >= 1; }));
  usb.send(report(9), usb.rests());
  const std::uint64_t late = usb.counters().out_timeouts;
  std::thread helper([&] {
    EXPECT_TRUE(soon([&] { return usb.counters().out_timeouts >= late + 3; }));
    bus->set({});
  });
  EXPECT_TRUE(usb.sendLast(report(200), 20s));
  helper.join();
  usb.stop();
  ASSERT_FALSE(now(echo.received).empty());
  EXPECT_EQ(now(echo.received).back()[0], 200);
}

TEST_F(UsbTransportOnTheBus, NothingFollowsALastReportThatWasNotAccepted) {
  UsbTransport usb({0x1234, 6}, time.clock());
  usb.run(echoStream());
  bus->set({.out_refused = true});
  std::atomic<bool> given_up{false};
  std::thread clock([&] {
    while (!given_up.load()) time.passAndSettle(20ms, *bus);
  });
  EXPECT_FALSE(usb.sendLast(report(200), 60ms));
  given_up.store(true);
  clock.join();
  EXPECT_GE(usb.counters().out_timeouts, 1u);
  time.passAndSettle(100ms, *bus);
  bus->set({});
  usb.send(report(9), usb.rests());
  usb.rest();
  time.passAndSettle(50ms, *bus);
  EXPECT_TRUE(now(echo.received).empty());
}

TEST_F(UsbTransportOnTheBus, IsGoneForGoodWhenUnplugged) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->unplug();
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::gone; }));
  simulated_usb::Description replugged = interruptDevice();
  replugged.number = 3;  // as the kernel does: never the same one at once
  bus->plug(replugged, another);
  usb.send(report(1), usb.rests());
  EXPECT_FALSE(usb.sendLast(report(0), 200ms));
  EXPECT_EQ(usb.state(), UsbState::gone);
  usb.stop();
  EXPECT_TRUE(another.received.empty());
  // Whoever wants it back opens it again.
  UsbTransport fresh({0x1234, 6});
  fresh.run(echoStream());
  EXPECT_TRUE(soon([&] { return fresh.state() == UsbState::ok; }));
}

TEST_F(UsbTransportOnTheBus, IsGoneWhenTheHandleIsDead) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  ASSERT_TRUE(soon([&] { return usb.state() == UsbState::ok; }));
  bus->set({.handle_dead = true});
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::gone; }));
}

TEST_F(UsbTransportOnTheBus, IsGoneWhenTransfersNeverComplete) {
  UsbTransport usb({0x1234, 6});
  UsbStream stream = echoStream();
  stream.in_deadline = 30ms;
  stream.dead_after = 100ms;
  usb.run(stream);
  bus->set({.stuck = true});
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::gone; }));
}

TEST_F(UsbTransportOnTheBus, IsGoneWhenEverythingFails) {
  UsbTransport usb({0x1234, 6});
  usb.run(echoStream());
  bus->set({.errors = true});
  EXPECT_TRUE(soon([&] { return usb.state() == UsbState::gone; }));
  EXPECT_GT(usb.counters().errors, 10u);
  EXPECT_LT(usb.counters().errors, 200u) << "it pauses between";
}

TEST_F(UsbTransportOnTheBus, CanBeQueriedBeforeItRunsAndAfterItStopped) {
  UsbTransport usb({0x1234, 6});
  usb.rest();
  EXPECT_FALSE(usb.sendLast(report(0), 10ms));
  EXPECT_EQ(usb.rests(), 0u);
  EXPECT_EQ(usb.state(), UsbState::late);
  usb.run(echoStream());
  usb.stop();
  usb.stop();
  const std::size_t received = now(echo.received).size();
  usb.send(report(1), usb.rests());
  EXPECT_FALSE(usb.sendLast(report(0), 10s));
  EXPECT_EQ(now(echo.received).size(), received);
}

}  // namespace
}  // namespace haptics
