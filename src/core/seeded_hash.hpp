// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0048 says why tables of keys from files have a seeded hash.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace strake {

/// A hash for tables whose keys come from files. Each object is seeded anew, so that nobody can
/// write a file whose keys all collide and make a table as slow as a list.
///
///     std::unordered_map<std::string, std::uint32_t, SeededHash> numbers;
///
/// The order in such a table differs in every run: look keys up, never iterate over them.
class SeededHash {
 public:
  SeededHash();
  [[nodiscard]] std::size_t operator()(std::string_view text) const {
    return of(std::as_bytes(std::span(text)));
  }
  [[nodiscard]] std::size_t of(std::span<const std::byte> bytes) const;

 private:
  std::uint64_t seed_;
};

}  // namespace strake
