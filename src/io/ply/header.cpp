// SPDX-License-Identifier: Apache-2.0
#include "io/ply/header.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

#include "io/source/text_number.hpp"

namespace strake::io::ply {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 16> kTypes{
    {{"char", NumberType::i8},
     {"int8", NumberType::i8},
     {"uchar", NumberType::u8},
     {"uint8", NumberType::u8},
     {"short", NumberType::i16},
     {"int16", NumberType::i16},
     {"ushort", NumberType::u16},
     {"uint16", NumberType::u16},
     {"int", NumberType::i32},
     {"int32", NumberType::i32},
     {"uint", NumberType::u32},
     {"uint32", NumberType::u32},
     {"float", NumberType::f32},
     {"float32", NumberType::f32},
     {"double", NumberType::f64},
     {"float64", NumberType::f64}}};

std::optional<NumberType> type_named(std::string_view word) {
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(kLineBlanks, at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(kLineBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : text_(text) {}
  Result<Header> parse();

 private:
  /// Returns nothing where the text ends before the line does.
  std::optional<std::string_view> next_line();
  Status statement(const std::vector<std::string_view>& words);
  Status element(const std::vector<std::string_view>& words);
  Status property(const std::vector<std::string_view>& words);
  [[nodiscard]] Error fault(std::string message) const {
    return {ErrorCode::input, std::move(message), std::to_string(header_.lines),
            "export the model again"};
  }

  std::string_view text_;
  Header header_;
  bool has_format_ = false;
};

std::optional<std::string_view> HeaderParser::next_line() {
  const std::size_t end = text_.find('\n', header_.size);
  if (end == text_.npos) return std::nullopt;
  const std::string_view line = text_.substr(header_.size, end - header_.size);
  header_.size = end + 1;
  ++header_.lines;
  return line;
}

Status HeaderParser::element(const std::vector<std::string_view>& words) {
  ElementHead head;
  if (words.size() != 3) return fault("an element has a name and a count");
  head.name = words[1];
  const char* const end = words[2].data() + words[2].size();
  const auto [at, failed] = std::from_chars(words[2].data(), end, head.count);
  if (failed != std::errc() || at != end)
    return fault("the count of an element is no whole number");
  header_.elements.push_back(std::move(head));
  return {};
}

Status HeaderParser::property(const std::vector<std::string_view>& words) {
  if (header_.elements.empty()) return fault("a property belongs to no element");
  PropertyHead head;
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) return fault("a property has a type and a name");
  const std::optional<NumberType> type = type_named(words[words.size() - 2]);
  if (list) head.count_type = type_named(words[2]);
  const bool countable = head.count_type && *head.count_type < NumberType::f32;
  if (!type || (list && !countable)) return fault("a property is of no type that is known");
  head.type = *type;
  head.name = words.back();
  header_.elements.back().properties.push_back(std::move(head));
  return {};
}

Status HeaderParser::statement(const std::vector<std::string_view>& words) {
  const std::string_view word = words[0];
  if (word == "comment" || word == "obj_info") return {};
  if (word == "element") return element(words);
  if (word == "property") return property(words);
  // Some programs leave out that what they say of themselves is a comment.
  if (word != "format" && header_.elements.empty()) return {};
  if (word != "format" || words.size() != 3) return fault("is no statement of a PLY header");
  has_format_ = true;
  if (words[2] != "1.0")
    return fault(fmt::format("the version is '{}'; only 1.0 is read", words[2]));
  if (words[1] == "ascii") return {};
  if (words[1] != "binary_little_endian" && words[1] != "binary_big_endian")
    return fault("the format is neither ascii nor binary of an order that is known");
  header_.encoding =
      words[1] == "binary_little_endian" ? Encoding::little_endian : Encoding::big_endian;
  return {};
}

Result<Header> HeaderParser::parse() {
  while (const std::optional<std::string_view> line = next_line()) {
    const std::vector<std::string_view> words = words_of(*line);
    if (header_.lines == 1 || words.empty()) continue;
    if (words[0] == "end_header") {
      if (!has_format_) return fault("the header states no format");
      return std::move(header_);
    }
    if (const Status read = statement(words); !read) return read.error();
  }
  return fault("the header does not end");
}

}  // namespace

std::uint64_t ElementHead::min_bytes(Encoding encoding) const {
  if (encoding == Encoding::text) return 2 * properties.size();
  std::uint64_t bytes = 0;
  for (const PropertyHead& property : properties)
    bytes += bytes_of(property.count_type.value_or(property.type));
  return bytes;
}

bool is_ply(std::string_view text) {
  return text.starts_with("ply\n") || text.starts_with("ply\r\n");
}

Result<Header> parse_header(std::string_view text) { return HeaderParser(text).parse(); }

}  // namespace strake::io::ply
