// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/caught.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/heavy.hpp"

namespace strake::parallel {

/// The keys that are marked, ascending.
[[nodiscard]] inline std::vector<std::uint32_t> keys_of(const std::vector<bool>& marked) {
  std::vector<std::uint32_t> keys;
  for (std::uint32_t key = 0; key < marked.size(); ++key)
    if (marked[key]) keys.push_back(key);
  return keys;
}

/// What is worked out once for some of many keys, and then only read: what a sequential program
/// keeps in a cache that fills itself while it is asked, which on several threads is a race or a
/// lock.
///
///     Precomputed<Tree> trees(parts.size());
///     const Status status = trees.fill(context, {.name = "trees"}, wanted,
///                                      [&](std::size_t p) { return Tree(parts[p]); });
///     ... in later regions, from any worker: if (const Tree* tree = trees.find(p)) ...
///
/// Keys are numbers below the table's size; give what is equal one number first (distinct). Filled
/// between regions, read within them: filling while others read is a race.
template <class T>
class Precomputed {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");

 public:
  Precomputed() = default;
  explicit Precomputed(std::size_t keys) : keys_(keys) {}

  /// The number of keys, made or not.
  [[nodiscard]] std::size_t size() const { return keys_; }
  /// The value of a key; null where it was not made.
  [[nodiscard]] const T* find(std::size_t key) const {
    return made_.empty() || made_[key] == 0 ? nullptr : &values_[key];
  }

  /// Makes make(key), a T or a Result<T>, for the keys that are wanted and not there yet, each once
  /// however often it is named. The region's n is set here. Errors as in for_each, that of the
  /// lowest failing key, which is the item that an exception's error names: nothing has been made
  /// then that can be found.
  template <class Make>
  [[nodiscard]] Status fill(const Context& context, Region region,
                            std::span<const std::uint32_t> wanted, Make&& make) {
    return add(wanted, [&](const std::vector<std::uint32_t>& missing) {
      region.n = missing.size();
      return for_each(context, region,
                      [&](std::size_t k) { return put(region.name, missing[k], make); });
    });
  }

  /// The same for values of very unequal cost(key), heavy ones by the whole team: see
  /// for_each_by_weight.
  template <class Cost, class Make>
  [[nodiscard]] Status fill_by_weight(const Context& context, Region region, double least,
                                      std::span<const std::uint32_t> wanted, Cost&& cost,
                                      Make&& make) {
    return add(wanted, [&](const std::vector<std::uint32_t>& missing) {
      region.n = missing.size();
      return for_each_by_weight(
          context, region, least, [&](std::size_t k) { return cost(std::size_t{missing[k]}); },
          [&](std::size_t k) { return put(region.name, missing[k], make); });
    });
  }

 private:
  template <class Make>
  Status put(std::string_view region, std::size_t key, Make& make) {
    try {
      if constexpr (std::is_convertible_v<std::invoke_result_t<Make&, std::size_t>, T>) {
        values_[key] = make(key);
      } else {
        Result<T> made = make(key);
        if (!made) return made.error();
        values_[key] = std::move(made).value();
      }
      return {};
    } catch (...) {
      return detail::caught(region, key);
    }
  }

  template <class Fill>
  Status add(std::span<const std::uint32_t> wanted, Fill&& fill) {
    try {
      // No memory for tables that nobody asks.
      if (wanted.empty()) return {};
      values_.resize(keys_);
      made_.resize(keys_, 0);
      std::vector<std::uint32_t> missing;
      for (const std::uint32_t key : wanted)
        if (made_[key] == 0) missing.push_back(key);
      std::ranges::sort(missing);
      missing.erase(std::ranges::unique(missing).begin(), missing.end());
      const Status status = fill(std::as_const(missing));
      if (status)
        for (const std::uint32_t key : missing) made_[key] = 1;
      return status;
    } catch (const std::bad_alloc&) {
      return out_of_memory();
    } catch (const std::length_error&) {
      return out_of_memory();
    }
  }

  std::size_t keys_ = 0;
  std::vector<T> values_;
  std::vector<std::uint8_t> made_;
};

}  // namespace strake::parallel
