// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_document.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "report/clash/clash_document_check.hpp"
#include "report/clash/clash_document_members.hpp"
#include "report/clash/clash_schema_version.hpp"
#include "report/document/document_reader.hpp"
#include "report/json/json_reader.hpp"

namespace strake::report {
namespace {

using Kind = JsonReader::Kind;

/// The deepest nesting of the schema.
constexpr int kMaxClashDepth = 12;

/// Reads a document: results and exempted pairs one by one; the rest is small, or skipped.
class ClashDocumentReader {
 public:
  ClashDocumentReader(std::istream& in, ClashDocument& document)
      : json_(in, kMaxClashDepth), entries_(json_, document), document_(document) {}

  void read() {
    if (json_.kind() == Kind::object)
      json_.members([this](std::string_view key) { section(key); });
    else
      json_.skip();
    json_.end();
    if (!has_version_) throw DocumentFault{"the document", "is no result of a clash run"};
    for (const auto& [key, there] :
         {std::pair("elements", elements_.has_value()), std::pair("tests", tests_.has_value()),
          std::pair("results", has_results_), std::pair("hash", has_hash_)})
      if (!there) throw missing_key("the document", key);
    document_.elements = read_elements(*elements_);
    if (sheets_) document_.sheets = read_sheets(*sheets_, document_.elements.size());
    if (positional_ids_)
      document_.positional_ids = read_positional_ids(*positional_ids_, document_.elements.size());
    document_.tests = read_tests(*tests_, document_.elements.size());
    results();
    count_exempted();
    document_.exempted = by_key(exempted_);
    not_compared();
    check_against_itself(document_);
  }

 private:
  /// A pair of a list that is no result; in the list of what was not compared, it may be an object
  /// alone.
  struct ListedPair {
    std::uint32_t test = 0, a = 0, b = 0, rule = 0;
  };

  void section(std::string_view key) {
    constexpr std::array<std::string_view, 11> kKnown{
        "schema_version", "files", "elements", "sheets",   "positional_ids", "tests",
        "hash",           "rules", "results",  "exempted", "not_compared"};
    const auto known = static_cast<std::size_t>(std::ranges::find(kKnown, key) - kKnown.begin());
    if (known < kKnown.size() && std::exchange(there_[known], true))
      throw contradiction("the document", "has \"" + std::string(key) + "\" twice");
    if (key == "schema_version")
      version();
    else if (key == "files")
      files();
    else if (key == "elements")
      elements_ = text("elements");
    else if (key == "sheets")
      sheets_ = text("sheets");
    else if (key == "positional_ids")
      positional_ids_ = text("positional_ids");
    else if (key == "tests")
      json_.copy(tests_.emplace());
    else if (key == "hash")
      document_.hash = text("hash"), has_hash_ = true;
    else if (key == "rules")
      made_by();
    else if (key == "results")
      take_results();
    else if (key == "exempted")
      take_exempted();
    else if (key == "not_compared")
      take_not_compared();
    else if (key == "classes")
      throw DocumentFault{"the document",
                          "has results of some classes only (--class), so that all others would "
                          "seem to be mended or new"};
    else
      json_.skip();
  }

  std::string_view text(const char* key) {
    if (json_.kind() != Kind::string) throw wrong_type("the document", key, "text");
    return json_.text();
  }

  /// Checks the version at once: results of other versions have another form.
  void version() {
    std::string stated;
    json_.copy(stated);
    if (stated != kClashSchemaVersion)
      throw DocumentFault{"the document", "is no clash result of schema version " +
                                              std::string(kClashSchemaVersion) +
                                              ": it says version " + stated +
                                              " (drawings are compared by 'strake draw diff')"};
    has_version_ = true;
  }

  void files() {
    if (json_.kind() != Kind::array) throw wrong_type("the document", "files", "list");
    json_.items([this] {
      if (json_.kind() != Kind::object)
        throw DocumentFault{"files", "has an entry that is no object"};
      json_.members([this](std::string_view key) {
        if (key == "label")
          document_.files.emplace_back(text("label"));
        else
          json_.skip();
      });
    });
  }

  void made_by() {
    if (json_.kind() != Kind::object) throw wrong_type("the document", "rules", "object");
    json_.members([this](std::string_view key) {
      if (key == "file")
        document_.made_by.file = text("file");
      else if (key == "hash")
        document_.made_by.hash = text("hash");
      else if (key == "profile")
        document_.made_by.profile = text("profile");
      else
        json_.skip();
    });
  }

