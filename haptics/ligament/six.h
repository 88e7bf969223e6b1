// Six coordinates of a rigid body: a small way along x, y, z of P and a small turn about them; and the symmetric
// positive system that gives a Newton step. mm, rad, N, N mm. Any thread; 0.2 µs.
#pragma once

#include <array>
#include <cstddef>

namespace haptics {

using Six = std::array<double, 6>;

/// Upper triangle by rows, 21 elements.
struct SymmetricSix {
  std::array<double, 21> upper{};

  static constexpr std::size_t at(std::size_t row, std::size_t column) {
    return row <= column ? row * (11 - row) / 2 + column : at(column, row);
  }
  double& operator()(std::size_t row, std::size_t column) { return upper[at(row, column)]; }
  double operator()(std::size_t row, std::size_t column) const { return upper[at(row, column)]; }
};

/// Solves m x = b by LDL'. False: m is not positive, x as it was.
inline bool solve(const SymmetricSix& m, const Six& b, Six& x) noexcept {
  std::array<Six, 6> low{};
  Six pivot{}, rest = b;
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column <= row; ++column) {
      double left = m(row, column);
      for (std::size_t n = 0; n < column; ++n) left -= low[row][n] * low[column][n] * pivot[n];
      if (column < row) {
        low[row][column] = left / pivot[column];
      } else if (left > 0.0) {
        pivot[row] = left;
      } else {
        return false;
      }
    }
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t n = 0; n < row; ++n) rest[row] -= low[row][n] * rest[n];
  for (std::size_t row = 0; row < 6; ++row) rest[row] /= pivot[row];
  for (std::size_t row = 6; row-- > 0;)
    for (std::size_t n = row + 1; n < 6; ++n) rest[row] -= low[n][row] * rest[n];
  x = rest;
  return true;
}

}  // namespace haptics
