// SPDX-License-Identifier: Apache-2.0
// Indexes a JSON text fragment by fragment, so that a team can work on it.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/gltf/json/json.hpp"
#include "io/gltf/json/quote_state.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

/// The index of a fragment of a JSON text. A fragment begins at the beginning of the text or behind
/// a comma between two items, and ends at the end of the text or behind another such comma. What
/// encloses a later fragment is not known while it is indexed, only what it closes of it.
struct JsonFragment {
  /// The end, in this fragment, of an array or object that an earlier one opened.
  struct Close {
    JsonType type = JsonType::absent;
    std::uint32_t text_end = 0;
    std::uint32_t entries = 0;  ///< entries of this fragment that come before it
  };
  std::vector<JsonEntry> entries;  ///< offsets are of the whole text, `next` of this fragment
  std::vector<Close> closes;
  std::vector<std::uint32_t> open;  ///< entries that are still open at the end, outermost first
  /// The type of the innermost array or object that was open before the fragment and still is at
  /// its end; absent: nothing in the fragment tells.
  JsonType outer = JsonType::absent;
  std::size_t deepest = 0;        ///< most values open at once, not counting those opened before
  bool behind_comma = false;      ///< an item is expected next
  const char* message = nullptr;  ///< describes a fault at text offset `at`; null: none
  std::size_t at = 0;
};

/// Returns the offset behind the first comma of the block that is not in a string; 0 when there is
/// none.
std::size_t first_cut(std::string_view text, std::size_t begin, std::size_t end, QuoteState place) {
  for (std::size_t at = begin; at < end; ++at) {
    const char c = text[at];
    if (c == ',' && !place.in_string) return at + 1;
    place.pass(c);
  }
  return 0;
}

/// Returns where to split a JSON text into pieces of about `piece_bytes`: offsets behind commas
/// that lie outside strings, ascending. They depend on the text and the size only, and take a
/// fraction of the time of an index: whether a block of the text begins within a string follows
/// from the number of quotes before it. In a text that is no JSON the offsets are of no use, but do
/// no harm.
Result<std::vector<std::size_t>> json_split_points(std::string_view text, std::size_t piece_bytes,
                                                   const parallel::Context& context) {
  const std::size_t blocks = text.size() / piece_bytes;
  if (blocks < 2) return std::vector<std::size_t>{};
  const Result<std::vector<QuoteState>> begins = quote_states(text, piece_bytes, context);
  if (!begins) return begins.error();
  Result<std::vector<std::size_t>> cuts =
      parallel::transform(context, {.name = "cut glTF text", .n = blocks}, [&](std::size_t k) {
        if (k == 0) return std::size_t{0};
        return first_cut(text, k * piece_bytes, (k + 1) * piece_bytes, (*begins)[k]);
      });
  if (cuts) std::erase(*cuts, std::size_t{0});
  return cuts;
}

constexpr bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
constexpr bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

constexpr bool stops_string(char c) {
  return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20;
}

/// Returns where the plain part of a string ends: at a quote, a backslash, or a control character.
std::size_t string_stop(std::string_view text, std::size_t at) {
  constexpr std::uint64_t kOnes = 0x0101010101010101U, kHighs = 0x80 * kOnes;
  for (; at + 8 <= text.size(); at += 8) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, text.data() + at, 8);
    // The high bit of a byte remains where subtraction makes it borrow: exact for the lowest such
    // byte, which is all that is asked.
    const auto below = [](std::uint64_t b, std::uint64_t limit) {
      return (b - limit * kOnes) & ~b;
    };
    const std::uint64_t found =
        below(bytes, 0x20) | below(bytes ^ ('"' * kOnes), 1) | below(bytes ^ ('\\' * kOnes), 1);
    if ((found & kHighs) != 0) break;
  }
  while (at < text.size() && !stops_string(text[at])) ++at;
  return at;
}

/// Indexes a fragment in a loop over the items of the text with an explicit stack of what is open.
class PieceIndexer {
 public:
  /// What encloses the next item.
  enum class In : std::uint8_t { document, array, object, unknown };