  void take_results() {
    has_results_ = true;
    entries_.each("results", "allowed", [this](const DocumentEntry& e) {
      DocumentResult r;
      r.key = entries_.required(e.key, "key");
      r.test = entries_.required(e.test, "test");
      r.a = entries_.required(e.a, "a");
      r.b = entries_.required(e.b, "b");
      r.cls = entries_.required(e.cls, "class");
      r.d_mm = entries_.required(e.d_mm, "d_mm");
      r.point_mm = entries_.required(e.point_mm, "point_mm");
      r.rule = e.rule.value_or(0);
      r.regions = e.regions;
      r.allowed_regions = e.allowed_regions;
      r.depth_complete = e.depth_complete;
      document_.results.push_back(r);
    });
  }

  void take_exempted() {
    document_.lists_exempted = true;
    entries_.each("exempted", "rule", [this](const DocumentEntry& e) {
      exempted_.push_back({entries_.required(e.test, "test"), entries_.required(e.a, "a"),
                           entries_.required(e.b, "b"), entries_.required(e.rule, "rule")});
    });
  }

  void take_not_compared() {
    entries_.each("not_compared", "code", [this](const DocumentEntry& e) {
      const ListedPair pair{entries_.required(e.test, "test"), entries_.required(e.a, "a"),
                            e.b.value_or(0), entries_.required(e.rule, "code")};
      (e.b ? pairs_not_compared_ : lacking_).push_back(pair);
    });
  }

  void results() {
    std::vector<DocumentResult>& all = document_.results;
    std::ranges::sort(all, {}, &DocumentResult::key);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto named = [&] { return "result " + clash::key_text(all[i].key); };
      if (all[i].test >= document_.tests.size()) throw DocumentFault{named(), "is of no test"};
      if (i > 0 && all[i].key == all[i - 1].key) throw contradiction(named(), "stands there twice");
    }
  }

  /// Checks the count of exempted pairs: where they are listed, all are.
  void count_exempted() const {
    if (!document_.lists_exempted) return;
    std::vector<std::uint64_t> listed(document_.tests.size(), 0);
    for (const ListedPair& e : exempted_) {
      static_cast<void>(test_of(e));
      ++listed[e.test];
    }
    for (std::size_t t = 0; t < listed.size(); ++t)
      if (listed[t] != document_.tests[t].exempted_pairs)
        throw contradiction("tests[" + std::to_string(t) + "]",
                            "counts " + std::to_string(document_.tests[t].exempted_pairs) +
                                " exempted pairs, but \"exempted\" lists " +
                                std::to_string(listed[t]));
  }

  /// Returns the pairs of a list by the keys that their results would have.
  [[nodiscard]] std::vector<DocumentExempted> by_key(const std::vector<ListedPair>& list) const {
    std::vector<DocumentExempted> pairs;
    pairs.reserve(list.size());
    for (const ListedPair& e : list) {
      const DocumentTest& test = test_of(e);
      const DocumentObject &a = document_.objects[e.a], &b = document_.objects[e.b];
      pairs.push_back({clash::pair_hash(test.name, {a.file, a.id}, {b.file, b.id}), e.rule});
    }
    std::ranges::sort(pairs, {},
                      [](const DocumentExempted& e) { return std::pair(e.key, e.rule); });
    return pairs;
  }

  void not_compared() {
    document_.not_compared = by_key(pairs_not_compared_);
    for (const ListedPair& e : lacking_) {
      static_cast<void>(test_of(e));
      const DocumentObject& a = document_.objects[e.a];
      document_.lacking.push_back({clash::element_hash(a.file, a.id), e.test, e.rule});
    }
    std::ranges::sort(document_.lacking, {}, [](const DocumentLacking& l) {
      return std::tuple(l.element, l.test, l.code);
    });
  }

  [[nodiscard]] const DocumentTest& test_of(const ListedPair& e) const {
    if (e.test >= document_.tests.size())
      throw DocumentFault{"an exempted pair or what was not compared", "is of no test"};
    return document_.tests[e.test];
  }

  JsonReader json_;
  EntryReader entries_;
  ClashDocument& document_;
  std::optional<std::string> elements_, sheets_, positional_ids_, tests_;
  std::vector<ListedPair> exempted_, pairs_not_compared_, lacking_;
  std::array<bool, 11> there_{};  ///< sections that were found
  bool has_version_ = false, has_results_ = false, has_hash_ = false;
};

constexpr DocumentKind kClashResult{"strake clash -o FILE.json", "run the test again"};

}  // namespace

Result<ClashDocument> parse_clash_document(std::istream& in, const std::string& name) {
  ClashDocument document;
  document.name = name;
  const Status status =
      read_guarded(name, kClashResult, [&] { ClashDocumentReader(in, document).read(); });
  if (!status) return status.error();
  return document;
}

Result<ClashDocument> read_clash_document(const std::filesystem::path& file) {
  Result<std::ifstream> in = open_document(file);
  if (!in) return in.error();
  return parse_clash_document(*in, file.string());
}

}  // namespace strake::report
