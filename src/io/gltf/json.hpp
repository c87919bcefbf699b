// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::io::gltf {

enum class JsonType : std::uint8_t { absent, null, boolean, number, string, array, object };

class Json;

/// An index over a JSON text: one fixed-size entry per value, made in a single pass. Strings and
/// numbers stay where they are in the text and are decoded when asked for, so a document of a
/// hundred megabytes costs little more than looking at each of its bytes once.
///
/// The text must outlive the document. Follows RFC 8259, except that bytes which are not UTF-8 are
/// let through in strings (they become U+FFFD when decoded).
class JsonDocument {
 public:
  /// Values may be nested this deep.
  static constexpr std::size_t kMaxDepth = 512;

  /// The error's `where` is the byte offset alone; the caller puts the file before it.
  [[nodiscard]] static Result<JsonDocument> parse(std::string_view text);

  [[nodiscard]] Json root() const;

 private:
  friend class Json;
  friend class JsonIndexer;
  struct Entry {
    std::uint32_t begin = 0;  ///< of the value in the text, quotes left out
    std::uint32_t end = 0;
    std::uint32_t next = 0;  ///< entry behind this value and all within it
    JsonType type = JsonType::null;
  };
  std::string_view text_;
  std::vector<Entry> entries_;
};

/// A value of a document, or the absence of one: every question may be put to any value and is
/// answered "no" where it does not apply.
class Json {
 public:
  Json() = default;

  [[nodiscard]] JsonType type() const;
  [[nodiscard]] bool exists() const { return document_ != nullptr; }
  [[nodiscard]] bool is_object() const { return type() == JsonType::object; }
  [[nodiscard]] bool is_array() const { return type() == JsonType::array; }
  [[nodiscard]] bool is_string() const { return type() == JsonType::string; }

  /// Member of an object; of repeated keys the first.
  [[nodiscard]] Json operator[](std::string_view key) const;

  /// Elements of an array, values of an object.
  [[nodiscard]] std::vector<Json> items() const;
  /// Calls visit(key, value) for each member of an object, if it is one; the key is decoded.
  template <class Visit>
  void members(Visit&& visit) const {
    if (!is_object()) return;
    for (Json key = first_child(); key.exists(); key = key.after()) {
      const Json value = key.after();
      visit(key.text_value(), value);
      key = value;
    }
  }
  template <class Visit>
  void elements(Visit&& visit) const {
    if (!is_array()) return;
    for (Json item = first_child(); item.exists(); item = item.after()) visit(item);
  }

  [[nodiscard]] std::optional<double> number() const;
  /// A number that is a whole number from 0 to 2^53.
  [[nodiscard]] std::optional<std::uint64_t> index() const;
  [[nodiscard]] std::optional<bool> boolean() const;
  /// The decoded string; empty for other values.
  [[nodiscard]] std::string text_value() const;
  /// The value as it stands in the text; strings without their quotes.
  [[nodiscard]] std::string_view raw() const;
  /// Numbers of an array, if there are exactly `count` and nothing else.
  [[nodiscard]] bool numbers(double* out, std::size_t count) const;

 private:
  friend class JsonDocument;
  Json(const JsonDocument* document, std::uint32_t entry, std::uint32_t end)
      : document_(document), entry_(entry), end_(end) {}
  [[nodiscard]] const JsonDocument::Entry& entry() const { return document_->entries_[entry_]; }
  [[nodiscard]] Json first_child() const;
  [[nodiscard]] Json after() const;

  const JsonDocument* document_ = nullptr;
  std::uint32_t entry_ = 0;
  std::uint32_t end_ = 0;  ///< entry behind the last sibling
};

}  // namespace strake::io::gltf
