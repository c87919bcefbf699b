// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "report/json_reader.hpp"
#include "report/object_table.hpp"
#include "strake/clash/identity.hpp"
#include "strake/core/base64.hpp"

namespace strake::report {
namespace {

using Json = nlohmann::json;
using Kind = JsonReader::Kind;

/// No part of the schema is nested more deeply.
constexpr int kMaxDepth = 12;
constexpr std::string_view kSchemaVersion = "2";

/// What is wrong with a document and where in it; caught where the file's name is known.
struct Fault {
  std::string where, what;
};

Fault lacks(const std::string& where, std::string_view key) {
  return {where, "has no \"" + std::string(key) + "\""};
}

Fault is_not(const std::string& where, std::string_view key, const char* what) {
  return {where, "\"" + std::string(key) + "\" is no " + what};
}

// The small parts of a document, as trees.

const Json& member(const Json& object, const char* key, const std::string& where) {
  const auto it = object.find(key);
  if (it == object.end()) throw lacks(where, key);
  return *it;
}

std::string text(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_string()) throw is_not(where, key, "text");
  return value.get<std::string>();
}

double number(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number()) throw is_not(where, key, "number");
  return value.get<double>();
}

std::vector<std::uint8_t> bytes(std::string_view base64, const char* key,
                                const std::string& where) {
  auto parsed = parse_base64(base64);
  if (!parsed) throw is_not(where, key, "base64");
  return std::move(*parsed);
}

void read_matrix(const Json& json, DocumentTest& t, const std::string& where) {
  t.has_matrix = true;
  for (const Json& cell : member(json, "cells", where)) {
    const Json settings = cell.contains("settings") ? cell["settings"] : Json("not checked");
    t.settings["matrix, " + text(cell, "a", where) + " and " + text(cell, "b", where)] =
        settings.dump();
  }
}

/// Of a model with so many elements.
DocumentTest read_test(const Json& json, std::size_t elements, const std::string& where) {
  if (!json.is_object()) throw Fault{where, "is no object"};
  DocumentTest t;
  t.name = text(json, "name", where);
  const Json& settings = member(json, "settings", where);
  if (!settings.is_object()) throw is_not(where, "settings", "object");
  t.settings["curves"] = "false";  // what older results do not say
  for (const auto& [key, value] : settings.items()) t.settings[key] = value.dump();
  t.clearance_mm = number(settings, "clearance_mm", where);
  t.touch_gap_mm = number(settings, "touch_gap_mm", where);
  const Json& tested = member(json, "tested", where);
  if (!tested.is_object()) throw is_not(where, "tested", "object");
  t.in_a = bytes(text(tested, "a", where), "a", where);
  t.in_b = bytes(text(tested, "b", where), "b", where);
  const std::size_t size = (elements + 7) / 8;
  if (t.in_a.size() != size || t.in_b.size() != size)
    throw Fault{where, "\"tested\" does not go with \"elements\""};
  t.within_files = member(tested, "within_files", where) == Json(true);
  for (const Json& rule : member(json, "exempted", where))
    t.exempted_pairs += static_cast<std::uint64_t>(std::max(0.0, number(rule, "pairs", where)));
  if (json.contains("matrix")) read_matrix(json["matrix"], t, where);
  return t;
}

std::vector<std::uint64_t> read_elements(std::string_view base64) {
  const std::vector<std::uint8_t> raw = bytes(base64, "elements", "the document");
  if (raw.size() % 8 != 0) throw Fault{"the document", "\"elements\" is cut off"};
  std::vector<std::uint64_t> elements;
  elements.reserve(raw.size() / 8);
  for (std::size_t i = 0; i < raw.size(); i += 8) {
    std::uint64_t hash = 0;
    for (unsigned k = 0; k < 8; ++k) hash |= std::uint64_t{raw[i + k]} << (8 * k);
    elements.push_back(hash);
  }
  if (!std::ranges::is_sorted(elements))
    throw Fault{"the document", "\"elements\" are not in order"};
  return elements;
}

/// What a pair of a list says of itself, result or exempted.
struct Entry {
  std::optional<Hash128> key;
  std::optional<std::uint32_t> test, a, b, rule;
  std::optional<clash::Class> cls;
  std::optional<double> d_mm;
  std::uint32_t regions = 0;
};

/// Takes the pairs of a list one by one.
class EntryReader {
 public:
  EntryReader(JsonReader& json, ClashDocument& document)
      : json_(json), document_(document), objects_(document) {}

  /// Each pair of the list `section`, which comes next: take(entry). A pair's rule is its member
  /// `rule`.
  template <class Take>
  void each(const char* section, const char* rule, Take&& take) {
    if (json_.kind() != Kind::array) throw is_not("the document", section, "list");
    section_ = section;
    rule_ = rule;
    at_ = 0;
    json_.items([&] {
      if (json_.kind() != Kind::object) throw Fault{where(), "is no object"};
      Entry entry;
      json_.members([&](std::string_view key) { take_member(key, entry); });
      take(entry);
      ++at_;
    });
  }

