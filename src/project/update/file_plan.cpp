// SPDX-License-Identifier: Apache-2.0
#include "project/update/file_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "project/changes/run_files.hpp"
#include "strake/io/importer.hpp"

namespace strake::project {
namespace {

bool is_part(report::FileRelation relation) {
  return relation == report::FileRelation::split || relation == report::FileRelation::merged;
}

bool are_equal(const io::ReadOptions& x, const io::ReadOptions& y) {
  return x.unit_mm == y.unit_mm && x.up_axis == y.up_axis && x.encoding == y.encoding;
}

/// Returns the options with what was said of the file before where nothing is said now.
io::ReadOptions inherited(io::ReadOptions options, const io::ReadOptions& before) {
  if (!options.unit_mm) options.unit_mm = before.unit_mm;
  if (!options.up_axis) options.up_axis = before.up_axis;
  if (!options.encoding) options.encoding = before.encoding;
  return options;
}

/// Returns what was said of every file alike: a file whose place is not known yet is read so, or it
/// would be like none of them.
io::ReadOptions common_options(const std::vector<StoredFile>& files) {
  if (files.empty()) return {};
  const io::ReadOptions& first = files.front().options;
  const bool alike = std::ranges::all_of(
      files, [&](const StoredFile& file) { return are_equal(file.options, first); });
  return alike ? first : io::ReadOptions();
}

/// Whether the file is no longer what was stored of it.
Result<bool> has_changed(const StoredFile& stored, const io::FileToRead& file,
                         const parallel::Context& context) {
  if (!are_equal(stored.options, file.options)) return true;
  const Result<Hash128> content = content_hash(file.path, context);
  if (!content) {
    Error error = content.error();
    if (error.code == ErrorCode::input)
      error.mend += std::string(error.mend.empty() ? "" : "; ") +
                    "where the file has another name now, give it: strake project update FILE...";
    return error;
  }
  return *content != stored.content;
}

/// Gives files whose names repeat their folders, so that messages and OLD=NEW distinguish them.
std::vector<std::string> labels_of(const std::vector<FileToStore*>& files) {
  std::map<std::string, std::size_t> count;
  for (const FileToStore* const file : files) ++count[file->model.files.front().label];
  std::vector<std::string> labels;
  for (const FileToStore* const file : files) {
    const model::SourceFile& source = file->model.files.front();
    labels.push_back(count[source.label] > 1 ? source.folders + source.label : source.label);
  }
  return labels;
}

/// Finds out whose place files take that lie elsewhere than any stored one.
class PlaceFinder {
 public:
  PlaceFinder(const std::vector<StoredFile>& files, FilePlan& plan) : files_(files), plan_(plan) {}

  /// `known` are those that are read anyhow.
  Status find(const std::vector<const StoredFile*>& known, std::vector<FileToStore*> sought,
              const std::vector<std::string>& given_pairs, const model::Model& then,
              const parallel::Context& context) {
    Result<report::RunFiles> before = run_files(then, context);
    if (!before) return before.error();
    for (const StoredFile* const file : known)
      std::erase_if(before->files, [&](const report::FileContents& contents) {
        return contents.label == file->source.label;
      });
    report::RunFiles after;
    const std::vector<std::string> labels = labels_of(sought);
    for (std::size_t f = 0; f < sought.size(); ++f) {
      Result<report::RunFiles> one = run_files(sought[f]->model, context);
      if (!one) return one.error();
      one->files.front().label = labels[f];
      after.files.push_back(std::move(one->files.front()));
    }
    const Result<std::vector<report::FilePair>> pairs =
        report::parse_file_pairs(given_pairs, *before, after);
    if (!pairs) return pairs.error();
    const Result<report::FileMatches> matches = report::match_files(*before, after, *pairs);
    if (!matches) return matches.error();
    for (std::size_t f = 0; f < sought.size(); ++f)
      if (const Status status = take(*matches, labels[f], *sought[f], context); !status)
        return status;
    return {};
  }

 private:
  const StoredFile& stored(std::string_view label) const {
    return *std::ranges::find(files_, label,
                              [](const StoredFile& file) { return file.source.label; });
  }

  Status take(const report::FileMatches& matches, const std::string& label, FileToStore& file,
              const parallel::Context& context) {
    bool known = false;
    for (const report::FileMatch& match : matches.matches) {
      if (match.after != label) continue;
      known = true;
      plan_.links.push_back({match, file.path});
      const StoredFile& before = stored(match.before);
      if (match.relation == report::FileRelation::merged) plan_.merged.push_back(before.id);
      if (is_part(match.relation)) continue;
      if (const Status status = take_place(before, file, context); !status) return status;
    }
    return known ? Status() : no_place(matches, label);
  }

