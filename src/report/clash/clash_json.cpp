// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "clash/results/clash_key.hpp"
#include "report/clash/clash_json_members.hpp"
#include "report/clash/clash_schema_version.hpp"
#include "report/clash/group_numbers.hpp"
#include "report/files/file_match_output.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"
#include "report/text/ordered_lines.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

using clash::Report;

void files(std::string& out, const model::Model& model) {
  append_list(out, "files", model.files, [&](const model::SourceFile& file) {
    out += "{\"label\": ";
    append_json(out, file.label);
    out += ", \"format\": ";
    append_json(out, file.format);
    out += ", \"unit\": ";
    append_json(out, file.unit);
    if (file.ends_early) out += ", \"ends_early\": true";
    out += '}';
  });
}

void rules(std::string& out, const RulesSource& source) {
  out += "\"rules\": {\"file\": ";
  append_json(out, source.file);
  out += ", \"hash\": \"" + source.hash.text() + '"';
  if (!source.profile.empty()) {
    out += ", \"profile\": ";
    append_json(out, source.profile);
  }
  out += '}';
}

void classes(std::string& out, const WrittenClasses& written) {
  out += "\"classes\": [";
  bool first = true;
  for (const clash::Class cls :
       {clash::Class::hit, clash::Class::contact, clash::Class::clearance_violation}) {
    if (!written.has(cls)) continue;
    out += first ? "\"" : ", \"";
    first = false;
    out += name(cls);
    out += '"';
  }
  out += ']';
}

/// Appends what a diagnostic, and a count of such, begins with.
void begin_diagnostic(std::string& out, std::string_view code, Severity severity) {
  out += "{\"code\": ";
  append_json(out, code);
  out += ", \"severity\": ";
  append_json(out, severity_name(severity));
}

void diagnostics(std::string& out, const Diagnostics& all) {
  append_list(
      out, "diagnostics", all.counts(),
      [&](const Diagnostics::Count& c) {
        begin_diagnostic(out, c.code, c.severity);
        out += ", \"count\": " + std::to_string(c.count) + "}";
      },
      "\n  ");
  out += ",\n";
  append_list(
      out, "messages", all.kept(),
      [&](const Diagnostic& d) {
        begin_diagnostic(out, d.code, d.severity);
        out += ", \"where\": ";
        append_json(out, d.where);
        out += ", \"message\": ";
        append_json(out, d.message);
        out += '}';
      },
      "\n  ");
}

/// Appends how results are grouped, up to the list.
void begin_groups(std::string& out, const clash::Grouping& grouping) {
  out += "\"groups\": {\"by\": \"";
  out += name(grouping.rules.by);
  out += "\"";
  if (grouping.rules.by == clash::GroupBy::proximity || grouping.rules.apart) {
    out += ", \"distance_mm\": ";
    append_mm(out, grouping.rules.distance_mm);
  }
}

void groups(BufferedWriter& buffer, const clash::Grouping& grouping) {
  std::string& out = buffer.text();
  begin_groups(out, grouping);
  out += ", ";
  append_list(
      out, "list", grouping.groups,
      [&](const clash::Group& group) {
        append_group(out, group);
        buffer.done();
      },
      "\n  ");
  out += '}';
}

/// Appends what was decided as a whole: which file says so, how many results are of each status and
/// came back, and decisions that no result has.
void decisions(std::string& out, const DecidedResults& decided) {
  out += "\"decisions\": {\"file\": ";
  append_json(out, std::filesystem::path(decided.file->name).filename().string());
  out += ", \"deeper_mm\": ";
  append_mm(out, decided.deeper_mm);
  out += ", \"counts\": {";
  for (std::size_t s = 0; s < kDecisionStatuses.size(); ++s) {
    out += s == 0 ? "" : ", ";
    append_key(out, name(kDecisionStatuses[s]));
    out += std::to_string(decided.counts[s]);
  }
  out += "}, \"reopened\": {";
  for (const Reopened why :
       {Reopened::severer, Reopened::deeper, Reopened::more_regions, Reopened::found_again}) {
    out += why == Reopened::severer ? "" : ", ";
    std::string key(name(why));
    std::ranges::replace(key, ' ', '_');
    append_key(out, key);
    out += std::to_string(decided.count(why));
  }
  out += "}, ";
  append_list(
      out, "not_found", decided.not_found,
      [&](const Decision* row) {
        out += "{\"key\": \"" + clash::key_text(row->key) + "\", \"status\": ";
        append_json(out, name(row->status));
        append_decided(out, *row);
        out += '}';
      },
      "\n  ");
  append_file_matches(out, decided.files);
  out += '}';
}