  /// The value of a member that every pair must have.
  template <class T>
  [[nodiscard]] T must(const std::optional<T>& value, std::string_view key) const {
    if (!value) throw lacks(where(), key);
    return *value;
  }

 private:
  [[nodiscard]] std::string where() const {
    return std::string(section_) + "[" + std::to_string(at_) + "]";
  }

  void take_member(std::string_view key, Entry& entry) {
    if (key == "a")
      entry.a = object("a");
    else if (key == "b")
      entry.b = object("b");
    else if (key == "test")
      entry.test = whole("test", "number of a test");
    else if (key == "key")
      entry.key = pair_key();
    else if (key == "class")
      entry.cls = pair_class();
    else if (key == "d_mm")
      entry.d_mm = distance();
    else if (key == rule_)
      entry.rule = rule();
    else if (key == "region_count" && json_.kind() != Kind::null)
      entry.regions = whole("region_count", "number of places");
    else
      json_.skip();
  }

  std::string_view text(const char* key) {
    if (json_.kind() != Kind::string) throw is_not(where(), key, "text");
    return json_.text();
  }

  double distance() {
    const double d = json_.kind() == Kind::number ? json_.number() : HUGE_VAL;
    if (!std::isfinite(d)) throw is_not(where(), "d_mm", "number");
    return d;
  }

  std::uint32_t whole(const char* key, const char* what) {
    const double value = json_.kind() == Kind::number ? json_.number() : -1;
    if (value < 0 || value > 0xffffffffU || value != std::floor(value))
      throw is_not(where(), key, what);
    return static_cast<std::uint32_t>(value);
  }

  Hash128 pair_key() {
    const auto key = clash::parse_key(text("key"));
    if (!key) throw is_not(where(), "key", "key of a pair");
    return *key;
  }

  clash::Class pair_class() {
    using enum clash::Class;
    const std::string_view said = text("class");
    for (const clash::Class cls : {contact, hit, clearance_violation})
      if (said == clash::name(cls)) return cls;
    throw is_not(where(), "class", "class of a result");
  }

  std::uint32_t rule() {
    const std::string_view name = text(rule_);
    if (name.empty()) return 0;
    const auto at = rules_.find(name);
    if (at != rules_.end()) return at->second;
    const auto number = static_cast<std::uint32_t>(document_.rules.size());
    document_.rules.emplace_back(name);
    rules_.emplace(name, number);
    return number;
  }

  std::uint32_t object(const char* side) {
    if (json_.kind() != Kind::object) throw is_not(where(), side, "object");
    constexpr std::array<const char*, 3> kKeys{"id", "name", "file"};
    std::array<bool, kKeys.size()> there{};
    json_.members([&](std::string_view key) {
      for (std::size_t i = 0; i < kKeys.size(); ++i)
        if (key == kKeys[i]) {
          texts_[i] = text(kKeys[i]);
          there[i] = true;
          return;
        }
      json_.skip();
    });
    for (std::size_t i = 0; i < kKeys.size(); ++i)
      if (!there[i]) throw lacks(where(), kKeys[i]);
    return objects_.number({texts_[0], texts_[1], texts_[2]});
  }

  JsonReader& json_;
  ClashDocument& document_;
  ObjectTable objects_;
  std::map<std::string, std::uint32_t, std::less<>> rules_;
  std::array<std::string, 3> texts_;  ///< of the object being read
  const char* section_ = "";
  const char* rule_ = "";
  std::size_t at_ = 0;
};

/// Results and exempted pairs are taken as they come; the rest is small, or skipped.
class Reader {
 public:
  Reader(std::istream& in, ClashDocument& document)
      : json_(in, kMaxDepth), entries_(json_, document), document_(document) {}

  void read() {
    if (json_.kind() == Kind::object)
      json_.members([this](std::string_view key) { section(key); });
    else
      json_.skip();
    json_.end();
    if (!has_version_) throw Fault{"the document", "is no result of a clash run"};
    for (const auto& [key, there] :
         {std::pair("elements", elements_.has_value()), std::pair("tests", tests_.has_value()),
          std::pair("results", has_results_), std::pair("hash", has_hash_)})
      if (!there) throw lacks("the document", key);
    document_.elements = read_elements(*elements_);
    tests();
    results();
    document_.exempted = by_key(exempted_);
    not_compared();
  }

 private:
  /// A pair of a list that is no result, or of what was not compared an object alone.
  struct Listed {
    std::uint32_t test = 0, a = 0, b = 0, rule = 0;
  };

  void section(std::string_view key) {
    if (key == "schema_version")
      version();
    else if (key == "elements")
      elements_ = text("elements");
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
    else
      json_.skip();
  }

  std::string_view text(const char* key) {
    if (json_.kind() != Kind::string) throw is_not("the document", key, "text");
    return json_.text();
  }

  /// At once: results of other versions look otherwise.
  void version() {
    std::string said;
    json_.copy(said);
    if (said != kSchemaVersion)
      throw Fault{"the document", "is no clash result of schema version " +
                                      std::string(kSchemaVersion) + ": it says version " + said};
    has_version_ = true;
  }

