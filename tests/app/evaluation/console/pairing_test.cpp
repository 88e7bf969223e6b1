#include "app/evaluation/console/pairing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/evaluation/console/certificate.h"

namespace app {
namespace {

using nlohmann::json;

TEST(Pairing, FiveTriesAndTheCodeGivesATokenEachTime) {
  Pairing pairing(true);
  ASSERT_EQ(pairing.digits().size(), 6u);
  EXPECT_EQ(pairing.digits().find_first_not_of("0123456789"), std::string::npos);
  const std::string wrong = pairing.digits() == "000000" ? "000001" : "000000";
  const json first = json::parse(pairing.answerTo({7, pairing.digits()}));
  EXPECT_EQ(first["request"], 7);
  EXPECT_EQ(first["token"].get<std::string>().size(), 64u);
  const json second = json::parse(pairing.answerTo({8, pairing.digits()}));
  EXPECT_NE(second["token"], first["token"]);
  EXPECT_EQ(json::parse(pairing.greeting())["tokens"].size(), 2u);
  for (int n = 0; n < Pairing::kTries; ++n)
    EXPECT_FALSE(json::parse(pairing.answerTo({9, n == 0 ? "" : wrong})).contains("token"));
  // Then not even the right one.
  EXPECT_FALSE(json::parse(pairing.answerTo({10, pairing.digits()})).contains("token"));
  EXPECT_EQ(json::parse(pairing.greeting())["tokens"].size(), 2u);
}

TEST(Pairing, WhereItIsNotSharedNothingIsMade) {
  Pairing pairing(false);
  EXPECT_EQ(pairing.greeting(), "");
  EXPECT_TRUE(pairing.options().empty());
  EXPECT_TRUE(pairing.descriptors().empty());
  EXPECT_FALSE(json::parse(pairing.answerTo({1, ""})).contains("token"));
}

TEST(Pairing, EachStationsCertificateIsItsOwn) {
  const std::string one = selfMadeIdentity(), other = selfMadeIdentity();
  EXPECT_NE(one.find("PRIVATE KEY"), std::string::npos);
  EXPECT_NE(one.find("CERTIFICATE"), std::string::npos);
  EXPECT_EQ(fingerprintOf(one).size(), 95u);
  EXPECT_EQ(fingerprintOf(one), fingerprintOf(one));
  EXPECT_NE(fingerprintOf(one), fingerprintOf(other));
}

TEST(Pairing, RandomWordsDiffer) {
  EXPECT_EQ(randomWord().size(), 32u);
  EXPECT_NE(randomWord(), randomWord());
}

}  // namespace
}  // namespace app
