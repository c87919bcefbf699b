// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/bcf/bcf_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>

#include "bcf/output/write_bcf.hpp"
#include "cli/options/options.hpp"
#include "cli/output/console.hpp"
#include "cli/verbs/clash/clash_project.hpp"
#include "core/output_format.hpp"
#include "core/text/counted.hpp"
#include "publish/form_words.hpp"

namespace strake::cli {

namespace {

/// Returns the first option of the command line that is about BCF; null where there is none.
const char* first_given(const BcfInput& input) {
  if (!input.version.empty()) return "--bcf-version";
  if (!input.max_topics.empty()) return "--bcf-max-topics";
  if (!input.date.empty()) return "--bcf-date";
  if (!input.author.empty()) return "--bcf-author";
  if (input.history) return "--bcf-history";
  return input.contacts ? "--bcf-contacts" : nullptr;
}

Error in_option(Error error, const char* option) {
  error.where = option;
  return error;
}

}  // namespace

void add_bcf_options(CLI::App& command, BcfInput& options) {
  constexpr const char* kGroup = "Result";
  add_choice(command, "--bcf-version", options.version, {"2.1", "3.0"},
             "Version of .bcf (default 2.1, which most programs read)")
      ->group(kGroup);
  command
      .add_option("--bcf-max-topics", options.max_topics,
                  fmt::format("Most topics of .bcf: the first groups, or the worst results "
                              "(default {})",
                              report::BcfForm{}.max_topics))
      ->type_name("N")
      ->group(kGroup);
  add_former_name(command, "--bcf-most", options.max_topics);
  command
      .add_flag("--bcf-contacts", options.contacts,
                "Topics for contacts, too, where there are no groups")
      ->group(kGroup);
  command
      .add_flag("--bcf-history", options.history,
                "Comments also tell what was set along with them, as who sees to a clash")
      ->group(kGroup);
  command
      .add_option("--bcf-date", options.date,
                  "When topics were made, as 2026-01-31 or 2026-01-31T12:00:00Z (default: the run "
                  "of the project; without one when the newest model file says that it was "
                  "written; where none says so 1970-01-01: equal runs write equal files)")
      ->type_name("DATE")
      ->group(kGroup);
  command
      .add_option("--bcf-author", options.author,
                  fmt::format("Who made the topics (default {})", report::BcfForm{}.author))
      ->type_name("NAME")
      ->group(kGroup);
}

Result<report::BcfForm> bcf_form(const BcfInput& input, bool is_written) {
  report::BcfForm form;
  if (const char* const option = first_given(input); option != nullptr && !is_written)
    return Error{ErrorCode::usage, "no .bcf is written", option, "add -o FILE.bcf"};
  form.version_3 = input.version == "3.0";
  form.contacts = input.contacts;
  if (!input.max_topics.empty()) {
    std::uint64_t max_topics = 0;
    if (const Status status = whole_number(max_topics, input.max_topics, "--bcf-max-topics");
        !status)
      return status.error();
    form.max_topics = static_cast<std::size_t>(max_topics);
  }
  if (!input.date.empty()) {
    const Result<std::string> date = publish::bcf_date(input.date);
    if (!date) return in_option(date.error(), "--bcf-date");
    form.date = *date;
  }
  if (!input.author.empty()) {
    const Result<std::string> author = publish::bcf_author(input.author);
    if (!author) return in_option(author.error(), "--bcf-author");
    form.author = *author;
  }
  return form;
}

project::RunComments comments_of_run(const BcfInput& input, bool is_written) {
  if (!is_written) return project::RunComments::none;
  return input.history ? project::RunComments::with_history : project::RunComments::all_comments;
}

bool is_bcf(const std::string& file) { return suffix_of(file).starts_with(".bcf"); }

void report_left_out(Console& console, const std::string& file,
                     const report::ClashContents& contents) {
  if (!is_bcf(file)) return;
  if (!bcf::is_dated(contents))
    console.note(
        fmt::format("{}: its topics are dated 1970-01-01, for no model file says when it was "
                    "written (--bcf-date)",
                    file));
  if (const std::uint64_t strange = bcf::strange_dates_of_bcf(contents); strange > 0)
    console.warn(fmt::format(
        "{}: {} of decisions and comments {} none; others stand in {} place, or none", file,
        counted(strange, "date"), strange == 1 ? "is" : "are", strange == 1 ? "its" : "their"));
  if (const std::string text = bcf::left_out_of_bcf(contents); !text.empty())
    console.note(
        fmt::format("{}: without {} (--bcf-max-topics, --bcf-contacts, --group-by)", file, text));
}

report::BcfForm with_run_date(report::BcfForm form, const ProjectClashes* project) {
  if (form.date.empty() && project != nullptr) form.date = project->started();
  return form;
}

}  // namespace strake::cli
