// SPDX-License-Identifier: Apache-2.0
#include "settings/named_sets.hpp"

#include <utility>

namespace strake::settings {
namespace {

/// The deepest nesting of sets within sets: more than any person follows.
constexpr int kDeepest = 50;

}  // namespace

NamedSets::NamedSets(ParseContext& reading, const Value* table) : reading_(reading) {
  if (table == nullptr) return;
  TableReader reader(reading, *table, "[sets]");
  for (const KeyValue* entry : reader.others()) sets_.push_back({entry, std::nullopt, false});
}

Result<model::Selection> NamedSets::find(std::string_view name) {
  std::string known;
  for (Set& set : sets_) {
    known += (known.empty() ? "" : ", ") + set.entry->key;
    if (set.entry->key != name) continue;
    if (set.selection) return *set.selection;
    if (set.open)
      return fault_at(reading_.file(), set.entry->at,
                      "the set '" + set.entry->key + "' needs itself, by way of the sets it names",
                      "break the circle");
    if (depth_ == kDeepest)
      return fault_at(reading_.file(), set.entry->at, "sets within sets, nested too deeply",
                      "name fewer within each other");
    set.open = true;
    ++depth_;
    Result<model::Selection> parsed = parse(set.entry->value, "[sets] '" + set.entry->key + "'");
    --depth_;
    set.open = false;
    if (parsed) set.selection = *parsed;
    return parsed;
  }
  return Error{ErrorCode::input,
               "no set is called '" + std::string(name) + "'",
               {},
               known.empty() ? "write one under [sets]" : "the sets are " + known};
}

Result<model::Selection> NamedSets::parse(const Value& value, const std::string& what) {
  const auto* const text = std::get_if<std::string>(&value.held);
  if (text == nullptr)
    return fault_at(reading_.file(), value.at, what + " is no selection",
                    "write a selection in quotes, as \"type = cylinder\"");
  const auto lookup = [&](std::string_view name) { return find(name); };
  Result<model::Selection> selection = model::Selection::parse(*text, lookup);
  if (selection) return selection;
  Error error = selection.error();
  error.code = ErrorCode::input;
  // A fault in a set that this one names has its own position already.
  if (error.where.starts_with("selection, "))
    error.where =
        fault_at(reading_.file(), value.at, {}, {}).where + ", " + what + ", " + error.where;
  return error;
}

std::optional<Chooser> NamedSets::chooser(const Value& value, const std::string& what) {
  Result<model::Selection> selection = parse(value, what);
  if (!selection) {
    reading_.fault(selection.error());
    return std::nullopt;
  }
  return Chooser{std::move(*selection),
                 reading_.file() + ", line " + std::to_string(value.at.line) + ": " + what};
}

std::optional<Chooser> NamedSets::chooser(TableReader& table, std::string_view key) {
  const Value* const value = table.value(key);
  if (value == nullptr) return std::nullopt;
  return chooser(*value, table.what() + ", " + std::string(key));
}

std::optional<Chooser> NamedSets::required(TableReader& table, std::string_view key) {
  auto found = chooser(table, key);
  if (!found && reading_.good())
    reading_.fault(table.at(), table.what() + " has no '" + std::string(key) + "'",
                   "write " + std::string(key) + " = \"a selection\"");
  return found;
}

std::vector<NamedSet> NamedSets::all() {
  std::vector<NamedSet> sets;
  for (const Set& set : sets_) {
    const Result<model::Selection> found = find(set.entry->key);
    if (!found) {
      reading_.fault(found.error());
      return {};
    }
    sets.push_back({set.entry->key,
                    {*found, reading_.file() + ", line " + std::to_string(set.entry->at.line) +
                                 ": [sets] '" + set.entry->key + "'"}});
  }
  return sets;
}

}  // namespace strake::settings
