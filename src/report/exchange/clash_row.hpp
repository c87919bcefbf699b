// SPDX-License-Identifier: Apache-2.0
// The rows of results that CSV and spreadsheets have alike: the same columns, the same numbers. A
// row takes its cells by word(), text(), value(), number(), count() and blank(), as CsvRow does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "clash/results/clash_key.hpp"
#include "report/clash/contents.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {

inline constexpr std::array kResultColumns{
    "a_id",          "a_name",       "a_file",       "b_id",       "b_name",      "b_file",
    "class",         "relation",     "d_mm",         "d_lower_mm", "d_upper_mm",  "x_mm",
    "y_mm",          "z_mm",         "flags",        "test",       "key",         "volume_mm3",
    "on_a_x_mm",     "on_a_y_mm",    "on_a_z_mm",    "on_b_x_mm",  "on_b_y_mm",   "on_b_z_mm",
    "away_x",        "away_y",       "away_z",       "allowed_by", "exempted_by", "a_level",
    "b_level",       "a_discipline", "b_discipline", "group",      "regions",     "allowed_regions",
    "depth_complete"};

/// Behind them, where there are decisions or room for them: with these the file is a decision file
/// itself.
inline constexpr std::array kDecidedColumns{"status", "by", "date", "comment", "reopened"};

template <class Row>
void append_identity(Row& row, const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  row.text(o.id).text(o.name).text(model.files[o.file].label);
}

template <class Row>
void append_discipline(Row& row, const clash::Report& test, model::ObjectId id) {
  const std::uint32_t d = test.disciplines.empty() ? clash::kNoLabel : test.discipline[index(id)];
  row.text(d == clash::kNoLabel ? std::string_view() : test.disciplines[d].name);
}

template <class Row>
void append_level(Row& row, const clash::Report& test, clash::Level of_part) {
  row.word(test.levels ? name(of_part) : std::string_view());
}

template <class Row>
void append_point(Row& row, const geometry::Vec3d& mm) {
  for (int k = 0; k < 3; ++k) row.number(mm[k], append_mm);
}

template <class Row>
void append_positive(Row& row, std::uint64_t count) {
  if (count > 0)
    row.count(count);
  else
    row.blank();
}

template <class Row>
void append_attributes(Row& row, const ClashContents& contents, model::ObjectId a,
                       model::ObjectId b) {
  for (const std::string& attribute : contents.columns)
    for (const model::ObjectId id : {a, b})
      row.value(stated_text(contents.model, id, attribute).value_or(std::string()));
}

/// Appends the decision about a result; without one it is new, unless a rule allows it.
template <class Row>
void append_decision(Row& row, const ClashContents& contents, std::size_t test,
                     const clash::Pair& p) {
  const DecidedResult* const decided = decision_about(contents, test, p);
  if (decided == nullptr) {
    row.word(p.allowed < 0 ? name(DecisionStatus::undecided) : "")
        .blank(kDecidedColumns.size() - 1);
    return;
  }
  const Decision& d = *decided->decision;
  row.word(name(d.status)).text(d.by).word(d.date).text(d.comment).word(name(decided->reopened));
}

/// Appends the class of a pair, its relation, and where it is measured and how much.
template <class Row>
void append_measured(Row& row, const clash::Pair& p) {
  row.word(name(p.cls)).word(name(p.relation));
  row.number(p.d_mm, append_mm).number(p.d_lower_mm, append_mm_floor);
  row.number(p.d_upper_mm, append_mm_ceil);
  append_point(row, p.point_mm);
  std::string flags;
  append_flags(flags, p.flags, " ", "");
  row.word(flags);
}

/// Appends the cells of a result; those of its decision where `decided`.
template <class Row>
void append_result_cells(Row& row, const ClashContents& contents, std::size_t number,
                         const clash::Pair& p, std::string_view group, bool decided) {
  const model::Model& model = contents.model;
  const clash::Report& test = contents.findings.tests[number];
  append_identity(row, model, p.a);
  append_identity(row, model, p.b);
  append_measured(row, p);
  row.text(test.name).word(clash::pair_key(test.name, model, p.a, p.b));
  if (p.volume_mm3)
    row.number(*p.volume_mm3, append_mm);
  else
    row.blank();
  for (const geometry::Vec3d& v : {p.on_a_mm, p.on_b_mm, p.away}) append_point(row, v);
  row.text(p.allowed < 0 ? std::string_view()
                         : test.allowed[static_cast<std::size_t>(p.allowed)].rule);
  row.blank();
  append_level(row, test, p.level_a);
  append_level(row, test, p.level_b);
  append_discipline(row, test, p.a);
  append_discipline(row, test, p.b);
  row.word(group);
  append_positive(row, p.regions);
  append_positive(row, p.allowed_regions);
  row.word(p.depth_complete ? "" : "false");
  if (decided) append_decision(row, contents, number, p);
  append_attributes(row, contents, p.a, p.b);
}

/// Appends the cells of a pair that was left out: of the class EXEMPTED, with nothing measured.
template <class Row>
void append_exempted_cells(Row& row, const ClashContents& contents, const clash::Report& test,
                           const clash::ExemptedPair& p, bool decided) {
  // From the relation to the flags; from the key to the rule that allows; from the group on.
  constexpr std::size_t kMeasures = 8, kFurtherMeasures = 12, kLast = 4;
  append_identity(row, contents.model, p.a);
  append_identity(row, contents.model, p.b);
  row.word("EXEMPTED").blank(kMeasures).text(test.name).blank(kFurtherMeasures);
  row.text(test.exempted[p.rule].rule).blank(2);
  append_discipline(row, test, p.a);
  append_discipline(row, test, p.b);
  row.blank(kLast);
  if (decided) row.blank(kDecidedColumns.size());
  append_attributes(row, contents, p.a, p.b);
}

}  // namespace strake::report