  /// Reads the file again where something was said of the one whose place it takes.
  static Status take_place(const StoredFile& before, FileToStore& file,
                           const parallel::Context& context) {
    io::ReadOptions options = inherited(file.options, before.options);
    if (!are_equal(options, file.options)) {
      Result<FileToStore> again = read_file({file.path, std::move(options)}, context);
      if (!again) return again.error();
      file = std::move(*again);
    }
    file.replaces = before.id;
    return {};
  }

  [[nodiscard]] static Error no_place(const report::FileMatches& matches,
                                      const std::string& label) {
    for (const report::AmbiguousFile& file : matches.ambiguous) {
      if (!file.of_after || file.label != label) continue;
      std::string list;
      for (const std::string& candidate : file.candidates)
        list += (list.empty() ? "" : " and ") + in_quotes(candidate);
      return {ErrorCode::usage, "is equally like " + list + " of the project", label,
              "--match-files OLD=NEW says whose place it takes"};
    }
    std::string list;
    for (const std::string& other : matches.only_before) list += (list.empty() ? "" : ", ") + other;
    return {ErrorCode::usage, "is like no file of the project", label,
            "'strake project add' adds it; --match-files OLD=NEW says whose place it takes" +
                (list.empty() ? std::string() : ", and there are " + list)};
  }

  const std::vector<StoredFile>& files_;
  FilePlan& plan_;
};

}  // namespace

const StoredFile* find_file(const std::vector<StoredFile>& files,
                            const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
  for (const StoredFile& file : files)
    if (file.path == whole) return &file;
  for (const StoredFile& file : files)
    if (std::filesystem::equivalent(file.path, path, error) && !error) return &file;
  return nullptr;
}

Result<std::vector<OutdatedFile>> outdated_files(const std::vector<StoredFile>& files,
                                                 const UpdateRequest& request,
                                                 const parallel::Context& context) {
  std::vector<OutdatedFile> sought;
  const io::ReadOptions of_all = common_options(files);
  for (const io::FileToRead& file : request.files) {
    const StoredFile* const stored = find_file(files, file.path);
    const io::ReadOptions& before = stored == nullptr ? of_all : stored->options;
    sought.push_back({{file.path, inherited(file.options, before)}, stored, file.path.string()});
  }
  if (request.files.empty())
    for (const StoredFile& file : files)
      sought.push_back({{file.path, file.options}, &file, file.given});
  std::vector<OutdatedFile> outdated;
  for (OutdatedFile& file : sought) {
    if (file.replaces != nullptr) {
      const Result<bool> changed = has_changed(*file.replaces, file.file, context);
      if (!changed) return changed.error();
      if (!*changed) continue;
    }
    outdated.push_back(std::move(file));
  }
  return outdated;
}

Result<FilePlan> plan_update(const std::vector<StoredFile>& files,
                             const std::vector<OutdatedFile>& outdated,
                             const std::vector<std::string>& given_pairs, const model::Model& then,
                             const parallel::Context& context) {
  FilePlan plan;
  std::vector<const StoredFile*> known;
  std::vector<std::size_t> sought;
  std::vector<io::FileToRead> to_read;
  for (const OutdatedFile& file : outdated) to_read.push_back(file.file);
  if (const Status made = io::make_scenes(to_read, context); !made) return made.error();
  for (const OutdatedFile& file : outdated) {
    Result<FileToStore> read = read_file(file.file, context);
    if (!read) return read.error();
    if (file.given != read->given) call_as_given(*read, file.given);
    if (file.replaces == nullptr) {
      sought.push_back(plan.read.size());
    } else {
      known.push_back(file.replaces);
      plan.links.push_back(
          {{file.replaces->source.label, {}, report::FileRelation::same_label}, file.file.path});
    }
    plan.read.push_back(std::move(*read));
  }
  if (sought.empty() && given_pairs.empty()) return plan;
  std::vector<FileToStore*> to_place;
  for (const std::size_t f : sought) to_place.push_back(&plan.read[f]);
  PlaceFinder finder(files, plan);
  if (const Status status = finder.find(known, std::move(to_place), given_pairs, then, context);
      !status)
    return status.error();
  return plan;
}

}  // namespace strake::project
