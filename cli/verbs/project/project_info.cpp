// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>

#include "cli/verbs/project/project_verbs.hpp"
#include "core/text_encoding.hpp"
#include "strake/project/summary.hpp"

namespace strake::cli {

namespace {

std::string revision_text(const project::Revision& revision) {
  std::string text = fmt::format("{}, {}", revision.when, revision.what);
  for (std::size_t k = 0; k < project::kChangeKinds; ++k)
    if (revision.counts[k] > 0)
      text += fmt::format(", {} {}", revision.counts[k],
                          project::change_name(static_cast<project::ChangeKind>(k)));
  return text;
}

std::string project_info_text(const project::Summary& summary, const std::string& file) {
  std::string out = fmt::format("{}\n", printable(file));
  out += fmt::format("  version     {}, {} bytes\n", summary.schema_version, summary.bytes);
  out += fmt::format("  model       {} files, {} objects, {} bodies\n", summary.files.size(),
                     summary.objects, summary.bodies);
  for (const project::StoredFile& stored : summary.files)
    out += fmt::format("    {}: {}, {} objects, unit {}, {} up\n", printable(stored.source.label),
                       stored.source.format, stored.objects, printable(stored.source.unit),
                       stored.source.up_axis);
  out += fmt::format("  revisions   {}\n", summary.revisions);
  if (summary.last_revision)
    out += fmt::format("    the last: {}\n", printable(revision_text(*summary.last_revision)));
  out += fmt::format("  tests       {}, run {} times, {} clashes known\n", summary.tests,
                     summary.runs, summary.clashes);
  return out + fmt::format("  views       {}\n", summary.views);
}

void append_revision(std::string& out, const project::Revision& revision) {
  out += fmt::format("{{\"id\": {}, \"at\": ", revision.id);
  append_json_string(out, revision.when);
  out += ", \"what\": ";
  append_json_string(out, revision.what);
  for (std::size_t k = 0; k < project::kChangeKinds; ++k)
    out += fmt::format(", \"{}\": {}", project::change_name(static_cast<project::ChangeKind>(k)),
                       revision.counts[k]);
  out += fmt::format(", \"unchanged\": {}}}", revision.unchanged);
}

void append_file(std::string& out, const project::StoredFile& file) {
  out += "{\"label\": ";
  append_json_string(out, file.source.label);
  out += ", \"format\": ";
  append_json_string(out, file.source.format);
  out += ", \"unit\": ";
  append_json_string(out, file.source.unit);
  out += ", \"up_axis\": ";
  append_json_string(out, file.source.up_axis);
  out +=
      fmt::format(", \"bytes\": {}, \"objects\": {}, \"bodies\": {}, \"hash\": \"{}\", \"path\": ",
                  file.source.bytes, file.objects, file.bodies, file.content.text());
  append_json_string(out, file.path.string());
  out += '}';
}

std::string project_info_json(const project::Summary& summary) {
  std::string out = "{\n  \"schema_version\": 1,\n";
  out += fmt::format("  \"project_version\": {},\n  \"bytes\": {},\n", summary.schema_version,
                     summary.bytes);
  out += fmt::format("  \"objects\": {},\n  \"bodies\": {},\n  \"files\": [", summary.objects,
                     summary.bodies);
  for (const project::StoredFile& file : summary.files) {
    out += &file == &summary.files.front() ? "\n    " : ",\n    ";
    append_file(out, file);
  }
  out += summary.files.empty() ? "],\n" : "\n  ],\n";
  out += fmt::format("  \"revisions\": {},\n", summary.revisions);
  if (summary.last_revision) {
    out += "  \"last_revision\": ";
    append_revision(out, *summary.last_revision);
    out += ",\n";
  }
  return out +
         fmt::format("  \"tests\": {},\n  \"runs\": {},\n  \"clashes\": {},\n  \"views\": {}\n}}\n",
                     summary.tests, summary.runs, summary.clashes, summary.views);
}

Result<ExitCode> run_project_info(Session& session, const ProjectArgument& given) {
  Result<project::Project> project = open_argument(session, given, project::Access::read);
  if (!project) return project.error();
  const Result<project::Summary> summary = project::summary(*project);
  if (!summary) return summary.error();
  const Status written = session.write_stdout(
      session.json() ? project_info_json(*summary) : project_info_text(*summary, given.file));
  if (!written) return written.error();
  return ExitCode::done;
}

}  // namespace

Verb add_project_info(CLI::App& project, CommonOptions& common) {
  const auto options = std::make_shared<ProjectArgument>();
  CLI::App* const command =
      project.add_subcommand("info", "What a project is: its files, changes, tests and views");
  add_project_argument(*command, *options, project::Access::read);
  add_common_options(*command, common);
  command->footer(R"(
'strake info ship.strake' tells what its model holds.

Example:
  strake project info ship.strake --json)");
  return {command, [options](Session& session) { return run_project_info(session, *options); }};
}

}  // namespace strake::cli
