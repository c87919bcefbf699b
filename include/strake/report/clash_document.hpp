// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"

/// Results of clash runs read back, and what changed from one to the other.
///
///     const auto old_run = report::read_clash_document("monday.json");
///     const auto new_run = report::read_clash_document("tuesday.json");
///     const report::ClashDiff diff = report::compare(*old_run, *new_run);
namespace strake::report {

/// An object as a document names it; its texts are the document's.
struct DocumentObject {
  std::string_view id, name, file;
};

struct DocumentResult {
  Hash128 key;  ///< clash::parse_key of its text
  double d_mm = 0;
  geometry::Vec3d point_mm;
  std::uint32_t test = 0;
  std::uint32_t a = 0, b = 0;         ///< of ClashDocument::objects
  std::uint32_t rule = 0;             ///< that allows it, of ClashDocument::rules
  std::uint32_t regions = 0;          ///< separate places; 0: not counted
  std::uint32_t allowed_regions = 0;  ///< places besides that a rule allows
  clash::Class cls = clash::Class::no_hit;
  bool depth_complete = true;  ///< clash::Pair::depth_complete
};

/// How many results of each class no rule allows, and how many of any class one does.
struct DocumentCounts {
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
  friend bool operator==(const DocumentCounts&, const DocumentCounts&) = default;
};

struct DocumentTest {
  std::string name;
  std::string hash;       ///< of its results, as the run gave it
  DocumentCounts counts;  ///< as the run gave them
  /// Places of results that rules allow, but not the results; none: the run did not count them.
  std::optional<std::uint64_t> allowed_places;
  /// What classes depend on, as text by name: settings, and those of the cells of a matrix.
  std::map<std::string, std::string> settings;
  double clearance_mm = 0, touch_gap_mm = 0;
  bool has_matrix = false;
  bool within_files = true;
  std::uint64_t exempted_pairs = 0;
  std::vector<std::uint8_t> in_a, in_b;  ///< bits, as in the document
};

/// The rules file that made a result; both empty: there was none.
struct DocumentRules {
  std::string file, hash;
  friend bool operator==(const DocumentRules&, const DocumentRules&) = default;
};

/// A pair that a rule left out.
struct DocumentExempted {
  Hash128 key;  ///< that its result would have
  std::uint32_t rule = 0;
};

/// An object that a test could not compare whole.
struct DocumentLacking {
  std::uint64_t element = 0;  ///< clash::element_hash
  std::uint32_t test = 0;
  std::uint32_t code = 0;  ///< of ClashDocument::rules
};

/// What a comparison needs of a document of schemas/clash.schema.json: of a result some eighty
/// bytes, of an object its texts once.
struct ClashDocument {
  std::string name;  ///< of the file, as given
  std::string hash;
  DocumentRules made_by;
  std::vector<DocumentTest> tests;
  std::vector<std::uint64_t> elements;  ///< ascending
  /// Of each of them: how many of its parts have no inside; empty: the run did not say.
  std::vector<std::uint8_t> sheets;
  /// A bit for each of them, as in the document: its id is only a position; empty: none is.
  std::vector<std::uint8_t> positional_ids;
  std::vector<DocumentObject> objects;  ///< those that are named, each once
  /// Names of rules, and codes of why something was not compared; the first, empty, stands for
  /// none.
  std::vector<std::string> rules{{}};
  std::vector<DocumentResult> results;  ///< by key
  bool lists_exempted = false;
  std::vector<DocumentExempted> exempted;      ///< by key
  std::vector<DocumentExempted> not_compared;  ///< pairs by key; "rule" is the code of why
  std::vector<DocumentLacking> lacking;        ///< by element and test
  std::vector<std::unique_ptr<char[]>> texts;  ///< what `objects` point into

  [[nodiscard]] const DocumentObject& a(const DocumentResult& r) const { return objects[r.a]; }
  [[nodiscard]] const DocumentObject& b(const DocumentResult& r) const { return objects[r.b]; }
  /// The rule that allows a result; empty: none does.
  [[nodiscard]] const std::string& allowed(const DocumentResult& r) const { return rules[r.rule]; }
};

/// Errors: input for a file that cannot be read, is cut off, is no such document, is of another
/// version of the schema, or contradicts itself; each names the line or the result.
///
/// A document contradicts itself where its tests do not have as many results of each class, places
/// that rules allow, or exempted pairs where these are listed, as they count; where a result's key
/// is not that of its test and its two objects, or one of these is not among the elements; and
/// where the hash of the document is not that of its tests. So a list that somebody shortened is no
/// mended clash. What is edited with its counts, and a d, is not seen: the hash of a test is over
/// more digits than the document has.
[[nodiscard]] Result<ClashDocument> read_clash_document(const std::filesystem::path& file);

/// The same from a stream, in one pass; `name` is what errors call it.
[[nodiscard]] Result<ClashDocument> parse_clash_document(std::istream& in, const std::string& name);

}  // namespace strake::report
