// SPDX-License-Identifier: Apache-2.0
#include "report/document_tests.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "report/document_fault.hpp"
#include "strake/core/base64.hpp"

namespace strake::report {
namespace {

using Json = nlohmann::json;

const char* value_name(Json::value_t type) {
  return type == Json::value_t::object ? "object" : type == Json::value_t::array ? "list" : "truth";
}

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

std::uint64_t count(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_number_unsigned()) throw is_not(where, key, "count");
  return value.get<std::uint64_t>();
}

const Json& held(const Json& object, const char* key, Json::value_t type,
                 const std::string& where) {
  const Json& value = member(object, key, where);
  if (value.type() != type) throw is_not(where, key, value_name(type));
  return value;
}

std::vector<std::uint8_t> bytes(std::string_view base64, const char* key,
                                const std::string& where) {
  auto parsed = parse_base64(base64);
  if (!parsed) throw is_not(where, key, "base64");
  return std::move(*parsed);
}

void read_matrix(const Json& json, DocumentTest& t, const std::string& where) {
  t.has_matrix = true;
  for (const Json& cell : held(json, "cells", Json::value_t::array, where)) {
    const Json settings = cell.contains("settings") ? cell["settings"] : Json("not checked");
    t.settings["matrix, " + text(cell, "a", where) + " and " + text(cell, "b", where)] =
        settings.dump();
  }
}

/// Of a model with so many elements.
DocumentTest read_test(const Json& json, std::size_t elements, const std::string& where) {
  if (!json.is_object()) throw DocumentFault{where, "is no object"};
  DocumentTest t;
  t.name = text(json, "name", where);
  t.hash = text(json, "hash", where);
  const Json& counts = held(json, "counts", Json::value_t::object, where);
  t.counts = {count(counts, "HIT", where), count(counts, "CONTACT", where),
              count(counts, "CLEARANCE_VIOLATION", where), count(counts, "ALLOWED", where)};
  const Json& settings = held(json, "settings", Json::value_t::object, where);
  t.settings["curves"] = "false";  // what older results do not say
  for (const auto& [key, value] : settings.items()) t.settings[key] = value.dump();
  t.clearance_mm = number(settings, "clearance_mm", where);
  t.touch_gap_mm = number(settings, "touch_gap_mm", where);
  const Json& tested = held(json, "tested", Json::value_t::object, where);
  t.in_a = bytes(text(tested, "a", where), "a", where);
  t.in_b = bytes(text(tested, "b", where), "b", where);
  const std::size_t size = (elements + 7) / 8;
  if (t.in_a.size() != size || t.in_b.size() != size)
    throw DocumentFault{where, "\"tested\" does not go with \"elements\""};
  t.within_files = held(tested, "within_files", Json::value_t::boolean, where).get<bool>();
  for (const Json& rule : held(json, "exempted", Json::value_t::array, where))
    t.exempted_pairs += count(rule, "pairs", where);
  for (const Json& rule : held(json, "allowed", Json::value_t::array, where))
    if (rule.contains("places"))
      t.allowed_places = t.allowed_places.value_or(0) + count(rule, "places", where);
  if (json.contains("matrix"))
    read_matrix(held(json, "matrix", Json::value_t::object, where), t, where);
  return t;
}

}  // namespace

std::vector<std::uint64_t> read_elements(std::string_view base64) {
  const std::vector<std::uint8_t> raw = bytes(base64, "elements", "the document");
  if (raw.size() % 8 != 0) throw DocumentFault{"the document", "\"elements\" is cut off"};
  std::vector<std::uint64_t> elements;
  elements.reserve(raw.size() / 8);
  for (std::size_t i = 0; i < raw.size(); i += 8) {
    std::uint64_t hash = 0;
    for (unsigned k = 0; k < 8; ++k) hash |= std::uint64_t{raw[i + k]} << (8 * k);
    elements.push_back(hash);
  }
  if (!std::ranges::is_sorted(elements))
    throw DocumentFault{"the document", "\"elements\" are not in order"};
  return elements;
}

std::vector<std::uint8_t> read_sheets(std::string_view base64, std::size_t elements) {
  std::vector<std::uint8_t> sheets = bytes(base64, "sheets", "the document");
  if (sheets.size() != elements)
    throw DocumentFault{"the document", "\"sheets\" does not go with \"elements\""};
  return sheets;
}

std::vector<std::uint8_t> read_positional_ids(std::string_view base64, std::size_t elements) {
  std::vector<std::uint8_t> bits = bytes(base64, "positional_ids", "the document");
  if (bits.size() != (elements + 7) / 8)
    throw DocumentFault{"the document", "\"positional_ids\" does not go with \"elements\""};
  return bits;
}

std::vector<DocumentTest> read_tests(std::string_view json, std::size_t elements) {
  try {
    const Json list = Json::parse(json);
    if (!list.is_array()) throw is_not("the document", "tests", "list");
    std::vector<DocumentTest> tests;
    for (std::size_t t = 0; t < list.size(); ++t)
      tests.push_back(read_test(list[t], elements, "tests[" + std::to_string(t) + "]"));
    return tests;
  } catch (const Json::exception&) {
    throw DocumentFault{"the document", "has \"tests\" that cannot be read"};
  }
}

}  // namespace strake::report
