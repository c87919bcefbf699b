// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/clash.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "pictures/folder.hpp"
#include "publish/clash_formats.hpp"
#include "publish/form_words.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/clash_rows.hpp"
#include "python/bindings/diagnostics.hpp"
#include "python/bindings/run.hpp"
#include "report/clash/contents.hpp"
#include "report/clash/group_numbers.hpp"
#include "strake/core/atomic_file.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

using RunPointer = std::shared_ptr<ClashRun>;

nb::dict summary_of(const ClashRun& run) {
  std::uint64_t hit = 0, contact = 0, clearance = 0, allowed = 0;
  for (const clash::Report& test : run.findings.tests) {
    hit += test.count_hit;
    contact += test.count_contact;
    clearance += test.count_clearance;
    allowed += test.count_allowed;
  }
  const clash::NotComparedCounts lacks = clash::counts_of(run.findings.tests);
  nb::dict counts;
  counts["hit"] = hit;
  counts["contact"] = contact;
  counts["clearance_violation"] = clearance;
  counts["allowed"] = allowed;
  counts["objects_not_compared_whole"] = lacks.objects;
  counts["pairs_not_compared"] = lacks.pairs;
  return counts;
}

nb::list tests_of(const ClashRun& run) {
  nb::list names;
  for (const clash::Report& test : run.findings.tests) names.append(nb::cast(test.name));
  return names;
}

/// Returns the name of the rule that a number in the column `allowed` of a test means.
nb::list allowing_rules(const ClashRun& run) {
  nb::list all;
  for (const clash::Report& test : run.findings.tests) {
    nb::list names;
    for (const clash::AllowedCount& one : test.allowed) names.append(nb::cast(one.rule));
    all.append(names);
  }
  return all;
}

nb::list groups_of(const ClashRun& run, const std::optional<clash::Grouping>& grouping) {
  std::vector<std::uint32_t> first_row;
  std::uint32_t rows = 0;
  for (const clash::Report& test : run.findings.tests) {
    first_row.push_back(rows);
    rows += static_cast<std::uint32_t>(test.pairs.size());
  }
  nb::list groups;
  if (!grouping) return groups;
  for (const clash::Group& group : grouping->groups) {
    std::vector<std::uint32_t> members;
    members.reserve(group.results.size());
    for (const clash::ResultRef& r : group.results) members.push_back(first_row[r.test] + r.pair);
    const std::size_t size = members.size();
    groups.append(nb::make_tuple(group.id, group.name, static_cast<int>(group.worst), group.d_mm,
                                 array_of(std::move(members), {size})));
  }
  return groups;
}

nb::list groups(const RunPointer& run) {
  if (run->grouping) return groups_of(*run, run->grouping);
  Result<clash::Grouping> made = clash::group_results(run->findings, run->model->model(), {});
  return groups_of(*run, value_or_raise(std::move(made)));
}

std::string key_of(const RunPointer& run, std::uint32_t test, std::uint32_t a, std::uint32_t b) {
  const std::size_t objects = run->model->model().objects.size();
  if (test >= run->findings.tests.size() || a >= objects || b >= objects)
    throw nb::index_error("no such pair");
  return clash::pair_key(run->findings.tests[test].name, run->model->model(), model::ObjectId(a),
                         model::ObjectId(b));
}

/// Returns what files of results have besides the numbers, of rows from `begin` to before `end`: a
/// list of their keys, of their statuses and of the ids of their groups, empty where there are
/// none.
nb::tuple words_of_rows(const RunPointer& run, std::size_t begin, std::size_t end) {
  const report::ClashContents contents = run->contents();
  const report::GroupNumbers numbers(contents);
  nb::list keys, statuses, groups;
  std::size_t row = 0;
  for (std::size_t t = 0; t < run->findings.tests.size(); ++t) {
    const clash::Report& test = run->findings.tests[t];
    const std::size_t first = std::max(begin, row), last = std::min(end, row + test.pairs.size());
    for (std::size_t at = first; at < last; ++at) {
      const clash::Pair& pair = test.pairs[at - row];
      keys.append(nb::cast(clash::pair_key(test.name, contents.model, pair.a, pair.b)));
      const report::DecidedResult* const decided = report::decision_about(contents, t, pair);
      const bool open = decided != nullptr || pair.allowed < 0;
      statuses.append(
          nb::cast(open ? std::string(name(report::current_status(decided))) : std::string()));
      const auto group = numbers.of(t, at - row);
      groups.append(nb::cast(group ? contents.grouping->groups[*group].id : std::string()));
    }
    row += test.pairs.size();
  }
  return nb::make_tuple(keys, statuses, groups);
}

