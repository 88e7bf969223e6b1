#include "app/session/page_versions.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

namespace app {
namespace {

constexpr std::size_t kPage_bytes = 8;

/// Against whole copies: pages that change at random, versions halved on the way.
TEST(PageVersions, GiveBackWhatWholeCopiesDo) {
  std::mt19937_64 random(7);
  std::vector<std::byte> first(100), second(kPage_bytes);
  using Copy = std::array<std::vector<std::byte>, 2>;
  std::vector<Copy> copies;
  ArrayVersions versions(kPage_bytes);
  for (int step = 0; step < 60; ++step) {
    for (int change = 0; change < 4; ++change) first[random() % first.size()] = std::byte(random() % 256);
    if (random() % 3 == 0) second[random() % second.size()] = std::byte(random() % 256);
    const std::array<std::span<std::byte>, 2> arrays{first, second};
    versions.keep(arrays, static_cast<std::uint32_t>(copies.size()));
    copies.push_back({first, second});
    if ((step == 20 || step > 33) && copies.size() % 2 == 1 && copies.size() > 12) {
      const std::size_t bytes = versions.bytes();
      versions.halve();
      EXPECT_LE(versions.bytes(), bytes);
      std::vector<Copy> left;
      for (std::size_t n = 0; n < copies.size(); n += 2) left.push_back(copies[n]);
      copies = left;
    }
  }
  for (int n = 0; n < 200; ++n) {
    const std::size_t version = random() % copies.size();
    first.assign(first.size(), std::byte(random() % 256));
    const std::array<std::span<std::byte>, 2> arrays{first, second};
    versions.restore(arrays, static_cast<std::uint32_t>(version));
    ASSERT_EQ((Copy{first, second}), copies[version]) << version;
  }
}

TEST(PageVersions, StoreOnlyWhatChanges) {
  ArrayVersions versions(512);
  std::vector<std::byte> large(std::size_t{1} << 20);
  const std::array<std::span<std::byte>, 1> arrays{large};
  versions.keep(arrays, 0);
  large[5000] = std::byte(1);
  versions.keep(arrays, 1);
  const std::size_t bytes = versions.bytes();
  for (std::uint32_t version = 2; version < 500; ++version) {
    large[5000] ^= std::byte(3);
    versions.keep(arrays, version);
  }
  EXPECT_LT(versions.bytes() - bytes, 500u * 600u);
}

}  // namespace
}  // namespace app