  void made_by() {
    if (json_.kind() != Kind::object) throw is_not("the document", "rules", "object");
    json_.members([this](std::string_view key) {
      if (key == "file")
        document_.made_by.file = text("file");
      else if (key == "hash")
        document_.made_by.hash = text("hash");
      else
        json_.skip();
    });
  }

  void take_results() {
    has_results_ = true;
    entries_.each("results", "allowed", [this](const Entry& e) {
      DocumentResult r;
      r.key = entries_.must(e.key, "key");
      r.test = entries_.must(e.test, "test");
      r.a = entries_.must(e.a, "a");
      r.b = entries_.must(e.b, "b");
      r.cls = entries_.must(e.cls, "class");
      r.d_mm = entries_.must(e.d_mm, "d_mm");
      r.rule = e.rule.value_or(0);
      r.regions = e.regions;
      document_.results.push_back(r);
    });
  }

  void take_exempted() {
    document_.lists_exempted = true;
    entries_.each("exempted", "rule", [this](const Entry& e) {
      exempted_.push_back({entries_.must(e.test, "test"), entries_.must(e.a, "a"),
                           entries_.must(e.b, "b"), entries_.must(e.rule, "rule")});
    });
  }

  void take_not_compared() {
    entries_.each("not_compared", "code", [this](const Entry& e) {
      const Listed pair{entries_.must(e.test, "test"), entries_.must(e.a, "a"), e.b.value_or(0),
                        entries_.must(e.rule, "code")};
      (e.b ? pairs_not_compared_ : lacking_).push_back(pair);
    });
  }

  void tests() {
    const Json list = Json::parse(*tests_);
    if (!list.is_array()) throw is_not("the document", "tests", "list");
    for (std::size_t t = 0; t < list.size(); ++t)
      document_.tests.push_back(
          read_test(list[t], document_.elements.size(), "tests[" + std::to_string(t) + "]"));
  }

  void results() {
    std::vector<DocumentResult>& all = document_.results;
    std::ranges::sort(all, {}, &DocumentResult::key);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto named = [&] { return "result " + clash::key_text(all[i].key); };
      if (all[i].test >= document_.tests.size()) throw Fault{named(), "is of no test"};
      if (i > 0 && all[i].key == all[i - 1].key) throw Fault{named(), "stands there twice"};
    }
  }

  /// Pairs of a list by the keys that their results would have.
  [[nodiscard]] std::vector<DocumentExempted> by_key(const std::vector<Listed>& list) const {
    std::vector<DocumentExempted> pairs;
    pairs.reserve(list.size());
    for (const Listed& e : list) {
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
    for (const Listed& e : lacking_) {
      static_cast<void>(test_of(e));
      const DocumentObject& a = document_.objects[e.a];
      document_.lacking.push_back({clash::element_hash(a.file, a.id), e.test, e.rule});
    }
    std::ranges::sort(document_.lacking, {}, [](const DocumentLacking& l) {
      return std::tuple(l.element, l.test, l.code);
    });
  }

  [[nodiscard]] const DocumentTest& test_of(const Listed& e) const {
    if (e.test >= document_.tests.size())
      throw Fault{"an exempted pair or what was not compared", "is of no test"};
    return document_.tests[e.test];
  }

  JsonReader json_;
  EntryReader entries_;
  ClashDocument& document_;
  std::optional<std::string> elements_, tests_;
  std::vector<Listed> exempted_, pairs_not_compared_, lacking_;
  bool has_version_ = false, has_results_ = false, has_hash_ = false;
};

Error unreadable(const std::string& file, const JsonReader::Fault& fault) {
  const bool cut = fault.what == JsonReader::Fault::What::cut;
  return {ErrorCode::input, cut ? "the file ends too soon" : "this is no JSON",
          file + ":" + std::to_string(fault.line),
          cut ? "it was cut off: run the test again or copy the file anew"
              : "give a file that 'strake clash -o FILE.json' wrote"};
}

Error no_document(const std::string& file, const Fault& fault) {
  return {ErrorCode::input, fault.where + " " + fault.what, file,
          "give a file that 'strake clash -o FILE.json' of this version wrote"};
}

}  // namespace

Result<ClashDocument> parse_clash_document(std::istream& in, const std::string& name) {
  ClashDocument document;
  document.name = name;
  try {
    Reader(in, document).read();
  } catch (const Fault& fault) {
    return no_document(name, fault);
  } catch (const JsonReader::Fault& fault) {
    if (fault.what == JsonReader::Fault::What::deep)
      return no_document(name, {"the document", "is nested too deeply"});
    return unreadable(name, fault);
  } catch (const Json::exception&) {
    // What the text is made of was checked before: a value that is none the schema has.
    return no_document(name, {"the document", "has \"tests\" that cannot be read"});
  }
  return document;
}

Result<ClashDocument> read_clash_document(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return Error{ErrorCode::input, "is a folder", name, "name a file in it"};
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{ErrorCode::input, "cannot be opened", name, "does it exist?"};
  return parse_clash_document(in, name);
}

}  // namespace strake::report
