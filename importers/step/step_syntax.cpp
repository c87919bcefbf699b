// SPDX-License-Identifier: Apache-2.0
#include "step_syntax.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace strake::import_step {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }

/// Reads the statements of a file, each of which ends with a semicolon.
class SyntaxCheck {
 public:
  SyntaxCheck(std::string_view text, const std::filesystem::path& file)
      : text_(text), file_(file) {}
  Result<StepReferences> run();

 private:
  struct Reference {
    std::uint64_t to = 0, from = 0;
    std::size_t line = 0;
  };

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char here() const { return text_[at_]; }
  [[nodiscard]] std::string line() const { return std::to_string(line_); }
  void step() {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }
  std::optional<std::string> skip_blanks();
  std::optional<std::string> skip_string();
  std::optional<std::string> entity();
  std::optional<std::string> values(bool is_entity);
  std::uint64_t number();
  std::string_view word();
  std::optional<std::string> statement();
  StepReferences references();

  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0, line_ = 1;
  bool in_data_ = false;
  std::uint64_t entity_ = 0;
  std::vector<std::uint64_t> known_;
  std::vector<Reference> used_;
};

std::optional<std::string> SyntaxCheck::skip_blanks() {
  while (!at_end()) {
    if (is_blank(here())) {
      step();
    } else if (text_.substr(at_, 2) == "/*") {
      const std::string begin = line();
      while (!at_end() && text_.substr(at_, 2) != "*/") step();
      if (at_end()) return "the comment that begins in line " + begin + " has no end";
      at_ += 2;
    } else {
      break;
    }
  }
  return std::nullopt;
}

std::optional<std::string> SyntaxCheck::skip_string() {
  const std::string begin = line();
  ++at_;
  while (!at_end() && here() != '\'') step();
  if (at_end()) return "the text that begins in line " + begin + " has no end";
  ++at_;
  return std::nullopt;
}

/// Returns the number here; one that is too large stays the largest.
std::uint64_t SyntaxCheck::number() {
  constexpr std::uint64_t kMax = std::uint64_t{1} << 60U;
  std::uint64_t value = 0;
  for (; !at_end() && is_digit(here()); ++at_)
    value = std::min(kMax, 10 * value + static_cast<std::uint64_t>(here() - '0'));
  return value;
}

std::string_view SyntaxCheck::word() {
  const std::size_t begin = at_;
  while (!at_end() && (is_letter(here()) || is_digit(here()) || here() == '-')) ++at_;
  return text_.substr(begin, at_ - begin);
}

/// Reads the number of an entity and the sign behind it.
std::optional<std::string> SyntaxCheck::entity() {
  ++at_;
  if (at_end() || !is_digit(here())) return "line " + line() + ": '#' has no number behind it";
  entity_ = number();
  if (entity_ > INT32_MAX) return "line " + line() + ": the number of the entity is too large";
  known_.push_back(entity_);
  if (auto fault = skip_blanks()) return fault;
  if (at_end() || here() != '=')
    return "line " + line() + ": there is no '=' behind #" + std::to_string(entity_);
  ++at_;
  if (auto fault = skip_blanks()) return fault;
  if (at_end() || !(is_letter(here()) || here() == '(' || here() == '!' || here() == '&'))
    return "line " + line() + ": #" + std::to_string(entity_) + " is of no kind";
  return std::nullopt;
}

/// Reads what is before the next semicolon.
std::optional<std::string> SyntaxCheck::values(bool is_entity) {
  constexpr int kDeepest = 100;
  int depth = 0;
  const std::string begin = line();
  char last = ' ';
  while (true) {
    if (auto fault = skip_blanks()) return fault;
    if (at_end()) return "the statement that begins in line " + begin + " has no end";
    const char c = here();
    if (c == ';') break;
    last = c;
    if (c == '\'') {
      if (auto fault = skip_string()) return fault;
      continue;
    }
    ++at_;
    if (c == '(' && ++depth > kDeepest)
      return "line " + line() + ": more than 100 parentheses within each other";
    if (c == ')' && --depth < 0) return "line " + line() + ": a ')' closes nothing";
    if (c == '#' && is_entity) {
      if (at_end() || !is_digit(here())) return "line " + line() + ": '#' has no number behind it";
      used_.push_back({number(), entity_, line_});
    }
  }
  if (depth > 0) return "line " + line() + ": a '(' of this statement is not closed";
  if (is_entity && last != ')') return "line " + line() + ": the statement does not end with ')'";
  ++at_;
  return std::nullopt;
}

/// Reads a statement; what stands outside of the data is anybody's.
std::optional<std::string> SyntaxCheck::statement() {
  if (in_data_ && here() == '#') {
    if (auto fault = entity()) return fault;
    return values(true);
  }
  const std::string begin = line();
  const std::string_view name = word();
  if (in_data_ && name != "ENDSEC") return "line " + begin + ": this is no entity";
  in_data_ = name == "DATA";
  return values(false);
}

StepReferences SyntaxCheck::references() {
  std::ranges::sort(known_);
  StepReferences result;
  for (const Reference& reference : used_) {
    if (std::ranges::binary_search(known_, reference.to)) continue;
    if (result.missing++ < StepReferences::kMaxListed)
      result.listed.push_back("#" + std::to_string(reference.from) + " in line " +
                              std::to_string(reference.line) + " refers to #" +
                              std::to_string(reference.to) + ", which is not there");
  }
  return result;
}

Result<StepReferences> SyntaxCheck::run() {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  bool ended = false;
  while (!ended) {
    std::optional<std::string> fault = skip_blanks();
    if (!fault && at_end()) break;
    ended = text_.substr(at_).starts_with("END-ISO-10303-21");
    if (!fault && !ended) fault = statement();
    if (fault)
      return Error{ErrorCode::input, "the file is damaged: " + *fault, file_.string(),
                   "export it again"};
  }
  return references();
}

}  // namespace

Result<StepReferences> check_step_syntax(std::string_view text, const std::filesystem::path& file) {
  return SyntaxCheck(text, file).run();
}

}  // namespace strake::import_step
