// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io::gltf {

enum class JsonType : std::uint8_t { absent, null, boolean, number, string, array, object };

class JsonValue;

/// Where a value lies in the text and where the next one is in the index.
struct JsonEntry {
  std::uint32_t begin;  ///< begin of the value in the text, without quotes
  std::uint32_t end;
  /// The entry behind this value and all within it, counted from the first of this one's piece.
  std::uint32_t next;
  JsonType type;
  bool escaped;  ///< a string that holds a backslash
};

/// An index of a JSON text with one fixed-size entry per value. Strings and numbers stay where they
/// are in the text and are decoded when requested, so a document of a hundred megabytes costs
/// little more than reading each of its bytes once.
///
/// The text must outlive the document. Follows RFC 8259, except that bytes which are not UTF-8 are
/// let through in strings (they become U+FFFD when decoded).
class JsonDocument {
 public:
  /// The deepest nesting of values.
  static constexpr std::size_t kMaxDepth = 512;
  /// Long texts are indexed in pieces of about this size, in parallel. By one worker, the index was
  /// a third of the time of loading a ship of 100,000 nodes. Between 128 KiB and 2 MiB no
  /// difference can be seen (decision 0073).
  static constexpr std::size_t kPieceBytes = std::size_t{1} << 19U;

  /// Parses a text. The error's `where` is the byte offset alone; the caller puts the file before
  /// it. Document and error are the same for every piece size and every team.
  [[nodiscard]] static Result<JsonDocument> parse(std::string_view text,
                                                  const parallel::Context& context = {},
                                                  std::size_t piece_bytes = kPieceBytes);

  /// Parses the elements of an array with the commas between them, where the array has `depth`
  /// values around them, itself among them. Nothing when they are not valid, or none.
  [[nodiscard]] static std::optional<JsonDocument> parse_items(std::string_view items,
                                                               std::size_t depth);

  [[nodiscard]] JsonValue root() const;
  /// Calls visit(item) for each of what parse_items() parsed.
  template <class Visit>
  void each_item(Visit&& visit) const;

 private:
  friend class JsonValue;
  friend class FragmentJoiner;

  /// Takes the pieces of the index as they are: copying them into one took more than half the time
  /// that making them takes. False where their entries cannot all be numbered.
  bool adopt(std::vector<std::vector<JsonEntry>> pieces);

  // An entry's number: that of its piece above `shift_` bits, its own in the piece below.
  [[nodiscard]] std::uint32_t first_of_piece(std::size_t piece) const {
    return static_cast<std::uint32_t>(piece << shift_);
  }
  [[nodiscard]] std::uint32_t first_of_its_piece(std::uint32_t entry) const {
    return entry >> shift_ << shift_;
  }
  [[nodiscard]] const JsonEntry& at(std::uint32_t entry) const {
    return pieces_[entry >> shift_][entry - first_of_its_piece(entry)];
  }
  /// Returns the number of what stands at a place: behind the last entry of a piece that is the
  /// first of a later one, or the end.
  [[nodiscard]] std::uint32_t settled(std::uint32_t place) const {
    std::size_t piece = place >> shift_;
    while (piece < pieces_.size() && place - first_of_piece(piece) == pieces_[piece].size())
      place = first_of_piece(++piece);
    return place;
  }
  [[nodiscard]] std::uint32_t next(std::uint32_t entry) const {
    return settled(first_of_its_piece(entry) + at(entry).next);
  }

  std::string_view text_;
  std::vector<std::vector<JsonEntry>> pieces_;
  unsigned shift_ = 0;
};

/// A value of a document, or the absence of one: every function may be called for any value and
/// returns "no" where it does not apply.
class JsonValue {
 public:
  JsonValue() = default;

  [[nodiscard]] JsonType type() const { return exists() ? entry().type : JsonType::absent; }
  [[nodiscard]] bool exists() const { return document_ != nullptr; }
  [[nodiscard]] bool is_object() const { return type() == JsonType::object; }
  [[nodiscard]] bool is_array() const { return type() == JsonType::array; }
  [[nodiscard]] bool is_string() const { return type() == JsonType::string; }

  /// Returns a member of an object; of repeated keys the first.
  [[nodiscard]] JsonValue operator[](std::string_view key) const;

