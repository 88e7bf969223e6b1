#include "app/evaluation/task_order.h"

#include <numeric>

#include "calibration/random.h"

namespace app {

std::vector<std::vector<std::size_t>> williamsSquare(std::size_t n) {
  // 0, 1, n-1, 2, n-2, …: every difference between neighbours occurs once.
  std::vector<std::size_t> first;
  for (std::size_t place = 0; place < n; ++place)
    first.push_back(place % 2 == 1 ? (place + 1) / 2 : (n - place / 2) % n);
  std::vector<std::vector<std::size_t>> rows;
  for (std::size_t row = 0; row < n; ++row) {
    std::vector<std::size_t>& shifted = rows.emplace_back();
    for (const std::size_t task : first) shifted.push_back((task + row) % n);
  }
  if (n % 2 == 1 && n > 1)
    for (std::size_t row = 0; row < n; ++row) rows.emplace_back(rows[row].rbegin(), rows[row].rend());
  return rows;
}

std::vector<std::size_t> taskOrder(OrderKind kind, std::size_t tasks, std::uint64_t seed, std::uint64_t participant) {
  std::vector<std::size_t> order(tasks);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (kind == OrderKind::as_written || tasks == 0) return order;
  calibration::RandomGenerator random(seed, kind == OrderKind::shuffled ? participant : 0);
  random.shuffle(order);
  if (kind == OrderKind::shuffled) return order;
  const auto rows = williamsSquare(tasks);
  std::vector<std::size_t> of_row;
  for (const std::size_t letter : rows[(participant + rows.size() - 1) % rows.size()]) of_row.push_back(order[letter]);
  return of_row;
}

std::uint64_t numberOfCode(const std::string& code) {
  std::uint64_t number = 0;
  for (const char c : code)
    if (c >= '0' && c <= '9') number = 10 * number + static_cast<std::uint64_t>(c - '0');
  return number;
}

}  // namespace app
