// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_document.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "strake/clash/identity.hpp"
#include "strake/core/base64.hpp"

namespace strake::report {
namespace {

using Json = nlohmann::json;

/// No part of the schema is nested more deeply.
constexpr int kMaxDepth = 12;
constexpr int kSchemaVersion = 2;

/// What is wrong with a document and where in it; caught where the file's name is known.
struct Fault {
  std::string where, what;
};

const Json& member(const Json& object, const char* key, const std::string& where) {
  const auto it = object.find(key);
  if (it == object.end()) throw Fault{where, std::string("has no \"") + key + "\""};
  return *it;
}

std::string text(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_string()) throw Fault{where, std::string("\"") + key + "\" is no text"};
  return value.get<std::string>();
}

double number(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number()) throw Fault{where, std::string("\"") + key + "\" is no number"};
  return value.get<double>();
}

std::vector<std::uint8_t> bytes(const Json& object, const char* key, const std::string& where) {
  auto parsed = parse_base64(text(object, key, where));
  if (!parsed) throw Fault{where, std::string("\"") + key + "\" is no base64"};
  return std::move(*parsed);
}

DocumentObject object(const Json& result, const char* key, const std::string& where) {
  const Json& value = member(result, key, where);
  if (!value.is_object()) throw Fault{where, std::string("\"") + key + "\" is no object"};
  DocumentObject o{text(value, "id", where), text(value, "name", where), text(value, "file", where),
                   0};
  o.hash = clash::element_hash(o.file, o.id);
  return o;
}

std::uint32_t test_number(const Json& result, const std::string& where) {
  const Json& value = member(result, "test", where);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffU)
    throw Fault{where, "\"test\" is no number of a test"};
  return value.get<std::uint32_t>();
}

/// Takes results and exempted pairs as they come, so that they never all are JSON at a time; the
/// rest is small and becomes a tree.
class Reader {
 public:
  explicit Reader(ClashDocument& document) : document_(document) {}

  void read(std::istream& in) {
    const Json rest = Json::parse(in, [this](int depth, Json::parse_event_t event, Json& parsed) {
      return keep(depth, event, parsed);
    });
    if (!rest.is_object() || !rest.contains("schema_version"))
      throw Fault{"the document", "is no result of a clash run"};
    check_version(rest["schema_version"]);
    elements(rest);
    tests(rest);
    const Json& results = member(rest, "results", "the document");
    if (!results.is_array()) throw Fault{"the document", "\"results\" is no list"};
    document_.hash = text(rest, "hash", "the document");
    name_exempted();
    std::unordered_set<std::string_view> keys;
    for (const DocumentResult& r : document_.results) {
      if (r.test >= document_.tests.size()) throw Fault{"result " + r.key, "is of no test"};
      if (!keys.insert(r.key).second) throw Fault{"result " + r.key, "stands there twice"};
    }
  }

