// SPDX-License-Identifier: Apache-2.0
#include "report/decisions/decision_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/files/sort_unique.hpp"

namespace strake::report {
namespace {

/// Points and depths are compared as multiples of this, in millimetres: a spreadsheet rounds them.
constexpr double kWrittenPlaceMm = 0.01;

using FileContentsByLabel = std::map<std::string, FileContents, std::less<>>;

/// Returns the hash of where a result of a test lies.
Hash128 written_place(std::string_view test, const geometry::Vec3d& point_mm, double d_mm) {
  Hasher hasher;
  hasher.add(test);
  for (const double mm : {point_mm.x, point_mm.y, point_mm.z, d_mm})
    hasher.add(std::round(mm / kWrittenPlaceMm));
  return hasher.value();
}

RunFiles files_of(FileContentsByLabel&& contents) {
  RunFiles run;
  for (auto& [label, file] : contents) {
    file.label = label;
    sort_unique(file.ids);
    std::ranges::sort(file.places);
    run.files.push_back(std::move(file));
  }
  return run;
}

FileContentsByLabel contents_of(const DecisionFile& decided) {
  FileContentsByLabel contents;
  for (const Decision& row : decided.decisions)
    for (const DecisionObject& side : {row.a, row.b}) {
      if (side.file.empty()) continue;
      FileContents& file = contents[side.file];
      if (!side.id.empty()) file.ids.push_back(side.id);
      if (row.point_mm && row.d_mm)
        file.places.push_back(written_place(row.test, *row.point_mm, *row.d_mm));
    }
  return contents;
}

FileContentsByLabel contents_of(const clash::Findings& findings, const model::Model& model) {
  FileContentsByLabel contents;
  for (const model::SourceFile& file : model.files) contents.try_emplace(file.label);
  for (const clash::Report& test : findings.tests)
    for (const clash::Pair& pair : test.pairs)
      for (const model::ObjectId id : {pair.a, pair.b}) {
        const model::Object& object = model.object(id);
        FileContents& file = contents[model.files[object.file].label];
        if (!object.positional_id) file.ids.push_back(object.id);
        file.places.push_back(written_place(test.name, pair.point_mm, pair.d_mm));
      }
  return contents;
}

IdsByFile ids_of(const model::Model& model) {
  IdsByFile ids;
  for (const model::Object& object : model.objects)
    ids[model.files[object.file].label].insert(object.id);
  return ids;
}

IdsByFile ids_of(const DecisionFile& decided) {
  IdsByFile ids;
  for (const Decision& row : decided.decisions)
    for (const DecisionObject* const side : {&row.a, &row.b}) ids[side->file].insert(side->id);
  return ids;
}

bool has(const IdsByFile& ids, std::string_view label, std::string_view id) {
  const auto file = ids.find(label);
  return file != ids.end() && file->second.contains(id);
}

/// Returns the names of the two objects of a pair; they refer to the model.
std::pair<clash::ElementName, clash::ElementName> names_of(const model::Model& model,
                                                           const clash::Pair& pair) {
  const model::Object &a = model.object(pair.a), &b = model.object(pair.b);
  return {{model.files[a.file].label, a.id}, {model.files[b.file].label, b.id}};
}

/// Calls visit(OLD, NEW) for each way to read OLD=NEW, as labels may have a '=' themselves.
template <class Visit>
void for_each_reading(const std::string& text, Visit&& visit) {
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1))
    if (at > 0) visit(text.substr(0, at), text.substr(at + 1));
}

/// Adds the former names that are requested and that a file without the columns of files cannot
/// know.
void add_given_names(FileContentsByLabel& former, const FileContentsByLabel& today,
                     std::span<const std::string> given_pairs) {
  for (const std::string& text : given_pairs)
    for_each_reading(text, [&](const std::string& was, const std::string& is) {
      if (today.contains(is)) former.try_emplace(was);
    });
}

/// Whether a run before this one wrote the name of today, OLD=NEW, into the file.
bool is_in_force(const std::string& text, const FileContentsByLabel& former,
                 const FileContentsByLabel& today) {
  bool has_old = false, has_new = false;
  for_each_reading(text, [&](const std::string& was, const std::string& is) {
    if (!today.contains(is)) return;
    has_old = has_old || former.contains(was);
    has_new = has_new || former.contains(is);
  });
  return has_new && !has_old;
}

