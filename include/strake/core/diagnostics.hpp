// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Messages about the input that a run noticed and survived.
namespace strake {

enum class Severity : std::uint8_t { note, warning, skipped };

/// One thing that a run noticed about its input and survived.
///
/// `code` is a stable identifier in kebab-case ("rvm-nonfinite-matrix") that scripts may match;
/// a diagnostic of severity `skipped` means that the named thing is absent from the model.
struct Diagnostic {
  Severity severity = Severity::warning;
  std::string code;
  std::string message;
  std::string where;  ///< file with line or byte offset, or the object
};

/// The diagnostics of a run, in the order of the input: every one is counted, the first
/// `kMaxPerCode` of each code are kept word for word, so a hostile file cannot fill the memory.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxPerCode = 100;

  struct Count {
    std::string code;
    Severity severity = Severity::warning;
    std::uint64_t count = 0;
  };

  void add(Diagnostic diagnostic);
  void add(Severity severity, std::string_view code, std::string message, std::string where);
  /// Appends the diagnostics of another run, as if they had been added here one by one.
  void append(const Diagnostics& other);
  /// Counts more of a code of which as many as may be are kept word for word; of others, none.
  void count_more(std::string_view code, std::uint64_t more);
  /// Takes out all of one code.
  void remove(std::string_view code);

  [[nodiscard]] const std::vector<Diagnostic>& kept() const { return kept_; }
  /// Returns one entry per code, in order of first appearance.
  [[nodiscard]] const std::vector<Count>& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t count(std::string_view code) const;
  [[nodiscard]] std::uint64_t skipped() const;

 private:
  Count& entry(std::string_view code, Severity severity);
  std::vector<Diagnostic> kept_;
  std::vector<Count> counts_;
};

/// Whether a text can be a `code`: words of small letters and digits with hyphens between them, not
/// too long. What others wrote is to be asked, since scripts and terminals are shown codes as they
/// are.
[[nodiscard]] bool is_code(std::string_view text);

/// Returns how every output spells a severity: "note", "warning", "skipped".
[[nodiscard]] std::string_view severity_name(Severity severity);

}  // namespace strake