  /// Returns the members for several keys at a time, in one pass over the object.
  template <std::size_t N>
  [[nodiscard]] std::array<JsonValue, N> pick(const std::array<std::string_view, N>& keys) const {
    std::array<JsonValue, N> found;
    members([&](const JsonValue& key, const JsonValue& value) {
      // A key is compared with all of them: what it says is looked up once.
      std::string decoded;
      const std::string_view text =
          key.entry().escaped ? std::string_view(decoded = key.text_value()) : key.raw();
      for (std::size_t i = 0; i < N; ++i)
        if (text == keys[i] && !found[i].exists()) found[i] = value;
    });
    return found;
  }

  /// Returns the elements of an array, or the values of an object.
  [[nodiscard]] std::vector<JsonValue> items() const;
  /// Calls visit(key, value) for each member of an object, if it is one.
  template <class Visit>
  void members(Visit&& visit) const {
    if (!is_object()) return;
    for (JsonValue key = first_child(); key.exists(); key = key.after()) {
      const JsonValue value = key.after();
      visit(key, value);
      key = value;
    }
  }
  template <class Visit>
  void elements(Visit&& visit) const {
    if (!is_array()) return;
    for (JsonValue item = first_child(); item.exists(); item = item.after()) visit(item);
  }

  [[nodiscard]] std::optional<double> number() const;
  /// Returns a number that is a whole number from 0 to 2^53.
  [[nodiscard]] std::optional<std::uint64_t> index() const;
  [[nodiscard]] std::optional<bool> boolean() const;
  /// Returns the decoded string; empty for other values.
  [[nodiscard]] std::string text_value() const;
  void append_text(std::string& out) const;
  /// Whether it is a string that is this text once decoded.
  [[nodiscard]] bool is_text(std::string_view text) const {
    if (!is_string()) return false;
    return entry().escaped ? text_value() == text : raw() == text;
  }
  /// Returns the value as it is written in the text; strings without their quotes.
  [[nodiscard]] std::string_view raw() const {
    if (!exists()) return {};
    return document_->text_.substr(entry().begin, entry().end - entry().begin);
  }
  /// Reads the numbers of an array, if there are exactly `count` and nothing else.
  [[nodiscard]] bool numbers(double* out, std::size_t count) const;

 private:
  friend class JsonDocument;
  JsonValue(const JsonDocument* document, std::uint32_t entry, std::uint32_t end)
      : document_(document), entry_(entry), end_(end) {}
  [[nodiscard]] const JsonEntry& entry() const { return document_->at(entry_); }
  [[nodiscard]] JsonValue first_child() const {
    if (!is_object() && !is_array()) return {};
    const std::uint32_t first = document_->settled(entry_ + 1), next = document_->next(entry_);
    return first == next ? JsonValue{} : JsonValue{document_, first, next};
  }
  [[nodiscard]] JsonValue after() const {
    const std::uint32_t next = document_->next(entry_);
    return next == end_ ? JsonValue{} : JsonValue{document_, next, end_};
  }

  const JsonDocument* document_ = nullptr;
  std::uint32_t entry_ = 0;
  std::uint32_t end_ = 0;  ///< the entry behind the last sibling
};

/// The text of an array or object, which outlives the index that it was found by.
class JsonText {
 public:
  JsonText() = default;
  /// Anything else counts as null.
  explicit JsonText(const JsonValue& value)
      : text_(!value.exists()                         ? std::string_view()
              : value.is_array() || value.is_object() ? value.raw()
                                                      : std::string_view("null")) {}

  [[nodiscard]] bool exists() const { return !text_.empty(); }
  [[nodiscard]] bool is_array() const { return text_.starts_with('['); }
  /// Makes an index of what was valid once; of null where there is nothing.
  [[nodiscard]] JsonDocument parse() const {
    return JsonDocument::parse(exists() ? text_ : std::string_view("null")).value();
  }

 private:
  std::string_view text_;
};

template <class Visit>
void JsonDocument::each_item(Visit&& visit) const {
  for (JsonValue item = root(); item.exists(); item = item.after()) visit(item);
}

}  // namespace strake::io::gltf
