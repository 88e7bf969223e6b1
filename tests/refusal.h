// What a refusal says: its one line, or "accepted".
#pragma once

#include <string>

#include <gtest/gtest.h>

namespace tests {

template <class Refusal, class Act>
std::string refusalOf(const Act& act) {
  try {
    act();
  } catch (const Refusal& refusal) {
    const std::string text = refusal.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_FALSE(text.empty());
    return text;
  }
  return "accepted";
}

}  // namespace tests
