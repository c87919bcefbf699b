// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/seeded_hash.hpp"
#include "report/document/document_reader.hpp"
#include "report/json/json_reader.hpp"
#include "strake/core/hash.hpp"
#include "strake/report/clash_document.hpp"

/// Reads the members of a clash document.
namespace strake::report {

/// Numbers the objects that a document names, so that each is kept once.
class ObjectTable {
 public:
  /// Objects and texts go to `document`, which must outlive this and stay where it is.
  explicit ObjectTable(ClashDocument& document);

  /// Returns the number of an object in ClashDocument::objects.
  [[nodiscard]] std::uint32_t number(const DocumentObject& object);

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  /// A slot of open addressing: the number of an object, or kEmpty, and the bits of its hash that
  /// rule out others.
  struct HashSlot {
    std::uint32_t number = kEmpty, tag = 0;
  };
  [[nodiscard]] std::size_t slot(const DocumentObject& object, std::size_t hash) const;
  void put(std::size_t hash, std::uint32_t number);
  void grow();
  [[nodiscard]] std::string_view kept(std::string_view text);
  [[nodiscard]] std::string_view kept_label(std::string_view text);

  ClashDocument& document_;
  SeededHash hash_;
  std::vector<HashSlot> slots_;
  /// Results are ordered by their first object, so every other object is that of the last result.
  std::uint32_t last_ = kEmpty, last_but_one_ = kEmpty;
  std::set<std::string_view> labels_;
  std::size_t room_ = 0;  ///< bytes left in the last of the texts
  char* free_ = nullptr;
};

/// A pair of a list as the document describes it: a result, an exempted pair or what was not
/// compared.
struct DocumentEntry {
  std::optional<Hash128> key;
  std::optional<std::uint32_t> test, a, b, rule;
  std::optional<clash::Class> cls;
  std::optional<double> d_mm;
  std::optional<geometry::Vec3d> point_mm;
  std::uint32_t regions = 0, allowed_regions = 0;
  bool depth_complete = true;
};

/// Reads the pairs of a list one by one; objects and rules go to the document. Throws
/// DocumentFault.
class EntryReader {
 public:
  EntryReader(JsonReader& json, ClashDocument& document)
      : json_(json), document_(document), objects_(document) {}

  /// Calls take(entry) for each pair of the list `section`, which comes next. A pair's rule is its
  /// member `rule`.
  template <class Take>
  void each(const char* section, const char* rule, Take&& take) {
    if (json_.kind() != JsonReader::Kind::array) throw wrong_type("the document", section, "list");
    section_ = section;
    rule_ = rule;
    at_ = 0;
    json_.items([&] {
      take(next());
      ++at_;
    });
  }

  /// Returns the value of a member that every pair must have.
  template <class T>
  [[nodiscard]] T required(const std::optional<T>& value, std::string_view key) const {
    if (!value) throw missing_key(where(), key);
    return *value;
  }

 private:
  [[nodiscard]] std::string where() const;
  [[nodiscard]] DocumentEntry next();
  void read_member(std::string_view key, DocumentEntry& entry);
  // These read the value of a member, which comes next.
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
  std::array<std::string, 3> texts_;  ///< the texts of the object being read
  const char* section_ = "";
  const char* rule_ = "";
  std::size_t at_ = 0;
};

// These functions read the members of a clash document that are small enough to be read as a whole.
// All throw DocumentFault.

/// Reads the member `elements`: hashes in ascending order.
[[nodiscard]] std::vector<std::uint64_t> read_elements(std::string_view base64);

/// Reads the member `sheets`: a byte for each of so many elements.
[[nodiscard]] std::vector<std::uint8_t> read_sheets(std::string_view base64, std::size_t elements);

/// Reads the member `positional_ids`: a bit for each of so many elements.
[[nodiscard]] std::vector<std::uint8_t> read_positional_ids(std::string_view base64,
                                                            std::size_t elements);

/// Reads the member `tests`, of a model with so many elements.
[[nodiscard]] std::vector<DocumentTest> read_tests(std::string_view json, std::size_t elements);

}  // namespace strake::report
