// SPDX-License-Identifier: Apache-2.0
#include "rules/test_options.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "clash/rules/tolerance_lengths.hpp"
#include "core/text_encoding.hpp"
#include "rules/clearances.hpp"
#include "strake/clash/clash.hpp"

namespace strake::rules {
namespace {

using clash::Relation;
using clash::RelationSet;

/// Reads a clearance to which objects add an attribute; a length alone is none of its business.
/// Returns whether it is one.
bool read_object_clearance(settings::ParseContext& reading, settings::TableReader& table,
                           ToleranceRule& rule) {
  const settings::Value* const value = table.value("clearance");
  const auto* const text = value == nullptr ? nullptr : std::get_if<std::string>(&value->held);
  if (text == nullptr || text->find('@') == std::string::npos) return false;
  const std::string what = "'clearance' of " + table.what();
  Result<WrittenClearance> written = parse_clearance(*text);
  if (!written) {
    reading.fault(value->at, what + ": " + written.error().message, written.error().mend);
    return true;
  }
  rule.of_all.clearance_mm = written->mm;
  rule.clearance_attribute = std::move(written->attribute);
  rule.clearance_where = reading.file() + ", line " + std::to_string(value->at.line) + ": " + what;
  return true;
}

/// Reads one of the lengths; returns whether it is there.
bool read_length(settings::TableReader& table, const clash::ToleranceLength& length,
                 ToleranceRule& rule) {
  const auto value = table.tolerance_mm(length.name);
  if (!value) return false;
  rule.of_all.*length.value_mm = *value;
  if (length.value_mm == &clash::Tolerances::clearance_mm) rule.clearance_attribute.clear();
  return true;
}

/// What people call several relations of results, or one.
constexpr std::array<std::pair<std::string_view, RelationSet>, 3> kRelationWords{
    {{"inside", {Relation::a_in_b}},
     {"through", {Relation::interfere, Relation::cross}},
     {"abut", {Relation::abut_outside, Relation::abut_inside}}}};

std::optional<RelationSet> relations_of(const std::string& word) {
  for (const auto& [name, relations] : kRelationWords)
    if (word == name) return relations;
  for (const Relation relation : clash::kRelations)
    if (word == lowered(clash::name(relation))) return RelationSet{relation};
  return std::nullopt;
}

std::string all_words() {
  std::string words;
  for (const auto& [name, relations] : kRelationWords)
    words += (words.empty() ? "" : ", ") + std::string(name);
  for (const Relation relation : clash::kRelations) words += ", " + lowered(clash::name(relation));
  return words;
}

}  // namespace

bool read_tolerances(settings::ParseContext& reading, settings::TableReader& table,
                     ToleranceRule& rule) {
  bool some = false;
  for (const clash::ToleranceLength& length : clash::kToleranceLengths) {
    const bool clearance = length.value_mm == &clash::Tolerances::clearance_mm;
    some |= (clearance && read_object_clearance(reading, table, rule)) ||
            read_length(table, length, rule);
  }
  if (const auto cap = table.flag("thickness_cap")) {
    rule.of_all.thickness_cap = *cap ? clash::ThicknessCap::on : clash::ThicknessCap::off;
    some = true;
  }
  return some;
}

RelationSet read_relations(settings::ParseContext& reading, settings::TableReader& table,
                           std::string_view key) {
  RelationSet all;
  const settings::Value* const value = table.value(key);
  if (value == nullptr) return all;
  for (const std::string& word : table.texts(key)) {
    if (const auto relations = relations_of(lowered(word)))
      all.add(*relations);
    else
      reading.fault(value->at,
                    in_quotes(key) + " of " + table.what() + " has the word " + in_quotes(word) +
                        ", which is no relation",
                    "write some of " + all_words());
  }
  if (all.empty())
    reading.fault(value->at, in_quotes(key) + " of " + table.what() + " names no relation",
                  "write some of " + all_words() + ", or leave it out for all");
  return all;
}

void read_reporting(settings::ParseContext& reading, settings::TableReader& table,
                    clash::Reporting& reporting) {
  if (const RelationSet relations = read_relations(reading, table, "relations"); !relations.empty())
    reporting.relations = relations;
  if (const auto least = table.volume_mm3("min_volume")) reporting.min_volume_mm3 = *least;
}

}  // namespace strake::rules
