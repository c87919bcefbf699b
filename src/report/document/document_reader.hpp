// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "report/json/json_reader.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/grid.hpp"

/// Reads the fields of a document, with errors that name the place.
namespace strake::report {

/// What is wrong with a document and where in it; thrown, and caught where the file's name is
/// known.
struct DocumentFault {
  std::string where, what;
  bool edited = false;  ///< no run wrote it so: something was changed since
};

/// Returns the fault of a document that says two things which exclude each other.
[[nodiscard]] inline DocumentFault contradiction(std::string where, std::string what) {
  return {std::move(where), std::move(what), true};
}

[[nodiscard]] inline DocumentFault missing_key(const std::string& where, std::string_view key) {
  return {where, "has no \"" + std::string(key) + "\""};
}

[[nodiscard]] inline DocumentFault wrong_type(const std::string& where, std::string_view key,
                                              const char* what) {
  return {where, "\"" + std::string(key) + "\" is no " + what};
}

/// Returns the value of an enumeration that has this name; name(value) is empty beyond the last.
template <class Enum, class Name>
std::optional<Enum> enum_by_name(std::string_view text, Name&& name) {
  for (std::uint8_t i = 0; !name(static_cast<Enum>(i)).empty(); ++i)
    if (name(static_cast<Enum>(i)) == text) return static_cast<Enum>(i);
  return std::nullopt;
}

/// Reads values that must be of some kind; `where` and `key` are what a DocumentFault names.
class DocumentFields {
 public:
  /// The largest number of a drawing. Nothing can be placed farther out than geometry::kMaxGridMm;
  /// where placed bodies meet sections and limits, twice that is plenty.
  static constexpr double kFarthestMm = 2 * geometry::kMaxGridMm;

  explicit DocumentFields(JsonReader& json) : json_(json) {}

  void must_be(JsonReader::Kind kind, const std::string& where, std::string_view key,
               const char* what) {
    if (json_.kind() != kind) throw wrong_type(where, key, what);
  }

  [[nodiscard]] std::string text(const std::string& where, std::string_view key) {
    must_be(JsonReader::Kind::string, where, key, "text");
    return std::string(json_.text());
  }

  [[nodiscard]] double number(const std::string& where, std::string_view key) {
    const double value = json_.kind() == JsonReader::Kind::number ? json_.number() : HUGE_VAL;
    if (!(std::fabs(value) <= kFarthestMm)) throw wrong_type(where, key, "number that makes sense");
    return value;
  }

  /// Reads a whole number from 0 on.
  [[nodiscard]] std::uint64_t count(const std::string& where, std::string_view key) {
    const double value = number(where, key);
    if (!(value >= 0) || value != std::floor(value)) throw wrong_type(where, key, "whole number");
    return static_cast<std::uint64_t>(value);
  }

  /// Reads so many numbers up to `farthest`; where() is called only where something is wrong.
  template <std::size_t N, class Where>
  [[nodiscard]] std::array<double, N> numbers(Where&& where, std::string_view key,
                                              double farthest) {
    if (json_.kind() != JsonReader::Kind::array) throw wrong_type(where(), key, "point");
    std::array<double, N> values{};
    std::size_t k = 0;
    json_.items([&] {
      const double value = json_.kind() == JsonReader::Kind::number ? json_.number() : HUGE_VAL;
      if (!(std::fabs(value) <= farthest) || k >= N) throw wrong_type(where(), key, "point");
      values.at(k++) = value;
    });
    if (k != N) throw wrong_type(where(), key, "point");
    return values;
  }

 private:
  JsonReader& json_;
};

/// The advice that errors about a kind of document give.
struct DocumentKind {
  std::string_view writer;  ///< "strake clash -o FILE.json"
  std::string_view again;   ///< "run the test again"
};

[[nodiscard]] Error document_error(const std::string& name, const DocumentKind& kind,
                                   const JsonReader::Fault& fault);
[[nodiscard]] Error document_error(const std::string& name, const DocumentKind& kind,
                                   const DocumentFault& fault);

/// Opens a document. Errors: input for a folder and for what cannot be opened.
[[nodiscard]] Result<std::ifstream> open_document(const std::filesystem::path& file);

/// Runs a function that reads a document; what it throws becomes an error that names the file.
template <class Read>
[[nodiscard]] Status read_guarded(const std::string& name, const DocumentKind& kind, Read&& read) {
  try {
    std::forward<Read>(read)();
  } catch (const DocumentFault& fault) {
    return document_error(name, kind, fault);
  } catch (const JsonReader::Fault& fault) {
    return document_error(name, kind, fault);
  }
  return {};
}

}  // namespace strake::report
