#include "app/session/chain.h"

#include <bit>

namespace app {
namespace {

void addNumber(Sha256& hash, std::uint64_t value) {
  std::array<std::uint8_t, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  hash.add(bytes);
}

void addBytes(Sha256& hash, std::span<const std::uint8_t> bytes) {
  addNumber(hash, bytes.size());
  hash.add(bytes);
}

void addText(Sha256& hash, std::string_view text) {
  addBytes(hash, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

Digest chained(const Digest& previous, std::int64_t number, std::string_view table,
               std::span<const ColumnValue> columns) {
  Sha256 hash;
  hash.add(previous);
  addNumber(hash, static_cast<std::uint64_t>(number));
  addText(hash, table);
  addNumber(hash, columns.size());
  for (const ColumnValue& column : columns) {
    addNumber(hash, column.index());
    if (const auto* integer = std::get_if<std::int64_t>(&column)) addNumber(hash, static_cast<std::uint64_t>(*integer));
    if (const auto* real = std::get_if<double>(&column)) addNumber(hash, std::bit_cast<std::uint64_t>(*real));
    if (const auto* text = std::get_if<std::string_view>(&column)) addText(hash, *text);
    if (const auto* blob = std::get_if<std::span<const std::uint8_t>>(&column)) addBytes(hash, *blob);
  }
  return hash.finish();
}

}  // namespace app
