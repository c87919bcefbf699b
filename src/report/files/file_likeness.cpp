// SPDX-License-Identifier: Apache-2.0
#include "report/files/file_likeness.hpp"

#include <algorithm>
#include <string>

namespace strake::report {
namespace {

/// Returns how many hashes two ascending lists share.
std::uint64_t count_common(const std::vector<Hash128>& x, const std::vector<Hash128>& y) {
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

bool places_agree(const FileLikeness& l) {
  return is_most(l.common_places, l.places_before) && is_most(l.common_places, l.places_after);
}

}  // namespace

bool FileLikeness::is_one_file() const {
  if (by_places()) return places_agree(*this);
  const bool most_of_both = (ids_before == 0 || is_most(found_after, ids_before)) &&
                            (ids_after == 0 || is_most(found_before, ids_after));
  return most_of_both && (common >= kFewestIds || places_agree(*this));
}

FileLikeness likeness(const RunFiles& before, const FileContents& old_file, const RunFiles& after,
                      const FileContents& new_file) {
  FileLikeness l;
  l.ids_before = old_file.ids.size();
  l.ids_after = new_file.ids.size();
  for (const std::string& id : old_file.ids) l.found_after += has_object(after, new_file, id);
  std::uint64_t named_by_both = 0, named_by_new_only = 0;
  for (const std::string& id : new_file.ids) {
    const bool named = std::ranges::binary_search(old_file.ids, id);
    const bool found = named || has_object(before, old_file, id);
    l.found_before += found;
    named_by_both += named;
    named_by_new_only += found && !named;
  }
  l.common = l.found_after + named_by_new_only;
  l.of = l.ids_before + l.ids_after - named_by_both;
  l.places_before = old_file.places.size();
  l.places_after = new_file.places.size();
  l.common_places = count_common(old_file.places, new_file.places);
  return l;
}

bool has_object(const RunFiles& run, const FileContents& file, std::string_view id) {
  if (run.has) return run.has(file.label, id);
  return std::ranges::binary_search(file.ids, id, std::less<>());
}

bool is_clearly_more_alike(const FileLikeness& one, const FileLikeness& rival) {
  if (is_clearly_more(one.common, rival.common)) return true;
  if (is_clearly_more(rival.common, one.common)) return false;
  return is_clearly_more(one.common_places, rival.common_places);
}

}  // namespace strake::report
