// What a reader says of a file: its one line, or "accepted".
#pragma once

#include <string>

#include <gtest/gtest.h>

namespace fuzz {

template <class Refusal, class Read>
std::string refusalOf(const Read& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    const std::string text = refusal.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_FALSE(text.empty());
    return text;
  }
  return "accepted";
}

}  // namespace fuzz
