// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "project/codec/blob.hpp"

/// Members of many values as columns of a blob, and back.
namespace strake::project {

/// Writes value(item) of each item.
template <class Item, class Value>
void write_column(BlobWriter& out, std::span<const Item> items, const Value& value) {
  using T = std::decay_t<std::invoke_result_t<const Value&, const Item&>>;
  if constexpr (std::is_same_v<T, bool>) {
    std::vector<bool> flags(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) flags[i] = value(items[i]);
    out.flags(flags);
  } else {
    std::vector<T> column(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) column[i] = value(items[i]);
    if constexpr (std::is_same_v<T, double>)
      out.reals(column);
    else
      out.column(std::span<const T>(column));
  }
}

/// Reads columns of one length into the members of values.
template <class Item>
class ColumnsInto {
 public:
  ColumnsInto(BlobReader& in, std::vector<Item>& items) : in_(in), items_(items) {}

  /// Reads the first column, which says how many values there are.
  template <class T, class Set>
  void first(const Set& set) {
    const std::vector<T> column = in_.column<T>();
    items_.resize(column.size());
    put(column, set);
  }
  /// Calls set(item, value) for each item with its value of the next column.
  template <class T, class Set>
  void next(const Set& set) {
    if constexpr (std::is_same_v<T, bool>)
      put(in_.flags(), set);
    else
      put(in_.column<T>(), set);
  }
  /// Reads values of an enumeration; those beyond the last one are refused.
  template <class E, class Set>
  void next_enum(E last, const Set& set) {
    next<std::uint8_t>([&](Item& item, std::uint8_t value) {
      if (value > static_cast<std::uint8_t>(last))
        in_.refuse("a value is none of those that there are");
      else
        set(item, static_cast<E>(value));
    });
  }

 private:
  template <class Column, class Set>
  void put(const Column& column, const Set& set) {
    if (column.size() != items_.size()) {
      in_.refuse("its columns differ in length");
      return;
    }
    for (std::size_t i = 0; i < items_.size(); ++i) set(items_[i], column[i]);
  }

  BlobReader& in_;
  std::vector<Item>& items_;
};

}  // namespace strake::project
