// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/slots.hpp"

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
/// between regions, read within them: filling while others read is a race. A value stays where it
/// is when the table is filled again or moved. Memory: a pointer for each key once one is made, and
/// the values that were made.
template <class T>
class Precomputed {
  static_assert(!std::is_same_v<T, bool>, "bits cannot be written concurrently: use uint8_t");

 public:
  Precomputed() = default;
  explicit Precomputed(std::size_t keys) : keys_(keys) {}
  Precomputed(const Precomputed&) = delete;
  Precomputed& operator=(const Precomputed&) = delete;
  Precomputed(Precomputed&&) noexcept = default;
  Precomputed& operator=(Precomputed&&) noexcept = default;
  ~Precomputed() = default;

  /// The number of keys, made or not.
  [[nodiscard]] std::size_t size() const { return keys_; }
  /// The value of a key; null where it was not made.
  [[nodiscard]] const T* find(std::size_t key) const {
    return key < made_.size() ? made_[key] : nullptr;
  }

  /// Takes all values down by the whole team, as clear() of slots does; the keys stay.
  void clear(const Context& context) noexcept {
    made_.clear();
    for (std::vector<T>& values : fills_) parallel::clear(values, context);
    fills_.clear();
  }

  /// Makes make(key), a T or a Result<T>, for the keys that are wanted and not there yet, each once
  /// however often it is named. The region's n is set here. Errors: a key that the table has not;
  /// else as in for_each, that of the lowest failing key, which is the item that an exception's
  /// error names. Nothing has been made then that can be found.
  template <class Make>
  [[nodiscard]] Status fill(const Context& context, Region region,
                            std::span<const std::uint32_t> wanted, Make&& make) {
    detail::require_shareable<Make, std::size_t>();
    return add(context, region.name, wanted,
               [&](std::span<const std::uint32_t> missing, std::vector<T>& values) {
                 region.n = missing.size();
                 return for_each(context, region, [&](std::size_t k) {
                   return put(region.name, missing[k], make, values[k]);
                 });
               });
  }

  /// The same for values of very unequal cost(key), heavy ones by the whole team: see
  /// for_each_by_weight.
  template <class Cost, class Make>
  [[nodiscard]] Status fill_by_weight(const Context& context, Region region, double least,
                                      std::span<const std::uint32_t> wanted, Cost&& cost,
                                      Make&& make) {
    detail::require_shareable<Make, std::size_t>();
    detail::require_shareable<Cost, std::size_t>();
    return add(context, region.name, wanted,
               [&](std::span<const std::uint32_t> missing, std::vector<T>& values) -> Status {
                 region.n = missing.size();
                 const auto put_one = [&](std::size_t k) {
                   return put(region.name, missing[k], make, values[k]);
                 };
                 if (region.is_short()) return for_each(context, region, put_one);
                 auto costs = costs_of(context, region.name, missing, cost);
                 if (!costs) return std::move(costs).error();
                 return for_each_by_weight(
                     context, region, least, [&](std::size_t k) { return (*costs)[k]; }, put_one);
               });
  }

 private:
  template <class Make>
  static Status put(std::string_view region, std::size_t key, Make& make, T& value) {
    return detail::status_of(region, key, [&]() -> Status {
      if constexpr (std::is_same_v<std::remove_cvref_t<std::invoke_result_t<Make&, std::size_t>>,
                                   Result<T>>) {
        Result<T> made = make(key);
        if (!made) return std::move(made).error();
        value = std::move(made).value();
      } else {
        value = make(key);
      }
      return {};
    });
  }

  /// An exception names the key, not its number among those that are missing.
  template <class Cost>
  static Result<std::vector<double>> costs_of(const Context& context, std::string_view region,
                                              std::span<const std::uint32_t> keys, Cost& cost) {
    auto costs = unset_slots<double>(keys.size());
    if (!costs) return costs;
    constexpr std::size_t kGrain = 1024;
    Context silent = context;
    silent.progress = nullptr;  // it counts values that are made
    Status status = for_each(
        silent,
        {.name = "costs of values", .n = keys.size(), .grain = kGrain, .alone_below = 2 * kGrain},
        [&](std::size_t k) {
          return detail::status_of(region, keys[k], [&] {
            (*costs)[k] = static_cast<double>(cost(std::size_t{keys[k]}));
          });
        });
    if (!status) return std::move(status).error();
    return costs;
  }

  template <class Fill>
  Status add(const Context& context, std::string_view region, std::span<const std::uint32_t> wanted,
             Fill&& fill) {
    try {
      // No memory for tables that nobody reads.
      if (wanted.empty()) return {};
      made_.resize(keys_, nullptr);
      std::vector<std::uint32_t> missing;
      for (const std::uint32_t key : wanted) {
        if (key >= keys_)
          return Error{ErrorCode::internal,
                       "key " + std::to_string(key) + " of " + std::to_string(keys_),
                       "region '" + std::string(region) + "'",
                       {}};
        if (made_[key] == nullptr) missing.push_back(key);
      }
      std::ranges::sort(missing);
      missing.erase(std::ranges::unique(missing).begin(), missing.end());
      auto made = slots<T>(missing.size(), context);
      if (!made) return std::move(made).error();
      std::vector<T> values = std::move(*made);
      if (fills_.size() == fills_.capacity()) fills_.reserve(2 * fills_.size() + 1);
      Status status = fill(std::span<const std::uint32_t>(missing), values);
      if (status && !missing.empty()) {
        fills_.push_back(std::move(values));
        for (std::size_t k = 0; k < missing.size(); ++k) made_[missing[k]] = &fills_.back()[k];
      }
      return status;
    } catch (...) {  // no room for it, or a value that cannot begin
      return out_of_memory();
    }
  }

  std::size_t keys_ = 0;
  std::vector<const T*> made_;  ///< by key
  std::vector<std::vector<T>> fills_;
};

}  // namespace strake::parallel