  PieceIndexer(std::string_view text, std::size_t begin, std::size_t end, In in)
      : text_(text.substr(0, end)), at_(begin), in_(in), outer_(in) {
    // Dense documents have a value every five or six bytes.
    piece_.entries.reserve((end - begin) / 6 + 8);
  }
  JsonFragment run();

 private:
  bool item();
  bool after_item();
  void find_enclosing_container();
  bool value();
  bool key();
  bool open(JsonType type);
  bool close(char c);
  bool close_outer(JsonType type);
  bool string();
  bool escape();
  bool number();
  bool literal(std::string_view word, JsonType type);
  bool fail(const char* message) {
    piece_.message = message;
    return false;
  }
  void push(JsonType type, std::size_t begin, std::size_t end, bool escaped = false) {
    const auto next = static_cast<std::uint32_t>(piece_.entries.size() + 1);
    piece_.entries.push_back(
        {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), next, type, escaped});
  }
  [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_digits() {
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
  }
  void skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  std::string_view text_;
  std::size_t at_;
  In in_, outer_;
  bool opened_ = false;  ///< the last item is an array or object whose items follow
  JsonFragment piece_;
};

bool PieceIndexer::escape() {
  const char c = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
  if (c == 'u') {
    for (std::size_t k = 2; k < 6; ++k) {
      const char digit = at_ + k < text_.size() ? text_[at_ + k] : '\0';
      const bool hex =
          is_digit(digit) || (digit >= 'a' && digit <= 'f') || (digit >= 'A' && digit <= 'F');
      if (!hex) return fail("a \\u needs four hexadecimal digits");
    }
    at_ += 6;
    return true;
  }
  if (c == '\0' || std::string_view("\"\\/bfnrt").find(c) == std::string_view::npos)
    return fail("this escape does not exist");
  at_ += 2;
  return true;
}

bool PieceIndexer::string() {
  const std::size_t begin = ++at_;
  bool escaped = false;
  while (true) {
    at_ = string_stop(text_, at_);
    if (at_ == text_.size()) return fail("a string does not end");
    if (text_[at_] == '"') break;
    if (text_[at_] != '\\') return fail("a control character stands in a string");
    if (!escape()) return false;
    escaped = true;
  }
  push(JsonType::string, begin, at_++, escaped);
  return true;
}

bool PieceIndexer::number() {
  const std::size_t begin = at_;
  if (here() == '-') ++at_;
  const std::size_t whole = at_;
  skip_digits();
  if (at_ == whole) return fail("a value is expected here");
  if (text_[whole] == '0' && at_ - whole > 1) return fail("a number may not begin with 0");
  if (here() == '.') {
    const std::size_t fraction = ++at_;
    skip_digits();
    if (at_ == fraction) return fail("digits are expected behind the point");
  }
  if (here() == 'e' || here() == 'E') {
    ++at_;
    if (here() == '-' || here() == '+') ++at_;
    const std::size_t exponent = at_;
    skip_digits();
    if (at_ == exponent) return fail("digits are expected in the exponent");
  }
  push(JsonType::number, begin, at_);
  return true;
}

bool PieceIndexer::literal(std::string_view word, JsonType type) {
  if (text_.substr(at_, word.size()) != word) return fail("a value is expected here");
  push(type, at_, at_ + word.size());
  at_ += word.size();
  return true;
}

bool PieceIndexer::open(JsonType type) {
  if (piece_.open.size() == JsonDocument::kMaxDepth) return fail("values are nested too deep");
  piece_.open.push_back(static_cast<std::uint32_t>(piece_.entries.size()));
  if (piece_.open.size() > piece_.closes.size() + piece_.deepest)
    piece_.deepest = piece_.open.size() - piece_.closes.size();
  push(type, at_++, 0);
  in_ = type == JsonType::object ? In::object : In::array;
  skip_space();
  const bool empty = here() == (type == JsonType::object ? '}' : ']');
  opened_ = !empty;
  return !empty || close(here());
}

