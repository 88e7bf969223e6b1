#include "app/device/device_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace app {
namespace {

using haptics::DeviceError;
using haptics::DeviceTrouble;

TEST(DeviceTable, ReportsFailedSearchesAsTextAndJson) {
  haptics::DeviceCatalogue catalogue;
  catalogue.troubles = {DeviceError("USB: it cannot be looked at, try again", DeviceTrouble::no_resources),
                        DeviceError("pedals: nobody lets me look, ask", DeviceTrouble::no_rights)};
  const auto troubles = nlohmann::json::parse(asJson(catalogue)).at("troubles");
  ASSERT_EQ(troubles.size(), 2u);
  EXPECT_EQ(troubles[0], (nlohmann::json{{"kind", "no-means"}, {"line", "USB: it cannot be looked at, try again"}}));
  EXPECT_EQ(troubles[1].at("kind"), "no-rights");
  EXPECT_THAT(asText(catalogue, {}), testing::HasSubstr("\n  pedals: nobody lets me look, ask\n"));
}

}  // namespace
}  // namespace app