/// Appends the list `name` of what items(test) returns, one a line: write(text, number of the test,
/// number of the item in it, item).
template <class Items, class Write>
Status list(BufferedWriter& buffer, std::string_view name, const clash::Findings& findings,
            const parallel::Context& context, Items&& items, Write&& write) {
  append_key(buffer.text(), name);
  buffer.text() += '[';
  bool first = true;
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    const auto& of_test = items(findings.tests[t]);
    const Status status =
        write_lines(context, of_test.size(), buffer, [&](std::size_t i, std::string& out) {
          out += first && i == 0 ? "\n" : ",\n";
          write(out, t, i, of_test[i]);
        });
    if (!status) return status;
    first = first && of_test.empty();
  }
  buffer.text() += "\n]";
  return {};
}

Status results(BufferedWriter& buffer, const ClashContents& contents,
               const parallel::Context& context) {
  const GroupNumbers numbers(contents);
  return list(
      buffer, "results", contents.findings, context,
      [](const Report& test) -> const auto& { return test.pairs; },
      [&](std::string& out, std::size_t test, std::size_t p, const clash::Pair& pair) {
        append_result(out, contents, test, pair, numbers.of(test, p));
      });
}

Status not_compared(BufferedWriter& buffer, const ClashContents& contents,
                    const parallel::Context& context) {
  return list(
      buffer, "not_compared", contents.findings, context,
      [](const Report& test) -> const auto& { return test.not_compared; },
      [&](std::string& out, std::size_t test, std::size_t, const clash::NotCompared& what) {
        append_not_compared(out, contents, test, what);
      });
}

Status exempted_pairs(BufferedWriter& buffer, const ClashContents& contents,
                      const parallel::Context& context) {
  return list(
      buffer, "exempted", contents.findings, context,
      [](const Report& test) -> const auto& { return test.exempted_pairs; },
      [&](std::string& out, std::size_t test, std::size_t, const clash::ExemptedPair& pair) {
        append_exempted_pair(out, contents, test, pair);
      });
}

/// Writes what stands before the tests.
void begin_document(std::string& out, const ClashContents& contents) {
  out += "{\n\"schema_version\": ";
  out += kClashSchemaVersion;
  out += ",\n";
  files(out, contents.model);
  out += ",\n";
  if (!contents.classes.all()) {
    classes(out, contents.classes);
    out += ",\n";
  }
  if (contents.rules != nullptr) {
    rules(out, *contents.rules);
    out += ",\n";
  }
}

/// Writes what stands between the tests and the groups.
Status middle_of_document(BufferedWriter& buffer, const ClashContents& contents,
                          const parallel::Context& context) {
  std::string& out = buffer.text();
  out += ",\n\"hash\": ";
  append_json(out, hash_of(contents.findings));
  out += ",\n";
  Diagnostics all;
  if (contents.loading != nullptr) all = *contents.loading;
  all.append(contents.findings.all_diagnostics());
  diagnostics(out, all);
  out += ",\n";
  if (const Status s = not_compared(buffer, contents, context); !s) return s;
  if (contents.decided == nullptr) return {};
  out += ",\n";
  decisions(out, *contents.decided);
  return {};
}

/// Writes what stands behind the results.
Status end_document(BufferedWriter& buffer, const ClashContents& contents,
                    const parallel::Context& context) {
  std::string& out = buffer.text();
  if (std::ranges::any_of(contents.findings.tests, &Report::lists_exempted)) {
    out += ",\n";
    if (const Status s = exempted_pairs(buffer, contents, context); !s) return s;
  }
  out += "\n}\n";
  return {};
}

}  // namespace

Status write_clash_json(const ClashContents& contents, Sink sink,
                        const parallel::Context& context) {
  BufferedWriter buffer(sink);
  std::string& out = buffer.text();
  begin_document(out, contents);
  if (Status s = append_tests(out, contents.findings, contents.model, context); !s) return s;
  if (Status s = middle_of_document(buffer, contents, context); !s) return s;
  out += ",\n";
  if (contents.grouping != nullptr) {
    groups(buffer, *contents.grouping);
    out += ",\n";
  }
  if (const Status s = results(buffer, contents, context); !s) return s;
  return end_document(buffer, contents, context);
}

Status write_clash_head(const ClashContents& contents, Sink sink,
                        const parallel::Context& context) {
  BufferedWriter buffer(sink);
  std::string& out = buffer.text();
  begin_document(out, contents);
  if (Status s = append_test_list(out, contents.findings); !s) return s;
  if (Status s = middle_of_document(buffer, contents, context); !s) return s;
  if (contents.grouping != nullptr) {
    out += ",\n";
    begin_groups(out, *contents.grouping);
    out += '}';
  }
  return end_document(buffer, contents, context);
}

}  // namespace strake::report