/// Leaves out the new names of files that are requested, NEW of OLD=NEW: rows that have one are
/// those of a run that did not know of it. A name that is OLD of another text is that of another
/// file.
void leave_out_new_names(std::span<const std::string> given_pairs, FileContentsByLabel& former) {
  const auto is_old_name = [&](std::string_view label) {
    return std::ranges::any_of(given_pairs, [&](const std::string& text) {
      return text.starts_with(std::string(label) + "=");
    });
  };
  for (const std::string& text : given_pairs)
    for_each_reading(text, [&](const std::string& was, const std::string& is) {
      if (former.contains(was) && !is_old_name(is)) former.erase(is);
    });
}

bool names_all_files(const DecisionFile& decided) {
  return std::ranges::none_of(decided.decisions, [](const Decision& row) {
    return row.a.file.empty() || row.b.file.empty();
  });
}

}  // namespace

Result<DecidedFiles> match_decided_files(const clash::Findings& findings, const model::Model& model,
                                         const DecisionFile& decided,
                                         std::span<const std::string> given_pairs) {
  FileContentsByLabel former = contents_of(decided), today = contents_of(findings, model);
  if (former.empty() || !names_all_files(decided)) add_given_names(former, today, given_pairs);
  DecidedFiles files;
  std::vector<std::string> open;
  for (const std::string& text : given_pairs)
    (is_in_force(text, former, today) ? files.in_force : open).push_back(text);
  leave_out_new_names(open, former);
  RunFiles before = files_of(std::move(former));
  before.is_excerpt = true;
  RunFiles after = files_of(std::move(today));
  const IdsByFile ids = ids_of(model);
  after.has = [&](std::string_view label, std::string_view id) { return has(ids, label, id); };
  const Result<std::vector<FilePair>> pairs = parse_file_pairs(open, before, after);
  if (!pairs) return pairs.error();
  Result<FileMatches> matches = match_files(before, after, *pairs);
  if (!matches) return matches.error();
  files.matches = std::move(*matches);
  return files;
}

DecidedKeys::DecidedKeys(const FileMatches& files, const model::Model& model,
                         const DecisionFile& decided)
    : model_(model),
      files_(files),
      ids_then_(files.by_label_alone() ? IdsByFile() : ids_of(decided)),
      ids_now_(files.by_label_alone() ? IdsByFile() : ids_of(model)),
      map_(
          files,
          [this](std::string_view label, std::string_view id) { return has(ids_then_, label, id); },
          [this](std::string_view label, std::string_view id) {
            return has(ids_now_, label, id);
          }) {}

Hash128 DecidedKeys::key(std::string_view test, const clash::Pair& pair) const {
  const auto [a, b] = names_of(model_, pair);
  return clash::pair_hash(test, a, b);
}

Hash128 DecidedKeys::former_key(std::string_view test, const clash::Pair& pair) const {
  const auto [a, b] = names_of(model_, pair);
  const std::string was_a = map_.label_in_other(RunSide::after, a.file_label, a.id),
                    was_b = map_.label_in_other(RunSide::after, b.file_label, b.id);
  return clash::pair_hash(test, {was_a, a.id}, {was_b, b.id});
}

bool DecidedKeys::has_label_of_another(const clash::Pair& pair) const {
  const auto [a, b] = names_of(model_, pair);
  return std::ranges::any_of(files_.matches, [&, one = a, other = b](const FileMatch& match) {
    return match.before != match.after &&
           (match.before == one.file_label || match.before == other.file_label);
  });
}

std::optional<Decision> DecidedKeys::renamed(const Decision& row) const {
  const auto key_of = [&row](const DecisionObject& a, const DecisionObject& b) {
    return clash::pair_hash(row.test, {a.file, a.id}, {b.file, b.id});
  };
  if (is_identity() || key_of(row.a, row.b) != row.key) return std::nullopt;
  Decision today = row;
  for (DecisionObject* const side : {&today.a, &today.b}) {
    side->file = map_.label_in_other(RunSide::before, side->file, side->id);
    if (side->file.starts_with('\0')) return std::nullopt;
  }
  today.key = key_of(today.a, today.b);
  return today.key == row.key ? std::nullopt : std::optional(std::move(today));
}

}  // namespace strake::report
