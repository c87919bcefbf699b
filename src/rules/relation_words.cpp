// SPDX-License-Identifier: Apache-2.0
#include "rules/relation_words.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/text_encoding.hpp"
#include "strake/clash/clash.hpp"

namespace strake::rules {
namespace {

using clash::Relation;
using clash::RelationSet;

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