/// Returns the error with the argument that it is about.
Error in_argument(Error error, const char* argument) {
  error.where = argument;
  return error;
}

/// Adds to what is written how that is done.
Status apply_form(const WrittenForm& form, report::ClashContents& contents) {
  contents.columns = form.columns;
  contents.csv = publish::csv_form(form.csv);
  contents.shown = publish::model_shown(form.page_geometry);
  contents.bcf.version_3 = form.bcf_3;
  contents.bcf.contacts = form.bcf_contacts;
  contents.bcf.max_topics = form.bcf_most;
  if (!form.bcf_date.empty()) {
    const Result<std::string> date = publish::bcf_date(form.bcf_date);
    if (!date) return in_argument(date.error(), "bcf_date");
    contents.bcf.date = *date;
  }
  if (!form.bcf_author.empty()) {
    const Result<std::string> author = publish::bcf_author(form.bcf_author);
    if (!author) return in_argument(author.error(), "bcf_author");
    contents.bcf.author = *author;
  }
  return {};
}

/// Writes a file, whole or not at all.
template <class Write>
Status write_file(const std::filesystem::path& path, Write&& write) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  const Status written = write([&](std::string_view text) { file->write(text); });
  return written ? file->commit() : written;
}

/// Writes as the suffix of the path requests.
void save(const RunPointer& run, const std::filesystem::path& path, const WrittenForm& form,
          const RunOptions& options) {
  const auto writer = value_or_raise(publish::find_clash_writer(path.string()));
  run_status(options, "write", [&](const parallel::Context& context) -> Status {
    report::ClashContents contents = run->contents();
    if (const Status status = apply_form(form, contents); !status) return status;
    return write_file(path,
                      [&](report::Sink sink) { return writer.write(contents, sink, context); });
  });
}

/// Writes every pair that went to the detailed stage.
void save_pair_log(const RunPointer& run, const std::filesystem::path& path, const std::string& csv,
                   const RunOptions& options) {
  run_status(options, "write", [&](const parallel::Context& context) -> Status {
    report::ClashContents contents = run->contents();
    contents.csv = publish::csv_form(csv);
    return write_file(
        path, [&](report::Sink sink) { return report::write_pair_log(contents, sink, context); });
  });
}

/// Returns how many pictures were drawn and how many left out.
nb::tuple save_pictures(const RunPointer& run, const std::filesystem::path& folder,
                        std::size_t most, bool png, const RunOptions& options) {
  pictures::FolderOptions how;
  how.max_pictures = most;
  how.format = png ? pictures::PictureFormat::png : pictures::PictureFormat::svg;
  const pictures::FolderCount count =
      python::run(options, "draw pictures",
                  [&](const parallel::Context& context) -> Result<pictures::FolderCount> {
                    if (const Status status = pictures::check_picture_folder(folder); !status)
                      return status.error();
                    return pictures::write_picture_folder(run->contents(), folder, how, context);
                  });
  return nb::make_tuple(count.drawn, count.left_out);
}

nb::object rows(const RunPointer& run, const RunOptions& options) {
  return array_of_rows(python::run(options, "rows", [&](const parallel::Context& context) {
    return rows_of(run->findings, context);
  }));
}