 private:
  bool keep(int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kMaxDepth) throw Fault{"the document", "is nested too deeply"};
    if (event == Json::parse_event_t::key && depth == 1) section_ = parsed.get<std::string>();
    // At once: results of other versions look otherwise.
    if (event == Json::parse_event_t::value && depth == 1 && section_ == "schema_version")
      check_version(parsed);
    if (event != Json::parse_event_t::object_end || depth != 2) return true;
    if (section_ == "results") {
      take_result(parsed);
      return false;
    }
    if (section_ != "exempted") return true;
    take_exempted(parsed);
    return false;
  }

  void take_result(const Json& json) {
    const std::string where = "results[" + std::to_string(document_.results.size()) + "]";
    DocumentResult r;
    r.key = text(json, "key", where);
    r.test = test_number(json, where);
    r.a = object(json, "a", where);
    r.b = object(json, "b", where);
    r.cls = text(json, "class", where);
    r.d_mm = number(json, "d_mm", where);
    if (json.contains("allowed")) r.allowed = text(json, "allowed", where);
    document_.results.push_back(std::move(r));
  }

  struct Exempted {
    std::uint32_t test = 0;
    DocumentObject a, b;
    std::string rule;
  };

  void take_exempted(const Json& json) {
    const std::string where = "exempted[" + std::to_string(exempted_.size()) + "]";
    exempted_.push_back({test_number(json, where), object(json, "a", where),
                         object(json, "b", where), text(json, "rule", where)});
  }

  static void check_version(const Json& version) {
    if (version != kSchemaVersion)
      throw Fault{"the document", "is no clash result of schema version " +
                                      std::to_string(kSchemaVersion) + ": it says version " +
                                      version.dump()};
  }

  void elements(const Json& rest) {
    const std::vector<std::uint8_t> raw = bytes(rest, "elements", "the document");
    if (raw.size() % 8 != 0) throw Fault{"the document", "\"elements\" is cut off"};
    for (std::size_t i = 0; i < raw.size(); i += 8) {
      std::uint64_t hash = 0;
      for (unsigned k = 0; k < 8; ++k) hash |= std::uint64_t{raw[i + k]} << (8 * k);
      document_.elements.push_back(hash);
    }
    if (!std::ranges::is_sorted(document_.elements))
      throw Fault{"the document", "\"elements\" are not in order"};
  }

  void tests(const Json& rest) {
    const Json& list = member(rest, "tests", "the document");
    if (!list.is_array()) throw Fault{"the document", "\"tests\" is no list"};
    for (std::size_t t = 0; t < list.size(); ++t)
      document_.tests.push_back(test(list[t], "tests[" + std::to_string(t) + "]"));
    document_.lists_exempted = rest.contains("exempted");
  }

  DocumentTest test(const Json& json, const std::string& where) const {
    if (!json.is_object()) throw Fault{where, "is no object"};
    DocumentTest t;
    t.name = text(json, "name", where);
    const Json& settings = member(json, "settings", where);
    if (!settings.is_object()) throw Fault{where, "\"settings\" is no object"};
    t.settings["curves"] = "false";  // what older results do not say
    for (const auto& [key, value] : settings.items()) t.settings[key] = value.dump();
    t.clearance_mm = number(settings, "clearance_mm", where);
    t.touch_gap_mm = number(settings, "touch_gap_mm", where);
    const Json& tested = member(json, "tested", where);
    if (!tested.is_object()) throw Fault{where, "\"tested\" is no object"};
    t.in_a = bytes(tested, "a", where);
    t.in_b = bytes(tested, "b", where);
    const std::size_t size = (document_.elements.size() + 7) / 8;
    if (t.in_a.size() != size || t.in_b.size() != size)
      throw Fault{where, "\"tested\" does not go with \"elements\""};
    t.within_files = member(tested, "within_files", where) == Json(true);
    for (const Json& rule : member(json, "exempted", where))
      t.exempted_pairs += static_cast<std::uint64_t>(std::max(0.0, number(rule, "pairs", where)));
    if (json.contains("matrix")) matrix(json["matrix"], t, where);
    return t;
  }

  static void matrix(const Json& json, DocumentTest& t, const std::string& where) {
    t.has_matrix = true;
    for (const Json& cell : member(json, "cells", where)) {
      const Json settings = cell.contains("settings") ? cell["settings"] : Json("not checked");
      t.settings["matrix, " + text(cell, "a", where) + " and " + text(cell, "b", where)] =
          settings.dump();
    }
  }

  /// Exempted pairs by the keys that their results would have.
  void name_exempted() {
    for (const Exempted& e : exempted_) {
      if (e.test >= document_.tests.size()) throw Fault{"an exempted pair", "is of no test"};
      document_.exempted[clash::pair_key(document_.tests[e.test].name, {e.a.file, e.a.id},
                                         {e.b.file, e.b.id})] = e.rule;
    }
  }

  ClashDocument& document_;
  std::string section_;
  std::vector<Exempted> exempted_;
};

/// nlohmann's words hold the line: "… parse error at line 3, column 7: …".
Error unreadable(const std::string& file, const std::string& said, bool cut) {
  constexpr std::string_view kLine = "at line ";
  std::string where = file;
  if (const std::size_t at = said.find(kLine); at != std::string::npos) {
    const std::size_t start = at + kLine.size();
    where += ":" + said.substr(start, said.find_first_not_of("0123456789", start) - start);
  }
  return {ErrorCode::input, cut ? "the file ends too soon" : "this is no JSON", where,
          cut ? "it was cut off: run the test again or copy the file anew"
              : "give a file that 'strake clash -o FILE.json' wrote"};
}

}  // namespace

Result<ClashDocument> parse_clash_document(std::istream& in, const std::string& name) {
  ClashDocument document;
  document.name = name;
  try {
    Reader(document).read(in);
  } catch (const Fault& fault) {
    return Error{ErrorCode::input, fault.where + " " + fault.what, name,
                 "give a file that 'strake clash -o FILE.json' of this version wrote"};
  } catch (const Json::parse_error& error) {
    in.clear();
    const std::streamoff size = in.seekg(0, std::ios::end).tellg();
    return unreadable(name, error.what(),
                      size >= 0 && error.byte >= static_cast<std::size_t>(size));
  } catch (const Json::exception& error) {
    return unreadable(name, error.what(), false);
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
