// SPDX-License-Identifier: Apache-2.0
#include "strake/report/file_match.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "report/files/file_likeness.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kNoFile = static_cast<std::size_t>(-1);

/// Returns labels as a list for a person.
std::string listed(const RunFiles& run) {
  std::string text;
  for (const FileContents& file : run.files) text += (text.empty() ? "" : ", ") + file.label;
  return text.empty() ? "none" : text;
}

std::size_t find_file(const RunFiles& run, std::string_view label) {
  const auto at = std::ranges::find(run.files, label, &FileContents::label);
  return at == run.files.end() ? kNoFile : static_cast<std::size_t>(at - run.files.begin());
}

/// A file of one run while it is looked for in the other.
struct SoughtFile {
  std::size_t partner = kNoFile;    ///< the file of the other run that it is
  bool is_part = false;             ///< it is a part of a file of the other run, or made of such
  std::vector<std::size_t> rivals;  ///< files of the other run between which nothing decides

  [[nodiscard]] bool is_free() const { return partner == kNoFile && !is_part && rivals.empty(); }
};

/// Two files that may be one.
struct MatchCandidate {
  std::size_t before = 0, after = 0;
  FileLikeness likeness;
};

class FileMatcher {
 public:
  FileMatcher(const RunFiles& before, const RunFiles& after)
      : before_(before),
        after_(after),
        sought_before_(before.files.size()),
        sought_after_(after.files.size()) {}

  Status take_given_pairs(std::span<const FilePair> given_pairs) {
    for (const FilePair& pair : given_pairs) {
      const Result<std::size_t> x = find_given_file(before_, sought_before_, pair.before, "old");
      if (!x) return x.error();
      const Result<std::size_t> y = find_given_file(after_, sought_after_, pair.after, "new");
      if (!y) return y.error();
      take(*x, *y, FileRelation::requested);
    }
    return {};
  }

  void take_equal_labels() {
    for (std::size_t x = 0; x < sought_before_.size(); ++x) {
      if (!sought_before_[x].is_free()) continue;
      const std::size_t y = find_file(after_, before_.files[x].label);
      if (y != kNoFile && sought_after_[y].is_free()) take(x, y, FileRelation::same_label);
    }
  }

  void take_renamed() {
    std::vector<MatchCandidate> open = candidates();
    const auto decided = [this](const MatchCandidate& c) {
      return !sought_before_[c.before].is_free() || !sought_after_[c.after].is_free();
    };
    for (bool found = true; found;) {
      std::vector<MatchCandidate> best;
      for (const MatchCandidate& c : open)
        if (beats_all_rivals(c, open)) best.push_back(c);
      for (const MatchCandidate& c : best) take(c.before, c.after, FileRelation::renamed);
      found = !best.empty();
      std::erase_if(open, decided);
    }
    for (const MatchCandidate& c : open) {
      sought_before_[c.before].rivals.push_back(c.after);
      sought_after_[c.after].rivals.push_back(c.before);
    }
  }

  /// Looks for what was split off files that are known, and for what went into such.
  void take_parts() {
    std::vector<std::pair<std::size_t, PartOf>> split, merged;
    for (std::size_t y = 0; y < sought_after_.size(); ++y)
      if (sought_after_[y].is_free()) split.emplace_back(y, whole_of(y, true));
    for (std::size_t x = 0; x < sought_before_.size(); ++x)
      if (sought_before_[x].is_free()) merged.emplace_back(x, whole_of(x, false));
    for (const auto& [y, part] : split) take_part(part, sought_after_[y], part.whole, y, true);
    for (const auto& [x, part] : merged) take_part(part, sought_before_[x], x, part.whole, false);
  }

  [[nodiscard]] FileMatches result() && {
    const auto order = [](const FileMatch& m) { return std::tie(m.after, m.before); };
    std::ranges::sort(result_.matches,
                      [&](const FileMatch& m, const FileMatch& n) { return order(m) < order(n); });
    leave_over(before_, sought_before_, after_, false, result_.only_before);
    leave_over(after_, sought_after_, before_, true, result_.only_after);
    return std::move(result_);
  }

 private:
  /// The file of the other run of which another is a part.
  struct PartOf {
    std::size_t whole = kNoFile;
    std::uint64_t common = 0;
    std::vector<std::size_t> rivals;
  };

  static Result<std::size_t> find_given_file(const RunFiles& run,
                                             const std::vector<SoughtFile>& sought,
                                             const std::string& label, const std::string& which) {
    const std::size_t file = find_file(run, label);
    if (file == kNoFile)
      return Error{ErrorCode::usage, "the " + which + " run has no file '" + label + "'",
                   "--match-files", "it has " + listed(run)};
    if (!sought[file].is_free())
      return Error{ErrorCode::usage,
                   "the file '" + label + "' of the " + which + " run is given twice",
                   "--match-files", "a file is matched with one of the other run"};
    return file;
  }

  void take(std::size_t x, std::size_t y, FileRelation relation) {
    sought_before_[x].partner = y;
    sought_after_[y].partner = x;
    FileMatch match{before_.files[x].label, after_.files[y].label, relation};
    if (relation != FileRelation::same_label) {
      const FileLikeness l = compare_contents(before_, before_.files[x], after_, after_.files[y]);
      match.by_places = l.by_places();
      if (l.is_known()) {
        match.common = l.by_places() ? l.common_places : l.common;
        match.of = l.by_places() ? l.places_before + l.places_after - l.common_places : l.of;
      }
    }
    result_.matches.push_back(std::move(match));
  }

  /// Whether two files are worth comparing: they share ids, or one of them has none.
  [[nodiscard]] bool may_be_one(const FileContents& old_file, const FileContents& new_file) const {
    return old_file.ids.empty() || new_file.ids.empty() ||
           may_have_most(after_, new_file, old_file.ids) ||
           may_have_most(before_, old_file, new_file.ids);
  }