bool PieceIndexer::close(char c) {
  const JsonType type = c == '}' ? JsonType::object : JsonType::array;
  if (piece_.open.empty()) return close_outer(type);
  JsonEntry& opened = piece_.entries[piece_.open.back()];
  if (opened.type != type) return fail("this closes nothing that is open");
  opened.end = static_cast<std::uint32_t>(++at_);
  opened.next = static_cast<std::uint32_t>(piece_.entries.size());
  piece_.open.pop_back();
  const bool object =
      !piece_.open.empty() && piece_.entries[piece_.open.back()].type == JsonType::object;
  in_ = piece_.open.empty() ? outer_ : object ? In::object : In::array;
  return true;
}

bool PieceIndexer::close_outer(JsonType type) {
  const In expected = type == JsonType::object ? In::object : In::array;
  if (outer_ != expected && outer_ != In::unknown) return fail("this closes nothing that is open");
  piece_.closes.push_back(
      {type, static_cast<std::uint32_t>(++at_), static_cast<std::uint32_t>(piece_.entries.size())});
  in_ = outer_ = In::unknown;
  return true;
}

/// Determines what encloses the fragment: an item of an object begins with a key.
void PieceIndexer::find_enclosing_container() {
  const std::size_t begin = at_, entries = piece_.entries.size();
  bool is_key = here() == '"' && string();
  skip_space();
  is_key = is_key && here() == ':';
  in_ = outer_ = is_key ? In::object : In::array;
  at_ = begin;
  piece_.entries.resize(entries);
  piece_.message = nullptr;  // the item itself will meet the fault again
}

bool PieceIndexer::key() {
  if (here() != '"') return fail("a key in quotes is expected here");
  if (!string()) return false;
  skip_space();
  if (here() != ':') return fail("a colon is expected behind the key");
  ++at_;
  skip_space();
  if (at_ < text_.size()) return true;
  piece_.behind_comma = true;
  return false;
}

bool PieceIndexer::value() {
  switch (text_[at_]) {
    case '{':
      return open(JsonType::object);
    case '[':
      return open(JsonType::array);
    case '"':
      return string();
    case 't':
      return literal("true", JsonType::boolean);
    case 'f':
      return literal("false", JsonType::boolean);
    case 'n':
      return literal("null", JsonType::null);
    default:
      return number();
  }
}

bool PieceIndexer::item() {
  opened_ = false;
  skip_space();
  piece_.behind_comma = at_ == text_.size();
  if (piece_.behind_comma) return false;
  if (in_ == In::unknown) find_enclosing_container();
  return (in_ != In::object || key()) && value();
}

/// Reads what may come between two items: the ends of arrays and objects, and a comma.
bool PieceIndexer::after_item() {
  while (true) {
    skip_space();
    if (at_ == text_.size()) return false;
    const char c = text_[at_];
    if (in_ == In::document) return fail("something follows behind the document");
    if (c == ',') {
      ++at_;
      return true;
    }
    if (c != '}' && c != ']') return fail("a comma or the end of the list is expected here");
    if (!close(c)) return false;
  }
}

JsonFragment PieceIndexer::run() {
  while (item() && (opened_ || after_item())) {
  }
  piece_.at = at_;
  if (outer_ == In::array) piece_.outer = JsonType::array;
  if (outer_ == In::object) piece_.outer = JsonType::object;
  return std::move(piece_);
}

/// Indexes text[begin, end).
JsonFragment index_json_fragment(std::string_view text, std::size_t begin, std::size_t end) {
  using In = PieceIndexer::In;
  return PieceIndexer(text, begin, end, begin == 0 ? In::document : In::unknown).run();
}

}  // namespace

/// Joins what one piece of a document opened to what a later one closed. Returns false if the
/// pieces are no document.
class FragmentJoiner {
 public:
  explicit FragmentJoiner(JsonDocument& document) : document_(document) {}

  bool add(const JsonFragment& fragment, std::size_t piece) {
    if (open_.size() + fragment.deepest > JsonDocument::kMaxDepth) return false;
    const std::uint32_t base = document_.first_of_piece(piece);
    for (const JsonFragment::Close& close : fragment.closes) {
      if (!top_is(close.type)) return false;
      JsonEntry& opened = top();
      opened.end = close.text_end;
      opened.next = base + close.entries - document_.first_of_its_piece(open_.back());
      open_.pop_back();
    }
    if (fragment.outer != JsonType::absent && !top_is(fragment.outer)) return false;
    for (const std::uint32_t entry : fragment.open) open_.push_back(base + entry);
    return true;
  }
  [[nodiscard]] bool is_complete() const { return open_.empty(); }

