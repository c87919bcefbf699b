// SPDX-License-Identifier: Apache-2.0
#include "strake/project/update.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "project/database/database.hpp"
#include "project/model/model_store.hpp"
#include "project/update/file_plan.hpp"
#include "project/update/rename_files.hpp"
#include "project/update/revision_store.hpp"
#include "strake/io/importer.hpp"

namespace strake::project {
namespace {

using FilesById = std::map<std::int64_t, std::string>;

FilesById labels_by_id(const std::vector<StoredFile>& files) {
  FilesById labels;
  for (const StoredFile& file : files) labels.emplace(file.id, file.source.label);
  return labels;
}

/// Whether a file may have another label beside others: labels of namesakes gain folders.
bool has_namesake(const std::vector<StoredFile>& files, const std::filesystem::path& path) {
  return std::ranges::any_of(files, [&](const StoredFile& file) {
    return file.path.filename() == path.filename() && file.path != path;
  });
}

/// Returns the files whose labels are others, although they are what they were.
std::vector<RenamedFile> relabelled(const std::vector<StoredFile>& then,
                                    const std::vector<StoredFile>& now) {
  const FilesById labels = labels_by_id(now);
  std::vector<RenamedFile> renamed;
  for (const StoredFile& file : then)
    if (const auto at = labels.find(file.id); at != labels.end() && at->second != file.source.label)
      renamed.push_back({file.source.label, at->second});
  return renamed;
}

/// Gives results the labels of today.
Status follow(Project& project, const std::optional<model::Model>& then,
              const std::vector<RenamedFile>& renamed) {
  if (renamed.empty() || !then) return {};
  return rename_files(project.database(), *then, renamed);
}

void add_renamed(std::vector<FileEvent>& events, const std::vector<RenamedFile>& renamed) {
  for (const RenamedFile& file : renamed) events.push_back({"renamed", file.after, file.before});
}

/// Returns the model where labels of stored files may change, which results have to follow.
Result<std::optional<model::Model>> model_if(bool wanted, Project& project,
                                             const parallel::Context& context) {
  if (!wanted) return std::optional<model::Model>();
  Result<model::Model> model = project.model(context);
  if (!model) return model.error();
  return std::optional(std::move(*model));
}

std::uint64_t count_objects(const std::vector<StoredFile>& files) {
  std::uint64_t count = 0;
  for (const StoredFile& file : files) count += file.objects;
  return count;
}

report::FileMatch match_of(const std::string& before, const std::string& after) {
  return {before, after,
          before == after ? report::FileRelation::same_label : report::FileRelation::renamed};
}

/// Stores a revision in which whole files came or went.
Result<Update> store_whole_files(Project& project, const RevisionNote& note, std::string what,
                                 const std::vector<StoredFile>& then, std::vector<FileEvent> events,
                                 const std::optional<model::Model>& then_model) {
  const Result<std::vector<StoredFile>> now = project.files();
  if (!now) return now.error();
  const FilesById old_labels = labels_by_id(then), labels = labels_by_id(*now);
  Update done;
  Changes& changes = done.changes;
  for (const StoredFile& file : *now) {
    if (const auto before = old_labels.find(file.id); before != old_labels.end()) {
      changes.unchanged += file.objects;
      changes.files.matches.push_back(match_of(before->second, file.source.label));
      continue;
    }
    changes.counts[static_cast<std::size_t>(ChangeKind::added)] += file.objects;
    changes.files.only_after.push_back(file.source.label);
    events.push_back({"added", file.source.label, {}});
  }
  for (const StoredFile& file : then)
    if (!labels.contains(file.id)) changes.files.only_before.push_back(file.source.label);
  changes.counts[static_cast<std::size_t>(ChangeKind::removed)] =
      count_objects(then) - changes.unchanged;
  done.read = changes.files.only_after;
  done.revision = {0, note.when, std::move(what), changes.counts, changes.unchanged};
  const std::vector<RenamedFile> renamed = relabelled(then, *now);
  add_renamed(events, renamed);
  if (const Status status = follow(project, then_model, renamed); !status) return status.error();
  if (const Status status = store_revision(project.database(), done.revision, events, changes);
      !status)
    return status.error();
  return done;
}

}  // namespace

Result<Update> add_model_files(Project& project, std::span<const io::FileToRead> files,
                               const RevisionNote& note, const parallel::Context& context) {
  Result<Transaction> transaction = Transaction::begin(project.database());
  if (!transaction) return transaction.error();
  const Result<std::vector<StoredFile>> then = project.files();
  if (!then) return then.error();
  std::vector<FileToStore> read;
  bool namesakes = false;
  for (const io::FileToRead& file : files)
    if (find_file(*then, file.path) != nullptr)
      return Error{ErrorCode::usage, "is in the project already", file.path.string(),
                   "'strake project update' reads it again"};
  // Files that importers read wait for them together, not one by one.
  if (const Status made = io::make_scenes(files, context); !made) return made.error();
  for (const io::FileToRead& file : files) {
    Result<FileToStore> one = read_file(file, context);
    if (!one) return one.error();
    read.push_back(std::move(*one));
    namesakes = namesakes || has_namesake(*then, file.path);
  }
  const Result<std::optional<model::Model>> model = model_if(namesakes, project, context);
  if (!model) return model.error();
  if (const Status status = store_files(project, read, context); !status) return status.error();
  Result<Update> done = store_whole_files(project, note, "add", *then, {}, *model);
  if (!done) return done;
  if (const Status status = transaction->commit(); !status) return status.error();
  for (const FileToStore& file : read) done->noticed.append(file.model.diagnostics);
  return done;
}

namespace {

/// Returns the numbers of the files that are called so.
Result<std::vector<std::int64_t>> numbers_of(const std::vector<StoredFile>& files,
                                             std::span<const std::string> labels) {
  std::set<std::int64_t> numbers;
  for (const std::string& label : labels) {
    const auto found =
        std::ranges::find(files, label, [](const StoredFile& file) { return file.source.label; });
    if (found == files.end()) {
      std::string list;
      for (const StoredFile& file : files)
        list += (list.empty() ? "" : ", ") + printable(file.source.label);
      return Error{ErrorCode::usage,
                   "the project has no file " + in_quotes(label),
                   {},
                   list.empty() ? "it has none at all" : "it has " + list};
    }
    numbers.insert(found->id);
  }
  return std::vector<std::int64_t>(numbers.begin(), numbers.end());
}

}  // namespace

Result<Update> remove_model_files(Project& project, std::span<const std::string> labels,
                                  const RevisionNote& note, const parallel::Context& context) {
  Result<Transaction> transaction = Transaction::begin(project.database());
  if (!transaction) return transaction.error();
  const Result<std::vector<StoredFile>> then = project.files();
  if (!then) return then.error();
  const Result<std::vector<std::int64_t>> numbers = numbers_of(*then, labels);
  if (!numbers) return numbers.error();
  std::vector<FileEvent> events;
  bool namesakes = false;
  for (const StoredFile& file : *then) {
    if (std::ranges::find(*numbers, file.id) == numbers->end()) continue;
    events.push_back({"removed", file.source.label, {}});
    namesakes = namesakes || has_namesake(*then, file.path);
  }
  const Result<std::optional<model::Model>> model = model_if(namesakes, project, context);
  if (!model) return model.error();
  if (const Status status = remove_files(project, *numbers, context); !status)
    return status.error();
  Result<Update> done =
      store_whole_files(project, note, "remove", *then, std::move(events), *model);
  if (!done) return done;
  if (const Status status = transaction->commit(); !status) return status.error();
  return done;
}

namespace {

/// Returns which stored file is which of the new ones, with their labels.
report::FileMatches matches_of(const FilePlan& plan, const std::vector<StoredFile>& then,
                               const std::vector<StoredFile>& now) {
  report::FileMatches files;
  std::set<std::string> old_labels, labels;
  const auto add = [&](report::FileMatch match) {
    if (match.relation == report::FileRelation::same_label && match.before != match.after)
      match.relation = report::FileRelation::renamed;
    old_labels.insert(match.before);
    labels.insert(match.after);
    files.matches.push_back(std::move(match));
  };
  for (const FileLink& link : plan.links) {
    report::FileMatch match = link.match;
    if (const StoredFile* const file = find_file(now, link.now)) match.after = file->source.label;
    add(std::move(match));
  }
  const FilesById kept = labels_by_id(now);
  for (const StoredFile& file : then)
    if (const auto at = kept.find(file.id);
        !old_labels.contains(file.source.label) && at != kept.end())
      add(match_of(file.source.label, at->second));
  for (const StoredFile& file : then)
    if (!old_labels.contains(file.source.label)) files.only_before.push_back(file.source.label);
  for (const StoredFile& file : now)
    if (!labels.contains(file.source.label)) files.only_after.push_back(file.source.label);
  std::ranges::sort(files.matches, {}, [](const report::FileMatch& match) {
    return std::tie(match.after, match.before);
  });
  return files;
}

/// Returns the files that have another label as a whole.
std::vector<RenamedFile> renamed_files(const report::FileMatches& files) {
  std::vector<RenamedFile> renamed;
  for (const report::FileMatch& match : files.matches)
    if (match.before != match.after && match.relation != report::FileRelation::split &&
        match.relation != report::FileRelation::merged)
      renamed.push_back({match.before, match.after});
  return renamed;
}

/// Stores what was read, and tells what changed.
Result<Update> store_update(Project& project, FilePlan plan, const std::vector<StoredFile>& then,
                            const model::Model& then_model, const RevisionNote& note,
                            const parallel::Context& context) {
  std::vector<std::filesystem::path> read;
  Diagnostics noticed;
  for (const FileToStore& file : plan.read) {
    read.push_back(file.path);
    noticed.append(file.model.diagnostics);
  }
  if (const Status status = store_files(project, plan.read, context); !status)
    return status.error();
  plan.read.clear();
  if (!plan.merged.empty())
    if (const Status status = remove_files(project, plan.merged, context); !status)
      return status.error();
  const Result<std::vector<StoredFile>> now = project.files();
  if (!now) return now.error();
  const Result<model::Model> now_model = project.model(context);
  if (!now_model) return now_model.error();
  Result<Changes> changes = compare(then_model, *now_model, matches_of(plan, then, *now), context);
  if (!changes) return changes.error();
  Update done{std::move(*changes), {}, std::move(noticed), {}};
  std::vector<FileEvent> events;
  for (const std::filesystem::path& path : read) {
    const StoredFile* const file = find_file(*now, path);
    if (file == nullptr) continue;
    done.read.push_back(file->source.label);
    events.push_back({"read", file->source.label, {}});
  }
  for (const std::string& label : done.changes.files.only_before)
    events.push_back({"removed", label, {}});
  for (const std::string& label : done.changes.files.only_after)
    events.push_back({"added", label, {}});
  const std::vector<RenamedFile> renamed = renamed_files(done.changes.files);
  add_renamed(events, renamed);
  if (!renamed.empty())
    if (const Status status = rename_files(project.database(), then_model, renamed); !status)
      return status.error();
  done.revision = {0, note.when, "update", done.changes.counts, done.changes.unchanged};
  if (const Status status = store_revision(project.database(), done.revision, events, done.changes);
      !status)
    return status.error();
  return done;
}

/// Returns what update() tells where no file has changed.
Update nothing_changed(const std::vector<StoredFile>& files) {
  Update done;
  for (const StoredFile& file : files)
    done.changes.files.matches.push_back(match_of(file.source.label, file.source.label));
  done.changes.unchanged = count_objects(files);
  return done;
}

}  // namespace

Result<Update> update(Project& project, const UpdateRequest& request, const RevisionNote& note,
                      const parallel::Context& context) {
  Result<Transaction> transaction = Transaction::begin(project.database());
  if (!transaction) return transaction.error();
  const Result<std::vector<StoredFile>> then = project.files();
  if (!then) return then.error();
  if (then->empty())
    return Error{ErrorCode::input, "has no model files", project.path().string(),
                 "'strake project add' adds some"};
  const Result<std::vector<OutdatedFile>> outdated = outdated_files(*then, request, context);
  if (!outdated) return outdated.error();
  if (outdated->empty() && request.given_pairs.empty()) return nothing_changed(*then);
  const Result<model::Model> then_model = project.model(context);
  if (!then_model) return then_model.error();
  Result<FilePlan> plan = plan_update(*then, *outdated, request.given_pairs, *then_model, context);
  if (!plan) return plan.error();
  Result<Update> done = store_update(project, std::move(*plan), *then, *then_model, note, context);
  if (!done) return done;
  if (const Status status = transaction->commit(); !status) return status.error();
  return done;
}

}  // namespace strake::project
