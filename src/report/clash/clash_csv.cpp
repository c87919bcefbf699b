// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/clash/attribute_columns.hpp"
#include "report/clash/group_numbers.hpp"
#include "report/text/csv.hpp"
#include "report/text/formatting.hpp"
#include "report/text/ordered_lines.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

constexpr std::array kResultColumns{
    "a_id",          "a_name",       "a_file",       "b_id",       "b_name",      "b_file",
    "class",         "relation",     "d_mm",         "d_lower_mm", "d_upper_mm",  "x_mm",
    "y_mm",          "z_mm",         "flags",        "test",       "key",         "volume_mm3",
    "on_a_x_mm",     "on_a_y_mm",    "on_a_z_mm",    "on_b_x_mm",  "on_b_y_mm",   "on_b_z_mm",
    "away_x",        "away_y",       "away_z",       "allowed_by", "exempted_by", "a_level",
    "b_level",       "a_discipline", "b_discipline", "group",      "regions",     "allowed_regions",
    "depth_complete"};

/// Behind them, where there are decisions: with these the file is a decision file itself.
constexpr std::array kDecidedColumns{"status", "by", "date", "comment", "reopened"};

constexpr std::array kLogColumns{
    "test",       "a_id",           "a_name",          "a_file",
    "b_id",       "b_name",         "b_file",          "may_be_allowed",
    "class",      "cost",           "part_pairs",      "repeated_part_pairs",
    "node_pairs", "triangle_pairs", "exact_fallbacks", "depth_cells"};

/// Begins the file: the mark, if there is one, and the names of the columns.
template <class Names>
void begin(std::string& out, const CsvForm& form, const Names& names,
           const std::vector<std::string>& attributes) {
  if (form.mark) out += "\xEF\xBB\xBF";
  CsvRow row(out, form);
  for (const char* const name : names) row.word(name);
  for (const std::string& attribute : attributes)
    for (const char* const side : {"a_@", "b_@"}) row.text(side + attribute);
  row.end();
}

void identity(CsvRow& row, const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  row.text(o.id).text(o.name).text(model.files[o.file].label);
}

void discipline(CsvRow& row, const clash::Report& test, model::ObjectId id) {
  const std::uint32_t d = test.disciplines.empty() ? clash::kNoLabel : test.discipline[index(id)];
  row.text(d == clash::kNoLabel ? std::string_view() : test.disciplines[d].name);
}

void level(CsvRow& row, const clash::Report& test, clash::Level of_part) {
  row.word(test.levels ? name(of_part) : std::string_view());
}

void point(CsvRow& row, const geometry::Vec3d& mm) {
  for (int k = 0; k < 3; ++k) row.number(mm[k], append_mm);
}

void positive(CsvRow& row, std::uint64_t count) {
  if (count > 0)
    row.count(count);
  else
    row.blank();
}

void attributes(CsvRow& row, const ClashContents& contents, model::ObjectId a, model::ObjectId b) {
  for (const std::string& attribute : contents.columns)
    for (const model::ObjectId id : {a, b})
      row.value(stated_text(contents.model, id, attribute).value_or(std::string()));
}

/// Appends the decision about a result; without one it is new, unless a rule allows it.
void decision(CsvRow& row, const ClashContents& contents, std::size_t test, const clash::Pair& p) {
  if (contents.decided == nullptr) return;
  const DecidedResult* const decided = contents.decided->of(test, p);
  if (decided == nullptr) {
    row.word(p.allowed < 0 ? name(DecisionStatus::undecided) : "")
        .blank(kDecidedColumns.size() - 1);
    return;
  }
  const Decision& d = *decided->decision;
  row.word(name(d.status)).text(d.by).word(d.date).text(d.comment).word(name(decided->reopened));
}

/// Appends the class of a pair, its relation, and where it is measured and how much.
void measured(CsvRow& row, const clash::Pair& p) {
  row.word(name(p.cls)).word(name(p.relation));
  row.number(p.d_mm, append_mm).number(p.d_lower_mm, append_mm_floor);
  row.number(p.d_upper_mm, append_mm_ceil);
  point(row, p.point_mm);
  append_flags(row.cell(), p.flags, " ", "");
}

