// In which order a participant does the tasks. Pure; any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "app/evaluation/study_template.h"

namespace app {

/// Williams' Latin square (1949) of n: every task once at each place, and each follows each other one equally often. n
/// rows for an even n, else 2n.
std::vector<std::vector<std::size_t>> williamsSquare(std::size_t n);

/// Places of tasks. Latin square: the participant's number (P07: 7) chooses the row, the seed which task stands for
/// which letter; the same for all participants. Shuffled: by seed and number.
std::vector<std::size_t> taskOrder(OrderKind kind, std::size_t tasks, std::uint64_t seed, std::uint64_t participant);

/// Of a code: its digits.
std::uint64_t numberOfCode(const std::string& code);

}  // namespace app
