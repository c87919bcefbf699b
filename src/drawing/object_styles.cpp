// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/object_styles.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "drawing/ink/hidden_ink.hpp"

// Decision 0102 says why styles are ink, and whose style a line has that several objects share.

namespace strake::drawing {

namespace {

Error fault_of_style(std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), {}, std::move(mend)};
}

/// Types 01, 02, 04, 05 and 07 of ISO 128-2. A dot is as long as it is wide, or else it is not seen
/// in print.
struct NamedLine {
  std::string_view name;
  std::vector<double> dashes;
};
std::array<NamedLine, 5> named_lines() {
  return {{{"continuous", {}},
           {"dashed", {kDash, kDashGap}},
           {"dash-dot", {24, 3, 1, 3}},
           {"dash-dot-dot", {24, 3, 1, 3, 1, 3}},
           {"dotted", {1, 3}}}};
}

constexpr double kMinDashMm = 0.01, kLongestDashMm = 1000;
constexpr std::size_t kMaxDashes = 12;

Error fault_of_text(std::string message) {
  return fault_of_style(
      std::move(message),
      "write 'color=#c00000: PIPE*', with name=, pen=0.35mm and line=dashed as you like, parted "
      "by commas");
}

/// Takes a value that one of the functions below reads into a part of a style.
template <class T>
Status take_part(std::optional<T>& into, std::string_view value,
                 Result<T> (*parse)(std::string_view)) {
  Result<T> parsed = parse(value);
  if (!parsed) return parsed.error();
  if (into) return fault_of_text(in_quotes(value) + " comes again");
  into = std::move(*parsed);
  return {};
}

Status add_part(std::string_view part, ObjectStyle& style) {
  const std::size_t equals = part.find('=');
  const std::string_view key = trimmed(part.substr(0, equals));
  if (equals == std::string_view::npos)
    return fault_of_text(in_quotes(part) + " is no part of a style");
  const std::string_view value = trimmed(part.substr(equals + 1));
  if (key == "color") return take_part(style.color, value, parse_color);
  if (key == "pen") return take_part(style.pen_mm, value, parse_pen_mm);
  if (key == "line") return take_part(style.line, value, parse_line_type);
  if (key != "name") return fault_of_text("a style has no " + in_quotes(key));
  if (!style.name.empty()) return fault_of_text(in_quotes(value) + " comes again");
  style.name = printable(value);
  return {};
}

}  // namespace

void ObjectStyles::add(ObjectStyle style, const std::vector<bool>& picked) {
  all_.push_back(std::move(style));
  for (std::size_t o = 0; o < of_object_.size(); ++o)
    if (of_object_[o] == kPlain && (picked.empty() || picked[o]))
      of_object_[o] = static_cast<std::uint16_t>(all_.size());
}

std::size_t ObjectStyles::number_of(const Line& line) const {
  const std::size_t own = number_of(line.object);
  if (own != kPlain || line.kind != hlr::EdgeKind::intersection) return own;
  return number_of(line.other);
}

double ObjectStyles::widening(std::size_t number, double edge_mm) const {
  if (number == kPlain) return 1;
  const std::optional<double>& pen = all_[number - 1].pen_mm;
  return pen && edge_mm > 0 ? *pen / edge_mm : 1;
}

Result<model::Color> parse_color(std::string_view text) {
  const Error fault = fault_of_style(in_quotes(text) + " is no colour", "write \"#rrggbb\"");
  if (text.size() != 7 || text[0] != '#') return fault;
  std::array<std::uint8_t, 3> parts{};
  for (std::size_t k = 0; k < 6; ++k) {
    const char c = text[k + 1];
    int digit = -1;
    if (c >= '0' && c <= '9') digit = c - '0';
    if (c >= 'a' && c <= 'f') digit = c - 'a' + 10;
    if (c >= 'A' && c <= 'F') digit = c - 'A' + 10;
    if (digit < 0) return fault;
    parts.at(k / 2) = static_cast<std::uint8_t>(parts.at(k / 2) * 16 + digit);
  }
  return model::Color{parts[0], parts[1], parts[2], 255};
}

Result<LineType> parse_line_type(std::string_view text) {
  for (const NamedLine& known : named_lines())
    if (known.name == text) return LineType{known.dashes, true};
  const Error fault = fault_of_style(
      in_quotes(text) + " is no type of line",
      "write continuous, dashed, dash-dot, dash-dot-dot or dotted, or the lengths of dash and gap "
      "as \"3mm 1mm\"");
  LineType line;
  for (std::string_view rest = trimmed(text); !rest.empty();) {
    const std::size_t blank = rest.find(' ');
    const Result<double> length = parse_distance_mm(rest.substr(0, blank));
    if (!length || !(*length >= kMinDashMm && *length <= kLongestDashMm)) return fault;
    line.dashes.push_back(*length);
    rest = blank == std::string_view::npos ? std::string_view() : trimmed(rest.substr(blank));
  }
  if (line.dashes.empty() || line.dashes.size() % 2 != 0 || line.dashes.size() > kMaxDashes)
    return fault;
  return line;
}

Result<double> parse_pen_mm(std::string_view text) {
  const Result<double> width = parse_distance_mm(text);
  if (width && *width >= 0.01 && *width <= 20) return *width;
  return fault_of_style(in_quotes(text) + " is no width of a pen", "write \"0.01mm\" to \"20mm\"");
}

Result<StyleText> parse_style(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos)
    return fault_of_text(in_quotes(text) + " does not say whose lines it is for");
  StyleText parsed;
  parsed.selection = trimmed(text.substr(colon + 1));
  for (std::string_view rest = text.substr(0, colon);;) {
    const std::size_t comma = rest.find(',');
    if (const Status status = add_part(rest.substr(0, comma), parsed.style); !status)
      return status.error();
    if (comma == std::string_view::npos) return parsed;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace strake::drawing
