// SPDX-License-Identifier: Apache-2.0
#include "project/changes/pair_objects.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "strake/core/hash.hpp"

namespace strake::project {
namespace {

/// Objects [first, last) of a model.
struct ObjectRange {
  std::uint32_t first = 0, last = 0;
};

/// Returns the objects of each file of a finished model, which has them file by file.
std::vector<ObjectRange> objects_of_files(const model::Model& model) {
  std::vector<ObjectRange> ranges(model.files.size());
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    ObjectRange& range = ranges[model.objects[o].file];
    if (range.last == 0) range.first = o;
    range.last = o + 1;
  }
  return ranges;
}

/// Two files of which objects may be the same.
struct MatchedFiles {
  ObjectRange before, after;
};

/// Returns the files that are matched, those that are so as a whole first.
std::vector<MatchedFiles> matched_files(const model::Model& then, const model::Model& now,
                                        const report::FileMatches& files) {
  const auto by_label = [](const model::Model& model) {
    std::map<std::string_view, ObjectRange> of_label;
    const std::vector<ObjectRange> ranges = objects_of_files(model);
    for (std::size_t f = 0; f < ranges.size(); ++f)
      of_label.emplace(model.files[f].label, ranges[f]);
    return of_label;
  };
  const auto old_files = by_label(then), new_files = by_label(now);
  std::vector<MatchedFiles> matched;
  for (const bool parts : {false, true})
    for (const report::FileMatch& match : files.matches) {
      const bool is_part = match.relation == report::FileRelation::split ||
                           match.relation == report::FileRelation::merged;
      const auto before = old_files.find(match.before);
      const auto after = new_files.find(match.after);
      if (is_part == parts && before != old_files.end() && after != new_files.end())
        matched.push_back({before->second, after->second});
    }
  return matched;
}

/// An object that has no partner yet, and what its bodies are and where.
struct PlacedObject {
  Hash128 shapes, places;
  std::uint32_t object = 0;

  [[nodiscard]] auto place() const { return std::tie(shapes, places); }
};

class ObjectPairing {
 public:
  ObjectPairing(const PrintedModel& then, const PrintedModel& now)
      : then_(then),
        now_(now),
        pairs_{std::vector<std::uint32_t>(then.model.objects.size(), kNoPartner),
               std::vector<std::uint32_t>(now.model.objects.size(), kNoPartner)} {}

  /// Pairs objects of one id, those whose ids last or all others.
  void by_id(const MatchedFiles& files, bool lasting) {
    std::uint32_t a = files.before.first, b = files.after.first;
    while (a < files.before.last && b < files.after.last) {
      const model::Object &old_object = then_.model.objects[a], &object = now_.model.objects[b];
      const int order = old_object.id.compare(object.id);
      const bool both_last = !old_object.positional_id && !object.positional_id;
      if (order == 0 && both_last == lasting) join(a, b);
      if (order <= 0) ++a;
      if (order >= 0) ++b;
    }
  }

  /// Pairs what has the same shapes at the same place: of several that are alike, those of one id
  /// first, then in the order of their ids.
  void by_place(const MatchedFiles& files) {
    const std::vector<PlacedObject> before = open(then_, pairs_.of_then, files.before);
    const std::vector<PlacedObject> after = open(now_, pairs_.of_now, files.after);
    std::size_t a = 0, b = 0;
    while (a < before.size() && b < after.size()) {
      const std::size_t old_end = end_of_place(before, a), end = end_of_place(after, b);
      if (before[a].place() == after[b].place())
        join_alike(std::span(before).subspan(a, old_end - a), std::span(after).subspan(b, end - b));
      const bool old_first = before[a].place() <= after[b].place();
      const bool new_first = after[b].place() <= before[a].place();
      if (old_first) a = old_end;
      if (new_first) b = end;
    }
  }

  [[nodiscard]] ObjectPairs result() && { return std::move(pairs_); }

 private:
  /// Pairs two objects that have no partners.
  void join(std::uint32_t a, std::uint32_t b) {
    if (pairs_.of_then[a] != kNoPartner || pairs_.of_now[b] != kNoPartner) return;
    pairs_.of_then[a] = b;
    pairs_.of_now[b] = a;
  }

  /// Returns objects with bodies that have no partner, by their places, then by their ids.
  static std::vector<PlacedObject> open(const PrintedModel& model,
                                        const std::vector<std::uint32_t>& partners,
                                        const ObjectRange& range) {
    std::vector<PlacedObject> found;
    for (std::uint32_t o = range.first; o < range.last; ++o)
      if (partners[o] == kNoPartner && model.model.objects[o].body_count > 0)
        found.push_back({model.prints[o].shapes, model.prints[o].places, o});
    std::ranges::sort(found, [](const PlacedObject& x, const PlacedObject& y) {
      return std::tie(x.shapes, x.places, x.object) < std::tie(y.shapes, y.places, y.object);
    });
    return found;
  }

  static std::size_t end_of_place(const std::vector<PlacedObject>& objects, std::size_t from) {
    std::size_t end = from + 1;
    while (end < objects.size() && objects[end].place() == objects[from].place()) ++end;
    return end;
  }

  void join_alike(std::span<const PlacedObject> before, std::span<const PlacedObject> after) {
    for (std::size_t a = 0, b = 0; a < before.size() && b < after.size();) {
      const int order =
          then_.model.objects[before[a].object].id.compare(now_.model.objects[after[b].object].id);
      if (order == 0) join(before[a].object, after[b].object);
      if (order <= 0) ++a;
      if (order >= 0) ++b;
    }
    for (std::size_t a = 0, b = 0; a < before.size() && b < after.size();) {
      if (pairs_.of_then[before[a].object] != kNoPartner)
        ++a;
      else if (pairs_.of_now[after[b].object] != kNoPartner)
        ++b;
      else
        join(before[a].object, after[b].object);
    }
  }

  const PrintedModel &then_, &now_;
  ObjectPairs pairs_;
};

}  // namespace

ObjectPairs pair_objects(const PrintedModel& then, const PrintedModel& now,
                         const report::FileMatches& files) {
  const std::vector<MatchedFiles> matched = matched_files(then.model, now.model, files);
  ObjectPairing pairing(then, now);
  for (const MatchedFiles& both : matched) pairing.by_id(both, true);
  for (const MatchedFiles& both : matched) pairing.by_place(both);
  for (const MatchedFiles& both : matched) pairing.by_id(both, false);
  return std::move(pairing).result();
}

}  // namespace strake::project
