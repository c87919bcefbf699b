// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "page/blocks/block.hpp"

/// Blocks of columns, as docs/formats/page.md has them. What a column is made of must outlast the
/// writing of its block.
namespace strake::page {

/// The numbers that a column may hold as they are.
template <class T>
concept ColumnNumber =
    std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, float> || std::same_as<T, double>;

/// Returns a text, which may be put together in `room`.
using TextOf = std::function<std::string_view(std::size_t row, std::string& room)>;

class Columns {
 public:
  explicit Columns(std::string id) { block_.id = std::move(id); }

  /// Adds a column of value(row) for each row.
  template <ColumnNumber T, class Value>
  void numbers(std::string_view name, std::size_t rows, Value value) {
    static_assert(std::same_as<std::invoke_result_t<Value&, std::size_t>, T>);
    add(name, type_of<T>(), rows, 0,
        {{rows, rows * sizeof(T),
          [value = std::move(value)](std::size_t begin, std::size_t end, std::string& out) {
            for (std::size_t row = begin; row < end; ++row) append_number(out, T(value(row)));
          }}});
  }

  /// Adds a column of numbers that rows bring along: append(row, out) appends those of a row, in
  /// all `count`.
  template <ColumnNumber T, class Append>
  void rows_of_numbers(std::string_view name, std::size_t rows, std::uint64_t count,
                       Append append) {
    add(name, type_of<T>(), count, 0,
        {{rows, count * sizeof(T),
          [append = std::move(append)](std::size_t begin, std::size_t end, std::string& out) {
            for (std::size_t row = begin; row < end; ++row) append(row, out);
          }}});
  }

  /// Adds a column of type nm: value(row) is the number of millionths.
  template <class Value>
  void millionths(std::string_view name, std::size_t rows, const Value& value) {
    static_assert(std::same_as<std::invoke_result_t<const Value&, std::size_t>, std::int64_t>);
    std::vector<RowSource> planes;
    for (unsigned plane = 0; plane < 8; ++plane)
      planes.push_back(
          {rows, rows, [value, plane](std::size_t begin, std::size_t end, std::string& out) {
             for (std::size_t row = begin; row < end; ++row)
               out +=
                   static_cast<char>(static_cast<std::uint64_t>(value(row)) >> (8 * plane) & 0xffU);
           }});
    add(name, "nm", rows, 0, std::move(planes));
  }

  /// Adds a column of type key: append(row, out) appends 26 characters.
  void keys(std::string_view name, std::size_t rows,
            std::function<void(std::size_t row, std::string& out)> append);

  /// Adds a column of texts, in which bytes that are no UTF-8 become U+FFFD.
  void texts(std::string_view name, std::size_t rows, const TextOf& text);

  [[nodiscard]] Block finish() &&;

  /// Appends the bytes of a number, the lowest first.
  template <ColumnNumber T>
  static void append_number(std::string& out, T value) {
    static_assert(std::endian::native == std::endian::little);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof bytes);
  }

 private:
  template <ColumnNumber T>
  static constexpr std::string_view type_of() {
    if constexpr (std::same_as<T, std::uint8_t>) return "u8";
    if constexpr (std::same_as<T, std::uint16_t>) return "u16";
    if constexpr (std::same_as<T, std::uint32_t>) return "u32";
    if constexpr (std::same_as<T, float>) return "f32";
    if constexpr (std::same_as<T, double>) return "f64";
  }
  /// `text_bytes` counts for texts alone.
  void add(std::string_view name, std::string_view type, std::uint64_t count,
           std::uint64_t text_bytes, std::vector<RowSource> sections);

  Block block_;
  std::string directory_;
};

}  // namespace strake::page
