// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "report/document_fault.hpp"
#include "report/json_reader.hpp"
#include "report/object_table.hpp"
#include "strake/core/hash.hpp"
#include "strake/report/clash_document.hpp"

namespace strake::report {

/// What a pair of a list says of itself: a result, an exempted pair or what was not compared.
struct DocumentEntry {
  std::optional<Hash128> key;
  std::optional<std::uint32_t> test, a, b, rule;
  std::optional<clash::Class> cls;
  std::optional<double> d_mm;
  std::optional<geometry::Vec3d> point_mm;
  std::uint32_t regions = 0, allowed_regions = 0;
  bool depth_complete = true;
};

/// Takes the pairs of a list one by one; objects and rules go to the document. Throws
/// DocumentFault.
class EntryReader {
 public:
  EntryReader(JsonReader& json, ClashDocument& document)
      : json_(json), document_(document), objects_(document) {}

  /// Each pair of the list `section`, which comes next: take(entry). A pair's rule is its member
  /// `rule`.
  template <class Take>
  void each(const char* section, const char* rule, Take&& take) {
    if (json_.kind() != JsonReader::Kind::array) throw is_not("the document", section, "list");
    section_ = section;
    rule_ = rule;
    at_ = 0;
    json_.items([&] {
      take(next());
      ++at_;
    });
  }

  /// The value of a member that every pair must have.
  template <class T>
  [[nodiscard]] T must(const std::optional<T>& value, std::string_view key) const {
    if (!value) throw lacks(where(), key);
    return *value;
  }

 private:
  [[nodiscard]] std::string where() const;
  [[nodiscard]] DocumentEntry next();
  void take_member(std::string_view key, DocumentEntry& entry);
  // The value of a member, which comes next.
  [[nodiscard]] std::string_view text(const char* key);
  [[nodiscard]] double millimetres(const char* key);
  [[nodiscard]] bool truth(const char* key);
  [[nodiscard]] geometry::Vec3d point();
  [[nodiscard]] std::uint32_t whole(const char* key, const char* what);
  [[nodiscard]] Hash128 pair_key();
  [[nodiscard]] clash::Class pair_class();
  [[nodiscard]] std::uint32_t rule();
  [[nodiscard]] std::uint32_t object(const char* side);

  JsonReader& json_;
  ClashDocument& document_;
  ObjectTable objects_;
  std::map<std::string, std::uint32_t, std::less<>> rules_;
  std::array<std::string, 3> texts_;  ///< of the object being read
  const char* section_ = "";
  const char* rule_ = "";
  std::size_t at_ = 0;
};

}  // namespace strake::report
