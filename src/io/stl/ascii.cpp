// SPDX-License-Identifier: Apache-2.0
#include "io/stl/ascii.hpp"

#include <algorithm>
#include <utility>

#include "core/text_encoding.hpp"
#include "io/source/text_decoder.hpp"

namespace strake::io::stl {
namespace {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Compares keywords, which are written in any case.
bool is_word(std::string_view text, std::string_view word) {
  return text.size() == word.size() && std::equal(text.begin(), text.end(), word.begin(),
                                                  [](char a, char b) { return lower(a) == b; });
}

std::string_view read_word(std::string_view& line) {
  line = trimmed(line, kBlanks);
  const std::size_t length = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view word = line.substr(0, length);
  line = trimmed(line.substr(length), kBlanks);
  return word;
}

class AsciiParser {
 public:
  void line(std::string_view line);
  /// Handles what is left of a line that does not end.
  void cut_line(std::string_view line);
  std::vector<Solid> take();
  void next_line() { ++line_; }

 private:
  Solid& solid() {
    if (!open_) begin("");
    return solids_.back();
  }
  void begin(std::string_view name);
  void vertex(std::string_view rest);
  void end_loop();
  void cut_off();
  void end_solid();
  void damaged(const char* message) {
    if (!solid().damage) solid().damage = StlDamage{message, line_};
    bad_facet_ = true;
  }
  [[nodiscard]] bool in_facet() const { return loop_corners_ != 0 || bad_facet_; }

  std::vector<Solid> solids_;
  std::uint64_t line_ = 1;
  bool open_ = false;
  std::size_t loop_corners_ = 0;  ///< corners of the loop that is being read
  bool bad_facet_ = false;        ///< it is to be left out
};

void AsciiParser::begin(std::string_view name) {
  cut_off();
  solids_.emplace_back().name = TextDecoder()(name);
  open_ = true;
}

void AsciiParser::vertex(std::string_view rest) {
  Solid& owner = solid();
  const char* at = rest.data();
  const char* const end = at + rest.size();
  geometry::Vec3d point;
  for (int axis = 0; axis < 3; ++axis) {
    skip_blanks(at, end);
    if (!read_number(at, end, point[axis], owner.digits) || (at != end && !is_blank(*at)) ||
        !is_coordinate(point[axis]))
      return damaged("a vertex needs three finite numbers");
  }
  owner.corners.push_back(point);
  ++loop_corners_;
}

void AsciiParser::end_loop() {
  if (loop_corners_ != 3 && !bad_facet_) damaged("a facet needs three corners");
  if (bad_facet_) {
    solid().corners.resize(solid().corners.size() - loop_corners_);
    ++solid().bad_facets;
  }
  loop_corners_ = 0;
  bad_facet_ = false;
}

void AsciiParser::end_solid() {
  if (in_facet()) {
    damaged("it ends within a facet");
    end_loop();
  }
  open_ = false;
}

/// Handles the place where another solid begins or the file ends.
void AsciiParser::cut_off() {
  if (open_) solid().cut_off = line_;
  end_solid();
}

void AsciiParser::line(std::string_view line) {
  const std::string_view word = read_word(line);
  if (word.empty()) return;
  if (is_word(word, "vertex")) return vertex(line);
  if (is_word(word, "endloop")) return end_loop();
  if (is_word(word, "facet") || is_word(word, "outer") || is_word(word, "endfacet")) {
    static_cast<void>(solid());  // of one without a head
    if (in_facet()) end_loop();
    return;
  }
  if (is_word(word, "solid")) return begin(line);
  if (is_word(word, "endsolid")) return end_solid();
  // Some exporters add comment or colour lines; a line in the middle of a loop is damage.
  if (in_facet()) damaged("a line within a facet is not understood");
}

void AsciiParser::cut_line(std::string_view line) {
  constexpr std::string_view kHead = "solid";
  const std::string_view word = read_word(line);
  if (!open_ && !word.empty() && is_word(word, kHead.substr(0, word.size()))) begin("");
}

std::vector<Solid> AsciiParser::take() {
  cut_off();
  return std::move(solids_);
}

}  // namespace

bool is_like_ascii(std::string_view text) {
  std::string_view start = text.substr(0, 1024);
  if (start.find('\0') != std::string_view::npos) return false;
  const std::size_t begin = start.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return false;
  start.remove_prefix(begin);
  const std::size_t word_end = std::min(start.find_first_of(" \t\r\n"), start.size());
  return is_word(start.substr(0, word_end), "solid");
}

std::optional<std::vector<Solid>> parse_ascii(std::string_view text, const std::stop_token& stop) {
  constexpr std::uint64_t kStopInterval = 4096;
  AsciiParser parser;
  for (std::uint64_t count = 0; !text.empty(); ++count) {
    if (count % kStopInterval == 0 && stop.stop_requested()) return std::nullopt;
    const std::size_t length = std::min(text.find('\n'), text.size());
    parser.line(text.substr(0, length));
    if (length == text.size()) parser.cut_line(text);
    parser.next_line();
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return parser.take();
}

}  // namespace strake::io::stl
