// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

#include "strake/core/seeded_hash.hpp"
#include "strake/report/clash_document.hpp"

namespace strake::report {

/// Numbers the objects that a document names, so that each is kept once.
class ObjectTable {
 public:
  /// Objects and texts go to `document`, which must outlive this and stay where it is.
  explicit ObjectTable(ClashDocument& document);

  /// The number of an object in ClashDocument::objects.
  [[nodiscard]] std::uint32_t number(const DocumentObject& object);

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  /// Open addressing: the number of an object, or kEmpty, beside what of its hash sorts out others.
  struct Slot {
    std::uint32_t number = kEmpty, tag = 0;
  };
  [[nodiscard]] std::size_t slot(const DocumentObject& object, std::size_t hash) const;
  void put(std::size_t hash, std::uint32_t number);
  void grow();
  [[nodiscard]] std::string_view kept(std::string_view text);
  [[nodiscard]] std::string_view kept_label(std::string_view text);

  ClashDocument& document_;
  SeededHash hash_;
  std::vector<Slot> slots_;
  /// Results are ordered by their first object: every other one is that of the last result.
  std::uint32_t last_ = kEmpty, last_but_one_ = kEmpty;
  std::set<std::string_view> labels_;
  std::size_t room_ = 0;  ///< bytes left of the last of the texts
  char* free_ = nullptr;
};

}  // namespace strake::report