  [[nodiscard]] std::vector<MatchCandidate> candidates() const {
    std::vector<MatchCandidate> found;
    for (std::size_t x = 0; x < sought_before_.size(); ++x)
      for (std::size_t y = 0; sought_before_[x].is_free() && y < sought_after_.size(); ++y) {
        if (!sought_after_[y].is_free() || !may_be_one(before_.files[x], after_.files[y])) continue;
        const FileLikeness l = compare_contents(before_, before_.files[x], after_, after_.files[y]);
        if (l.is_one_file()) found.push_back({x, y, l});
      }
    return found;
  }

  [[nodiscard]] static bool beats_all_rivals(const MatchCandidate& c,
                                             const std::vector<MatchCandidate>& all) {
    return std::ranges::all_of(all, [&](const MatchCandidate& other) {
      const bool shares_old = other.before == c.before, shares_new = other.after == c.after;
      return shares_old == shares_new || is_clearly_more_alike(c.likeness, other.likeness);
    });
  }

  /// Returns the file of the other run that had, or has, most of the ids of a file, none of which
  /// is at its place in the partner of that file.
  [[nodiscard]] PartOf whole_of(std::size_t part, bool of_after) const {
    const RunFiles &own = of_after ? after_ : before_, &other = of_after ? before_ : after_;
    const std::vector<SoughtFile>& sought = of_after ? sought_before_ : sought_after_;
    PartOf found;
    std::vector<std::pair<std::uint64_t, std::size_t>> wholes;
    for (std::size_t w = 0; w < sought.size(); ++w) {
      if (!sought[w].rivals.empty()) continue;
      if (!may_have_most(other, other.files[w], own.files[part].ids)) continue;
      const auto moved = [&](const std::string& id) {
        return has_object(other, other.files[w], id) &&
               (sought[w].partner == kNoFile || !has_object(own, own.files[sought[w].partner], id));
      };
      const auto count =
          static_cast<std::uint64_t>(std::ranges::count_if(own.files[part].ids, moved));
      if (is_most(count, own.files[part].ids.size()) &&
          exceeds_chance(count, own.files[part], other.files[w]))
        wholes.emplace_back(count, w);
    }
    std::ranges::sort(wholes, std::greater<>());
    if (wholes.empty()) return found;
    if (wholes.size() > 1 && !is_clearly_more(wholes[0].first, wholes[1].first)) {
      for (const auto& [count, w] : wholes) found.rivals.push_back(w);
      return found;
    }
    return {wholes[0].second, wholes[0].first, {}};
  }

  void take_part(const PartOf& part, SoughtFile& sought, std::size_t x, std::size_t y,
                 bool of_after) {
    sought.rivals = part.rivals;
    if (part.whole == kNoFile) return;
    sought.is_part = true;
    (of_after ? sought_before_[x] : sought_after_[y]).is_part = true;
    const bool known = std::ranges::any_of(result_.matches, [&](const FileMatch& m) {
      return m.before == before_.files[x].label && m.after == after_.files[y].label;
    });
    if (known) return;
    const FileContents& file = of_after ? after_.files[y] : before_.files[x];
    result_.matches.push_back({before_.files[x].label, after_.files[y].label,
                               of_after ? FileRelation::split : FileRelation::merged, part.common,
                               file.ids.size(), false});
  }

  /// Tells which files of a run are ambiguous, and which have no counterpart.
  void leave_over(const RunFiles& run, const std::vector<SoughtFile>& sought, const RunFiles& other,
                  bool of_after, std::vector<std::string>& only) {
    for (std::size_t i = 0; i < sought.size(); ++i) {
      if (sought[i].is_free()) only.push_back(run.files[i].label);
      if (sought[i].rivals.size() < 2) continue;
      AmbiguousFile& file = result_.ambiguous.emplace_back();
      file.label = run.files[i].label;
      file.of_after = of_after;
      for (const std::size_t rival : sought[i].rivals)
        file.candidates.push_back(other.files[rival].label);
    }
  }

  const RunFiles &before_, &after_;
  std::vector<SoughtFile> sought_before_, sought_after_;
  FileMatches result_;
};

}  // namespace

bool FileMatches::by_label_alone() const {
  return std::ranges::all_of(
      matches, [](const FileMatch& m) { return m.relation == FileRelation::same_label; });
}

Result<FileMatches> match_files(const RunFiles& before, const RunFiles& after,
                                std::span<const FilePair> given_pairs) {
  FileMatcher matcher(before, after);
  if (const Status status = matcher.take_given_pairs(given_pairs); !status) return status.error();
  matcher.take_equal_labels();
  matcher.take_renamed();
  matcher.take_parts();
  return std::move(matcher).result();
}

Result<std::vector<FilePair>> parse_file_pairs(std::span<const std::string> texts,
                                               const RunFiles& before, const RunFiles& after) {
  std::vector<FilePair> pairs;
  for (const std::string& text : texts) {
    std::optional<FilePair> pair;
    for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
      FilePair read{text.substr(0, at), text.substr(at + 1)};
      const bool known =
          find_file(before, read.before) != kNoFile && find_file(after, read.after) != kNoFile;
      // What names no file of the runs is read at the first sign, for the error.
      if (known || !pair) pair = std::move(read);
      if (known) break;
    }
    if (!pair || pair->before.empty() || pair->after.empty())
      return Error{ErrorCode::usage, "'" + text + "' names no two files", "--match-files",
                   "write OLD=NEW, as in ship.glb=ship_revB.glb"};
    pairs.push_back(std::move(*pair));
  }
  return pairs;
}

}  // namespace strake::report
