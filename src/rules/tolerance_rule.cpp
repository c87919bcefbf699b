// SPDX-License-Identifier: Apache-2.0
#include "rules/tolerance_rule.hpp"

#include <string>
#include <utility>
#include <variant>

#include "clash/rules/tolerance_lengths.hpp"
#include "rules/clearances.hpp"

namespace strake::rules {
namespace {

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

}  // namespace strake::rules