 private:
  [[nodiscard]] JsonEntry& top() {
    const std::uint32_t entry = open_.back();
    return document_
        .pieces_[entry >> document_.shift_][entry - document_.first_of_its_piece(entry)];
  }
  [[nodiscard]] bool top_is(JsonType type) const {
    return !open_.empty() && document_.at(open_.back()).type == type;
  }

  JsonDocument& document_;
  std::vector<std::uint32_t> open_;  ///< what earlier pieces left open, outermost first
};

namespace {

using Fragments = std::vector<JsonFragment>;

Error invalid(const char* message, std::size_t at) {
  return {ErrorCode::input, fmt::format("is not valid JSON: {}", message),
          fmt::format("byte {}", at), "copy or export the file again"};
}

Result<Fragments> index_pieces(std::string_view text, std::size_t piece_bytes,
                               const parallel::Context& context) {
  const Result<std::vector<std::size_t>> cuts = json_split_points(text, piece_bytes, context);
  if (!cuts) return cuts.error();
  return parallel::transform(
      context, {.name = "index glTF text", .n = cuts->size() + 1}, [&](std::size_t k) {
        return index_json_fragment(text, k == 0 ? 0 : (*cuts)[k - 1],
                                   k == cuts->size() ? text.size() : (*cuts)[k]);
      });
}

/// Returns the first fault of a single fragment, which begins and ends as the text does.
std::optional<Error> fault_of(const JsonFragment& only) {
  if (only.message != nullptr) return invalid(only.message, only.at);
  if (only.behind_comma || !only.open.empty()) return invalid("the text ends too early", only.at);
  return std::nullopt;
}

}  // namespace

std::optional<JsonDocument> JsonDocument::parse_items(std::string_view items, std::size_t depth) {
  if (items.size() >= std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  JsonFragment fragment = PieceIndexer(items, 0, items.size(), PieceIndexer::In::array).run();
  const bool good = fragment.message == nullptr && fragment.closes.empty() &&
                    fragment.open.empty() && !fragment.behind_comma &&
                    fragment.deepest + depth <= kMaxDepth;
  if (!good) return std::nullopt;
  JsonDocument document;
  document.text_ = items;
  std::vector<std::vector<JsonEntry>> pieces;
  pieces.push_back(std::move(fragment.entries));
  if (!document.adopt(std::move(pieces))) return std::nullopt;
  return document;
}

Result<JsonDocument> JsonDocument::parse(std::string_view text, const parallel::Context& context,
                                         std::size_t piece_bytes) {
  if (text.size() >= std::numeric_limits<std::uint32_t>::max())
    return invalid("more than 4 GiB of text", 0);
  Result<Fragments> pieces = index_pieces(text, piece_bytes, context);
  if (!pieces) return pieces.error();
  if (pieces->size() == 1)
    if (std::optional<Error> fault = fault_of(pieces->front())) return *std::move(fault);

  JsonDocument document;
  document.text_ = text;
  std::vector<std::vector<JsonEntry>> entries;
  entries.reserve(pieces->size());
  for (JsonFragment& piece : *pieces) entries.push_back(std::move(piece.entries));
  bool good = document.adopt(std::move(entries)) && !pieces->back().behind_comma;
  FragmentJoiner joiner(document);
  for (std::size_t k = 0; k < pieces->size() && good; ++k)
    good = (*pieces)[k].message == nullptr && joiner.add((*pieces)[k], k);
  if (good && joiner.is_complete()) return document;
  if (pieces->size() == 1) return invalid("it has too many values", 0);
  // As one fragment the text is parsed in order, and the error says where the fault is.
  return parse(text, context, std::max<std::size_t>(text.size(), 1));
}

}  // namespace strake::io::gltf
