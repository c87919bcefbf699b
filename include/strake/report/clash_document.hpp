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

/// Reads the results of clash runs back and tells what changed from one to the other.
///
///     const auto old_run = report::read_clash_document("monday.json");
///     const auto new_run = report::read_clash_document("tuesday.json");
///     const report::ClashDiff diff = report::compare(*old_run, *new_run);
namespace strake::report {

/// An object as a document names it; the document owns the texts.
struct DocumentObject {
  std::string_view id, name, file;
};

struct DocumentResult {
  Hash128 key;  ///< the clash::parse_key() of its text
  double d_mm = 0;
  geometry::Vec3d point_mm;
  std::uint32_t test = 0;
  std::uint32_t a = 0, b = 0;  ///< indices into ClashDocument::objects
  std::uint32_t rule = 0;      ///< the one that allows it, an index into ClashDocument::rules
  std::uint32_t regions = 0;   ///< separate regions; 0: not counted
  std::uint32_t allowed_regions = 0;  ///< further regions, which a rule allows
  clash::Class cls = clash::Class::no_hit;
  bool depth_complete = true;  ///< as clash::Pair::depth_complete
};

/// How many results of each class no rule allows, and how many of any class a rule allows.
struct DocumentCounts {
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
  friend bool operator==(const DocumentCounts&, const DocumentCounts&) = default;
};

struct DocumentTest {
  std::string name;
  std::string hash;       ///< the hash of its results, as the run gave it
  DocumentCounts counts;  ///< as the run gave them
  /// The contacts that the run counted but did not list: those that no rule allows, and those that
  /// one does; absent: it listed all.
  std::optional<DocumentCounts> unlisted;
  std::uint64_t not_reported = 0;  ///< results that the run found and was told not to report
  /// The number of regions that rules allow of results that they do not allow; absent: the run did
  /// not count them.
  std::optional<std::uint64_t> allowed_other_regions;
  /// What classes depend on, as text by name: settings, and those of the cells of a matrix.
  std::map<std::string, std::string> settings;
  double clearance_mm = 0, touch_gap_mm = 0;
  bool has_matrix = false;
  bool within_files = true;
  std::uint64_t exempted_pairs = 0;
  std::vector<std::uint8_t> in_a, in_b;  ///< bits, as in the document
};

/// The rules file that a result was made with; all are empty where there was none.
struct DocumentRules {
  std::string file, hash;
  std::string profile = {};  ///< the profile that it is, if it is one that the program brings along
  friend bool operator==(const DocumentRules&, const DocumentRules&) = default;
};

/// A pair that a rule left out.
struct DocumentExempted {
  Hash128 key;  ///< the key that its result would have
  std::uint32_t rule = 0;
};

/// An object that a test could not compare whole.
struct DocumentLacking {
  std::uint64_t element = 0;  ///< clash::element_hash
  std::uint32_t test = 0;
  std::uint32_t code = 0;  ///< an index into ClashDocument::rules
};

/// What a comparison needs of a document of schemas/clash.schema.json: some eighty bytes per
/// result, and the texts of an object once.
struct ClashDocument {
  std::string name;  ///< the name of the file, as given
  std::string hash;
  DocumentRules made_by;
  std::vector<std::string> files;  ///< labels of the files of its model
  std::vector<DocumentTest> tests;
  std::vector<std::uint64_t> elements;  ///< ascending
  /// How many parts of each element have no inside; empty: the run did not say.
  std::vector<std::uint8_t> sheets;
  /// A bit for each element, as in the document: its id is only a position; empty: no id is.
  std::vector<std::uint8_t> positional_ids;
  std::vector<DocumentObject> objects;  ///< the objects that are named, each once
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
  /// Returns the rule that allows a result; empty: none does.
  [[nodiscard]] const std::string& allowed(const DocumentResult& r) const { return rules[r.rule]; }
};

/// Reads a document. Errors: input for a file that cannot be read, is cut off, is no such document,
/// is of another version of the schema, or contradicts itself; each names the line or the result.
///
/// A document contradicts itself where its tests do not have as many results of each class, regions
/// that rules allow, or exempted pairs where these are listed, as they count; where a result's key
/// is not that of its test and its two objects, or one of these is not among the elements; and
/// where the hash of the document is not that of its tests. So removing a result from the list does
/// not make its clash look mended. What is edited with its counts, and a d, is not noticed: the
/// hash of a test is over more digits than the document has.
[[nodiscard]] Result<ClashDocument> read_clash_document(const std::filesystem::path& file);

/// Reads a document from a stream, in one pass; `name` is what errors call it.
[[nodiscard]] Result<ClashDocument> parse_clash_document(std::istream& in, const std::string& name);

}  // namespace strake::report
