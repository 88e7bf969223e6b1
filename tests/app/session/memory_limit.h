// For the one test program that links memory_limit.cpp: while this is true every `new` throws. Test code only.
#pragma once

#include <atomic>

namespace app::test {

extern std::atomic<bool> memory_is_out;

}  // namespace app::test