/// What is requested of a run.
void bind_request(nb::module_& module) {
  nb::class_<Pick>(module, "Pick")
      .def(
          "__init__",
          [](Pick* self, std::vector<std::string> selections, std::vector<bool> objects) {
            new (self) Pick{std::move(selections), std::move(objects)};
          },
          nb::arg("selections"), nb::arg("objects"));
  nb::class_<ClashRequest>(module, "ClashRequest")
      .def(nb::init<>())
      .def_rw("a", &ClashRequest::a)
      .def_rw("b", &ClashRequest::b)
      .def_rw("within_files", &ClashRequest::within_files)
      .def_rw("rules", &ClashRequest::rules)
      .def_rw("profile", &ClashRequest::profile)
      .def_rw("clearance", &ClashRequest::clearance)
      .def_rw("touch_gap_mm", &ClashRequest::touch_gap_mm)
      .def_rw("touch_overlap_mm", &ClashRequest::touch_overlap_mm)
      .def_rw("contact_distance_mm", &ClashRequest::contact_distance_mm)
      .def_rw("thickness_cap", &ClashRequest::thickness_cap)
      .def_rw("volumes", &ClashRequest::volumes)
      .def_rw("curves", &ClashRequest::curves)
      .def_rw("contacts", &ClashRequest::contacts)
      .def_rw("regions", &ClashRequest::regions)
      .def_rw("group_by", &ClashRequest::group_by)
      .def_rw("group_distance_mm", &ClashRequest::group_distance_mm)
      .def_rw("group_contacts", &ClashRequest::group_contacts)
      .def_rw("sort", &ClashRequest::sort)
      .def_rw("classes", &ClashRequest::classes)
      .def_rw("sag_mm", &ClashRequest::sag_mm)
      .def_rw("weld_mm", &ClashRequest::weld_mm)
      .def_rw("obstructions", &ClashRequest::obstructions)
      .def_rw("insulation", &ClashRequest::insulation)
      .def_rw("list_exempted", &ClashRequest::list_exempted)
      .def_rw("log_pairs", &ClashRequest::log_pairs);
}

void bind_written_form(nb::module_& module) {
  nb::class_<WrittenForm>(module, "WrittenForm")
      .def(nb::init<>())
      .def_rw("columns", &WrittenForm::columns)
      .def_rw("csv", &WrittenForm::csv)
      .def_rw("page_geometry", &WrittenForm::page_geometry)
      .def_rw("bcf_date", &WrittenForm::bcf_date)
      .def_rw("bcf_author", &WrittenForm::bcf_author)
      .def_rw("bcf_3", &WrittenForm::bcf_3)
      .def_rw("bcf_contacts", &WrittenForm::bcf_contacts)
      .def_rw("bcf_most", &WrittenForm::bcf_most);
}

}  // namespace

void bind_clash(nb::module_& module) {
  bind_request(module);
  bind_written_form(module);
  nb::class_<ClashRun>(module, "ClashRun")
      .def_prop_ro("model", [](const ClashRun& run) { return run.model; })
      .def_prop_ro("summary", &summary_of)
      .def_prop_ro("tests", &tests_of)
      .def_prop_ro("allowing_rules", &allowing_rules)
      .def_ro("logs_pairs", &ClashRun::logs_pairs)
      .def_prop_ro("hash", [](const ClashRun& run) { return clash::hash_of(run.findings); })
      .def_prop_ro("diagnostics",
                   [](const ClashRun& run) { return listed(run.findings.all_diagnostics()); })
      .def(
          "table",
          [](const ClashRun& run, std::size_t count) {
            return report::clash_table(run.contents(), {.rows = count, .sort = run.sort});
          },
          nb::arg("rows"));
  module.def(
      "clash",
      [](const ModelPointer& model, const ClashRequest& request, const RunOptions& options) {
        return run(options, "clash", [&](const parallel::Context& context) {
          return find_clashes(model, request, context);
        });
      },
      nb::arg("model"), nb::arg("request"), nb::arg("options"));
  module.def("clash_rows", &rows, nb::arg("run"), nb::arg("options"));
  module.def("clash_groups", &groups, nb::arg("run"));
  module.def("clash_words", &words_of_rows, nb::arg("run"), nb::arg("begin"), nb::arg("end"));
  module.def("clash_key", &key_of, nb::arg("run"), nb::arg("test"), nb::arg("a"), nb::arg("b"));
  module.def("save_clashes", &save, nb::arg("run"), nb::arg("path"), nb::arg("form"),
             nb::arg("options"));
  module.def("save_pair_log", &save_pair_log, nb::arg("run"), nb::arg("path"), nb::arg("csv"),
             nb::arg("options"));
  module.def("save_pictures", &save_pictures, nb::arg("run"), nb::arg("folder"), nb::arg("most"),
             nb::arg("png"), nb::arg("options"));
}

}  // namespace strake::python
