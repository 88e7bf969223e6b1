#include "app/device/pose_source_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/text/usage_error.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

using testing::HasSubstr;

std::string schemeOf(const std::string& address) {
  const PoseSourceKind* kind = poseSourceKindOf(address);
  return kind ? std::string(kind->scheme) : "";
}

TEST(PoseSourceTable, KnowsEverySourceByItsAddress) {
  EXPECT_EQ(schemeOf("mouse"), "mouse");
  EXPECT_EQ(schemeOf("scripted"), "scripted");
  for (const char* address : {"simulated", "simulated:omni", "simulated:touch", "simulated:premium"})
    EXPECT_EQ(schemeOf(address), "simulated") << address;
  EXPECT_EQ(schemeOf("practice:D:7"), "practice");
  EXPECT_EQ(schemeOf("replay:a:b.molar"), "replay");
  EXPECT_EQ(schemeOf("poses:a.csv"), "poses");
  EXPECT_EQ(haptics::addressRest("replay:a:b.molar"), "a:b.molar");
}

TEST(PoseSourceTable, RefusesOtherAddressesBeforeAnythingIsLoaded) {
  for (const char* address : {"", "mice", "mouse:", "mouse:2", "scripted:x", "simulated:", "simulated:nano", "replay",
                              "replay:", "poses", "poses:", "wooden:1-2,v3", "openhaptic"})
    EXPECT_THROW(refuseUnlessPoseSource(address), UsageError) << address;
  EXPECT_THROW(refuseUnlessPoseSource("practice:Q"), UsageError);
  EXPECT_THROW(refuseUnlessPoseSource("practice"), UsageError);
  for (const char* address :
       {"mouse", "simulated:touch", "replay:x", "openhaptics", "openhaptics:Left", "wooden:v2015", "falcon:1-2", "usb"})
    EXPECT_NO_THROW(refuseUnlessPoseSource(address)) << address;
}

TEST(PoseSourceTable, HelpNamesEverySourceAndEveryDevice) {
  const std::string help = poseSourceHelp();
  for (const PoseSourceKind& kind : poseSourceKinds())
    EXPECT_THAT(help, HasSubstr(std::string(kind.scheme) + std::string(kind.help)));
  for (const haptics::DeviceKind& kind : haptics::deviceKinds()) {
    const std::string address = std::string(kind.key) + std::string(kind.suffix);
    EXPECT_TRUE(!kind.open || help.find(address) != std::string::npos) << address;
  }
}

TEST(PoseSourceTable, SimulatedSourcesNeedNoWindow) {
  for (const PoseSourceKind& kind : poseSourceKinds()) EXPECT_EQ(kind.simulated, kind.scheme != "mouse") << kind.scheme;
}

TEST(DeviceCatalogue, OpensOnlyWhatItFinds) {
  for (const haptics::DeviceKind& kind : haptics::deviceKinds())
    EXPECT_TRUE(!kind.open || (kind.find && kind.isHardware())) << kind.key;
  for (const char* address : {"mouse", "scripted", "simulated:omni", "pedal:/dev/input/event3", "usb:1-2"})
    EXPECT_FALSE(haptics::isDeviceAddress(address)) << address;
}

TEST(DeviceCatalogue, ReportsWhyADeviceCannotBeOpenedAsAKindAndAsALine) {
  try {
    haptics::openDevice("wooden:9-9", {});
    FAIL();
  } catch (const haptics::DeviceError& error) {
    // A machine without any USB cannot even look.
    const bool can_look = error.trouble != haptics::DeviceTrouble::no_resources;
    EXPECT_TRUE(!can_look || error.trouble == haptics::DeviceTrouble::not_there);
    EXPECT_THAT(error.what(),
                testing::MatchesRegex(
                    can_look ? "WoodenHaptics, USB 9-9, 1234:0006: not on the bus, plug it in and switch it on"
                             : "WoodenHaptics, USB 9-9, 1234:0006: libusb, .+, replug it and start again"));
  }
}

}  // namespace
}  // namespace app
