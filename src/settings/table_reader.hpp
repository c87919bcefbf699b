// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "settings/toml_document.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::settings {

/// The state of parsing a file: its name and the first thing found wrong with it.
class ParseContext {
 public:
  explicit ParseContext(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] bool good() const { return !error_.has_value(); }
  [[nodiscard]] const Error& error() const { return *error_; }
  void fault(SourcePosition at, std::string message, std::string mend) {
    if (good()) error_ = fault_at(file_, at, std::move(message), std::move(mend));
  }
  void fault(Error error) {
    if (good()) error_ = std::move(error);
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

/// Reads the keys of a table, each by name and type. A missing key reads as nothing; a wrong type
/// is a fault of the parsing, and so is, in the end, a key that was not read.
class TableReader {
 public:
  /// `what` names the table in messages, as "[[test]]". A value that is no table is a fault.
  TableReader(ParseContext& reading, const Value& table, std::string what);
  ~TableReader() { refuse_other_keys(); }
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;
  TableReader(TableReader&&) = delete;
  TableReader& operator=(TableReader&&) = delete;

  [[nodiscard]] SourcePosition at() const { return at_; }
  [[nodiscard]] const std::string& what() const { return what_; }
  /// Adds a name to the table in messages that follow.
  void call(const std::string& name) { what_ += " '" + name + "'"; }

  /// Returns the value, whatever its type.
  const Value* value(std::string_view key);
  /// Returns the keys not read yet, which are names that the user chose, and marks all of them as
  /// read.
  std::vector<const KeyValue*> others();

  std::optional<std::string> text(std::string_view key);
  std::optional<bool> flag(std::string_view key);
  std::optional<std::int64_t> whole(std::string_view key);
  /// Reads a text with a unit, as "25mm"; 0 needs none. It lies between 0 and a kilometre.
  std::optional<double> tolerance_mm(std::string_view key);
  /// Reads a text with a unit of volume, as "5cm3"; 0 needs none.
  std::optional<double> volume_mm3(std::string_view key);
  /// Reads a text that a function of units.hpp understands; `wanted` is what to write instead of
  /// another type, as "an angle in quotes, as \"20deg\"".
  std::optional<double> quantity(std::string_view key, Result<double> (*parse)(std::string_view),
                                 std::string_view wanted);
  /// Reads a list of so many lengths, each with its unit, of any sign; `wanted` as above.
  std::optional<std::vector<double>> lengths_mm(std::string_view key, std::size_t count,
                                                std::string_view wanted);
  /// Reads a value of `key` as a length of any sign.
  std::optional<double> length_mm(const Value& value, std::string_view key);
  /// Reads one of some words.
  std::optional<std::string> word(std::string_view key, std::span<const std::string_view> words);
  /// Reads one text or a list of texts.
  std::vector<std::string> texts(std::string_view key);
  /// Read three coordinates, in millimetres where they have no unit, or three plain numbers.
  std::optional<geometry::Vec3d> point_mm(std::string_view key);
  std::optional<geometry::Vec3d> direction(std::string_view key);
  /// Return a table, or the tables of a [[list]]; empty where it is missing.
  const Value* table(std::string_view key);
  std::vector<const Value*> tables(std::string_view key);

  /// Reads the text of a key that must be there and not be empty.
  std::string required_text(std::string_view key);

 private:
  void refuse_other_keys();
  std::optional<double> coordinate_mm(const Value& value, std::string_view key);
  std::optional<double> parsed_mm(const Value& value, std::string_view key,
                                  Result<double> (*parse)(std::string_view));
  void wrong_type(const Value& value, std::string_view key, std::string_view wanted);
  template <class T>
  const T* held(std::string_view key, std::string_view wanted);
  const Array* three(std::string_view key);

  ParseContext& reading_;
  const Table* table_ = nullptr;
  SourcePosition at_;
  std::string what_;
  std::vector<bool> read_keys_;
  std::vector<std::string> known_;  ///< keys that were read, there or not
};

}  // namespace strake::settings
