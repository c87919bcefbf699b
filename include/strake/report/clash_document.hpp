// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "strake/core/result.hpp"

/// Results of clash runs read back, and what changed from one to the other.
///
///     const auto old_run = report::read_clash_document("monday.json");
///     const auto new_run = report::read_clash_document("tuesday.json");
///     const report::ClashDiff diff = report::compare(*old_run, *new_run);
namespace strake::report {

/// An object as a document names it.
struct DocumentObject {
  std::string id, name, file;
  std::uint64_t hash = 0;  ///< clash::element_hash of file and id
};

struct DocumentResult {
  std::string key;
  std::uint32_t test = 0;
  DocumentObject a, b;
  std::string cls;      ///< "HIT" …
  std::string allowed;  ///< the rule that allows it, or empty
  double d_mm = 0;
};

struct DocumentTest {
  std::string name;
  /// What classes depend on, as text by name: settings, and those of the cells of a matrix.
  std::map<std::string, std::string> settings;
  double clearance_mm = 0, touch_gap_mm = 0;
  bool has_matrix = false;
  bool within_files = true;
  std::uint64_t exempted_pairs = 0;
  std::vector<std::uint8_t> in_a, in_b;  ///< bits, as in the document
};

/// What a comparison needs of a document of schemas/clash.schema.json.
struct ClashDocument {
  std::string name;  ///< of the file, as given
  std::string hash;
  std::vector<DocumentTest> tests;
  std::vector<std::uint64_t> elements;  ///< ascending
  std::vector<DocumentResult> results;  ///< in the document's order
  bool lists_exempted = false;
  std::map<std::string, std::string> exempted;  ///< rule, by key of the pair
};

/// Errors: input for a file that cannot be read, is cut off, is no such document, is of another
/// version of the schema, or contradicts itself; each names the line or the result.
[[nodiscard]] Result<ClashDocument> read_clash_document(const std::filesystem::path& file);

/// The same from a stream that can be rewound; `name` is what errors call it.
[[nodiscard]] Result<ClashDocument> parse_clash_document(std::istream& in, const std::string& name);

}  // namespace strake::report
