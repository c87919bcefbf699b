// SPDX-License-Identifier: Apache-2.0
#include "report/files/file_likeness.hpp"

#include <algorithm>
#include <string>

namespace strake::report {
namespace {

/// Returns how many ids in common tell by themselves that two files of so many places have to do
/// with each other. One or two may be chance (`cube`); so may a handful, which may be what a
/// program calls whatever has no name (`Cube.001`), where nothing in one file lies at a place of
/// the other.
std::uint64_t fewest_ids(std::uint64_t places, std::uint64_t other_places, std::uint64_t common) {
  constexpr std::uint64_t kFewest = 3, kFewestElsewhere = 20;
  return places > 0 && other_places > 0 && common == 0 ? kFewestElsewhere : kFewest;
}

/// Returns how many values two ascending lists share.
template <class T>
std::uint64_t count_common(const std::vector<T>& x, const std::vector<T>& y) {
  std::uint64_t count = 0;
  auto a = x.begin();
  auto b = y.begin();
  while (a != x.end() && b != y.end()) {
    if (*a == *b)
      ++count, ++a, ++b;
    else if (*a < *b)
      ++a;
    else
      ++b;
  }
  return count;
}

/// Counts the ids of either file that the run of the other has.
void count_common_ids(FileLikeness& l, const RunFiles& before, const FileContents& old_file,
                      const RunFiles& after, const FileContents& new_file) {
  for (const std::string& id : old_file.ids)
    if (has_object(after, new_file, id)) ++l.found_after;
  std::uint64_t named_by_both = 0, found_of_new_only = 0;
  for (const std::string& id : new_file.ids) {
    const bool named = std::ranges::binary_search(old_file.ids, id);
    if (named) ++named_by_both;
    if (!named && !has_object(before, old_file, id)) continue;
    ++l.found_before;
    if (!named) ++found_of_new_only;
  }
  l.common = l.found_after + found_of_new_only;
  l.of = l.ids_before + l.ids_after - named_by_both;
}

bool places_agree(const FileLikeness& l) {
  // One place or two of an excerpt may be chance.
  constexpr std::uint64_t kFewest = 3;
  return is_most(l.common_places, l.places_before) &&
         (is_most(l.common_places, l.places_after) || (l.is_excerpt && l.common_places >= kFewest));
}

}  // namespace

bool FileLikeness::is_one_file() const {
  if (by_places()) return places_agree(*this);
  const bool most_of_both = (ids_before == 0 || is_most(found_after, ids_before)) &&
                            (is_excerpt || ids_after == 0 || is_most(found_before, ids_after));
  const bool no_chance = common >= fewest_ids(places_before, places_after, common_places);
  return most_of_both && (no_chance || places_agree(*this));
}

FileLikeness compare_contents(const RunFiles& before, const FileContents& old_file,
                              const RunFiles& after, const FileContents& new_file) {
  FileLikeness l;
  l.is_excerpt = before.is_excerpt;
  l.ids_before = old_file.ids.size();
  l.ids_after = new_file.ids.size();
  if (before.has || after.has) {
    count_common_ids(l, before, old_file, after, new_file);
  } else {
    // The ids are all that there are: one walk along both lists finds those of both.
    l.common = l.found_after = l.found_before = count_common(old_file.ids, new_file.ids);
    l.of = l.ids_before + l.ids_after - l.common;
  }
  l.places_before = old_file.places.size();
  l.places_after = new_file.places.size();
  l.common_places = count_common(old_file.places, new_file.places);
  return l;
}

bool has_object(const RunFiles& run, const FileContents& file, std::string_view id) {
  if (run.has) return run.has(file.label, id);
  return std::ranges::binary_search(file.ids, id, std::less<>());
}

bool may_have_most(const RunFiles& run, const FileContents& file,
                   const std::vector<std::string>& ids) {
  constexpr std::size_t kSampledIds = 64;
  const std::size_t step = std::max<std::size_t>(1, ids.size() / kSampledIds);
  for (std::size_t i = 0; i < ids.size(); i += step)
    if (has_object(run, file, ids[i])) return true;
  return false;
}

bool exceeds_chance(std::uint64_t ids, const FileContents& file, const FileContents& other) {
  return ids >= fewest_ids(file.places.size(), other.places.size(),
                           count_common(file.places, other.places));
}

bool is_clearly_more_alike(const FileLikeness& one, const FileLikeness& rival) {
  if (is_clearly_more(one.common, rival.common)) return true;
  if (is_clearly_more(rival.common, one.common)) return false;
  return is_clearly_more(one.common_places, rival.common_places);
}

}  // namespace strake::report
