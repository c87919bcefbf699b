// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace strake::report {

/// Reads a JSON text (RFC 8259) from a stream value by value, in one pass: memory does not grow
/// with the text. The caller takes the values that it wants and skips the rest, which is checked
/// all the same.
///
/// It throws Fault, and is of no use after that.
class JsonReader {
 public:
  enum class Kind : std::uint8_t { object, array, string, number, boolean, null };
  struct Fault {
    enum class What : std::uint8_t { broken, cut, deep };
    What what = What::broken;
    std::uint64_t line = 0;  ///< counted from 1
  };

  /// Values may be nested `max_depth` deep.
  JsonReader(std::istream& in, int max_depth);

  /// Returns the kind of the value that comes next.
  [[nodiscard]] Kind kind();

  /// Reads an object, which must come next: member(key) is called for each member and takes its
  /// value; `key` is valid until it begins to.
  template <class Member>
  void members(Member&& member) {
    for (bool more = open('{', '}'); more; more = next('}')) {
      read_key();
      member(std::string_view(key_));
    }
  }
  /// Reads an array, which must come next: item() is called for each item and takes it.
  template <class Item>
  void items(Item&& item) {
    for (bool more = open('[', ']'); more; more = next(']')) item();
  }

  /// Returns the string that must come next, decoded; valid until anything else is taken.
  [[nodiscard]] std::string_view text();
  /// Returns the number that must come next; infinite where no double comes near it.
  [[nodiscard]] double number();
  void skip();
  /// Appends the value as it is written, without blanks between.
  void copy(std::string& out);

  /// Checks that nothing but blanks follows.
  void end();

 private:
  [[nodiscard]] bool refill();
  [[nodiscard]] int peek();  ///< the next character, or kEnd
  [[nodiscard]] int peek_behind_blanks();
  [[nodiscard]] bool open(char bracket, char closing);
  [[nodiscard]] bool next(char closing);
  void expect(char c);
  void read_key();
  void read_escape();
  [[nodiscard]] std::uint32_t read_hex();
  [[nodiscard]] std::string_view read_number();
  [[nodiscard]] std::string_view read_word();
  /// Returns the number of line ends in the buffer up to there.
  [[nodiscard]] std::uint64_t lines_up_to(const char* at) const;
  [[noreturn]] void fail(Fault::What what) const;
  /// Fails as broken, or as cut off where the text ends here.
  [[noreturn]] void fail_at_next();

  static constexpr int kEnd = -1;

  std::istream& in_;
  std::vector<char> buffer_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  std::uint64_t lines_before_ = 0;  ///< line ends before the buffer
  std::string spilled_;             ///< a value that the buffer does not hold in its final form
  std::string key_;
  int depth_ = 0, max_depth_;
};

}  // namespace strake::report
