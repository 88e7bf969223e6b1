#include "haptics/device/openhaptics/hd_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

using testing::HasSubstr;

/// The stack of a library, newest first; hd.get_error is a plain function, so it stands outside.
std::deque<unsigned>& stack() {
  static std::deque<unsigned> errors;
  return errors;
}

HdFunctions library(std::deque<unsigned> errors) {
  stack() = std::move(errors);
  HdFunctions hd{};
  hd.get_error = [] {
    hd::ErrorInfo error{0, 0, hd::kNoDevice};
    if (stack().empty()) return error;
    error = {stack().front(), -5, 1};
    stack().pop_front();
    return error;
  };
  return hd;
}

TEST(HdError, EveryCodeOfTheInterfaceHasAMeaningAndANextStep) {
  // reference/devices 2, Errors: 5 + 5 + 5 + 3 + 2 + 1.
  constexpr unsigned kLast[] = {0x0104, 0x0204, 0x0304, 0x0402, 0x0501, 0x0600};
  std::size_t codes = 0;
  for (unsigned last : kLast)
    for (unsigned code = last & 0xFF00; code <= last; ++code, ++codes) {
      const HdErrorMeaning& meaning = meaningOf(code);
      EXPECT_EQ(meaning.code, code);
      EXPECT_GT(std::string(meaning.what).size(), 10u);
      EXPECT_GT(std::string(meaning.what_to_do).size(), 10u);
    }
  EXPECT_EQ(hdErrorMeanings().size(), codes);
}

TEST(HdError, ExceededLimitsPassAndDeviceFaultsAreFatal) {
  for (unsigned passing : {0x0100u, 0x0102u, 0x0200u, 0x0201u, 0x0202u, 0x0203u, 0x0400u, 0x0402u})
    EXPECT_EQ(meaningOf(passing).kind, HdErrorKind::passing) << passing;
  for (unsigned fatal : {0x0104u, 0x0204u, 0x0300u, 0x0301u, 0x0302u, 0x0303u, 0x0304u, 0x0500u, 0x0600u, 0x7777u})
    EXPECT_EQ(meaningOf(fatal).kind, HdErrorKind::fatal) << fatal;
}

TEST(HdError, ADeviceLeftOpenIsToBeReplugged) {
  const std::string words = errorText({0x0303, 12, 0});
  EXPECT_THAT(words, HasSubstr("HD 0x0303 (internal 12): "));
  EXPECT_THAT(words, HasSubstr("unplug it for ten seconds"));
  EXPECT_THAT(words, HasSubstr("ModemManager"));
  EXPECT_EQ(words.find('\n'), std::string::npos);
}

TEST(HdErrors, EmptyTheStackAndKeepTheFirstFatalOne) {
  HdErrors errors;
  HdDrained drained = errors.drain(library({0x0201, 0x0302, 0x0200, 0x0300}));
  EXPECT_EQ(drained.count, 4);
  EXPECT_TRUE(drained.fatal);
  EXPECT_TRUE(drained.warm_motors);
  EXPECT_EQ(drained.first.code, 0x0302u);
  EXPECT_TRUE(stack().empty());
  drained = errors.drain(library({0x0304}));
  EXPECT_EQ(errors.firstFatal().code, 0x0302u);
  EXPECT_EQ(errors.firstFatal().internal_code, -5);
  EXPECT_EQ(errors.count(0x0200), 1u);
  EXPECT_EQ(errors.count(0x0304), 1u);
  EXPECT_EQ(errors.drain(library({})).count, 0);
}

TEST(HdErrors, DrainAFullStackInBoundedPortions) {
  HdErrors errors;
  const HdFunctions hd = library(std::deque<unsigned>(100, 0x0201));
  EXPECT_EQ(errors.drain(hd).count, HdErrors::kMaxPerDrain);
  EXPECT_EQ(stack().size(), 100u - HdErrors::kMaxPerDrain);
  EXPECT_EQ(errors.firstFatal().code, hd::kSuccess);
  // Unknown codes are counted together and end the work.
  EXPECT_TRUE(errors.drain(library({0x1234, 0xFFFF})).fatal);
  EXPECT_EQ(errors.count(0x9999), 2u);
  EXPECT_EQ(errors.firstFatal().code, 0x1234u);
}

TEST(HdErrors, AreThrownWithTheirMeaning) {
  EXPECT_NO_THROW(throwOnHdError(library({}), "OpenHaptics"));
  try {
    throwOnHdError(library({0x0600}), "OpenHaptics, left arm");
    FAIL();
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("OpenHaptics, left arm, HD 0x0600 (internal -5): OpenHaptics has no valid licence"));
  }
}

TEST(HdErrorInfo, ComesByValueInTwelveBytes) {
  const HdFunctions hd = library({0x0201});
  const hd::ErrorInfo error = hd.get_error();
  EXPECT_EQ(error.code, 0x0201u);
  EXPECT_EQ(error.internal_code, -5);
  EXPECT_EQ(error.device, 1u);
}

}  // namespace
}  // namespace haptics