void line(std::string& out, const ClashContents& contents, std::size_t number, const clash::Pair& p,
          std::string_view group) {
  const model::Model& model = contents.model;
  const clash::Report& test = contents.findings.tests[number];
  CsvRow row(out, contents.csv);
  identity(row, model, p.a);
  identity(row, model, p.b);
  measured(row, p);
  row.text(test.name).word(clash::pair_key(test.name, model, p.a, p.b));
  if (p.volume_mm3)
    row.number(*p.volume_mm3, append_mm);
  else
    row.blank();
  for (const geometry::Vec3d& v : {p.on_a_mm, p.on_b_mm, p.away}) point(row, v);
  row.text(p.allowed < 0 ? std::string_view()
                         : test.allowed[static_cast<std::size_t>(p.allowed)].rule);
  row.blank();
  level(row, test, p.level_a);
  level(row, test, p.level_b);
  discipline(row, test, p.a);
  discipline(row, test, p.b);
  row.word(group);
  positive(row, p.regions);
  positive(row, p.allowed_regions);
  row.word(p.depth_complete ? "" : "false");
  decision(row, contents, number, p);
  attributes(row, contents, p.a, p.b);
  row.end();
}

/// Appends a pair that was left out: of the class EXEMPTED, with nothing measured.
void exempted_line(std::string& out, const ClashContents& contents, const clash::Report& test,
                   const clash::ExemptedPair& p) {
  // From the relation to the flags; from the key to the rule that allows; from the group on.
  constexpr std::size_t kMeasures = 8, kFurtherMeasures = 12, kLast = 4;
  CsvRow row(out, contents.csv);
  identity(row, contents.model, p.a);
  identity(row, contents.model, p.b);
  row.word("EXEMPTED").blank(kMeasures).text(test.name).blank(kFurtherMeasures);
  row.text(test.exempted[p.rule].rule).blank(2);
  discipline(row, test, p.a);
  discipline(row, test, p.b);
  row.blank(kLast);
  if (contents.decided != nullptr) row.blank(kDecidedColumns.size());
  attributes(row, contents, p.a, p.b);
  row.end();
}

}  // namespace

Status write_clash_csv(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  const GroupNumbers numbers(contents);
  BufferedWriter buffer(sink);
  std::vector<const char*> columns(kResultColumns.begin(), kResultColumns.end());
  if (contents.decided != nullptr)
    columns.insert(columns.end(), kDecidedColumns.begin(), kDecidedColumns.end());
  begin(buffer.text(), contents.csv, columns, contents.columns);
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t) {
    const clash::Report& test = contents.findings.tests[t];
    const Status pairs =
        write_lines(context, test.pairs.size(), buffer, [&](std::size_t p, std::string& out) {
          const auto group = numbers.of(t, p);
          line(out, contents, t, test.pairs[p],
               group ? contents.grouping->groups[*group].id : std::string_view());
        });
    if (!pairs) return pairs;
    const Status exempted = write_lines(
        context, test.exempted_pairs.size(), buffer, [&](std::size_t p, std::string& out) {
          exempted_line(out, contents, test, test.exempted_pairs[p]);
        });
    if (!exempted) return exempted;
  }
  return {};
}

namespace {

void line(std::string& out, const ClashContents& contents, const clash::Report& test,
          const clash::LoggedPair& p) {
  CsvRow row(out, contents.csv);
  row.text(test.name);
  identity(row, contents.model, p.a);
  identity(row, contents.model, p.b);
  row.word(p.may_be_allowed ? "1" : "0").word(name(p.cls)).count(p.cost());
  for (const std::uint64_t n : {p.part_pairs, p.repeated_part_pairs, p.node_pairs, p.triangle_pairs,
                                p.exact_fallbacks, p.depth_cells})
    row.count(n);
  row.end();
}

}  // namespace

Status write_pair_log(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  BufferedWriter buffer(sink);
  begin(buffer.text(), contents.csv, kLogColumns, {});
  for (const clash::Report& test : contents.findings.tests) {
    const Status status = write_lines(
        context, test.log.size(), buffer,
        [&](std::size_t p, std::string& out) { line(out, contents, test, test.log[p]); });
    if (!status) return status;
  }
  return {};
}

}  // namespace strake::report
