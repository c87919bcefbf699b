// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_diff.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace strake::report {
namespace {

/// Below this a difference of d is that of the grid.
constexpr double kSameMm = 1e-3;

int severity(std::string_view cls) {
  if (cls == "HIT") return 2;
  return cls == "CONTACT" ? 1 : 0;
}

/// The order in which results want to be looked at.
int attention(const DocumentResult& r) {
  const int rank = r.cls == "HIT" ? 0 : r.cls == "CLEARANCE_VIOLATION" ? 1 : 2;
  return r.allowed.empty() ? rank : rank + 3;
}

void sort_entries(std::vector<DiffEntry>& entries) {
  std::ranges::sort(entries, [](const DiffEntry& x, const DiffEntry& y) {
    const DocumentResult &p = x.either(), &q = y.either();
    return std::tuple(attention(p), p.d_mm, std::string_view(p.key)) <
           std::tuple(attention(q), q.d_mm, std::string_view(q.key));
  });
}

std::string named(const DocumentObject& o) {
  return "'" + (o.name.empty() ? o.id : o.name) + "' of " + o.file;
}

std::string of_test(const DocumentTest& test) {
  return test.name.empty() ? std::string() : " of test '" + test.name + "'";
}

/// Whether a run looked at a pair, and if not, why.
class Looks {
 public:
  explicit Looks(const ClashDocument& run) : run_(run) {
    for (const DocumentTest& test : run.tests) tests_.emplace(test.name, &test);
  }

  [[nodiscard]] const DocumentTest* test(const std::string& name) const {
    const auto it = tests_.find(name);
    return it == tests_.end() ? nullptr : it->second;
  }

  /// Why a result that the other run has under `other` may be missing here; empty: it is not so.
  [[nodiscard]] std::string reason(const DocumentResult& r, const DocumentTest& other) const {
    const DocumentTest* const here = test(other.name);
    if (here == nullptr) return "there is no test '" + other.name + "'";
    for (const DocumentObject* o : {&r.a, &r.b})
      if (!std::ranges::binary_search(run_.elements, o->hash))
        return named(*o) + " is not in the model";
    if (std::string why = not_tested(r, *here); !why.empty()) return why;
    if (const auto rule = run_.exempted.find(r.key); rule != run_.exempted.end())
      return "exempted by " + rule->second;
    if (!run_.lists_exempted && here->exempted_pairs > 0)
      return "may be among the " + std::to_string(here->exempted_pairs) +
             " exempted pairs, which are not listed";
    return by_settings(r, *here, other);
  }

 private:
  [[nodiscard]] std::string not_tested(const DocumentResult& r, const DocumentTest& here) const {
    if (!here.within_files && r.a.file == r.b.file)
      return "pairs within a file are not looked at" + of_test(here);
    for (const DocumentObject* o : {&r.a, &r.b})
      if (!in(here.in_a, o->hash) && !in(here.in_b, o->hash))
        return named(*o) + " is in neither set" + of_test(here);
    const bool opposite = (in(here.in_a, r.a.hash) && in(here.in_b, r.b.hash)) ||
                          (in(here.in_a, r.b.hash) && in(here.in_b, r.a.hash));
    return opposite ? std::string() : "both are in the same set" + of_test(here);
  }

  [[nodiscard]] bool in(const std::vector<std::uint8_t>& set, std::uint64_t hash) const {
    const auto it = std::ranges::lower_bound(run_.elements, hash);
    const auto i = static_cast<std::size_t>(it - run_.elements.begin());
    return ((set[i / 8] >> (i % 8)) & 1U) != 0;
  }

  /// A pair as far apart as the other run found it would be no result here.
  [[nodiscard]] static std::string by_settings(const DocumentResult& r, const DocumentTest& here,
                                               const DocumentTest& other) {
    if (here.has_matrix || other.has_matrix) {
      for (const auto& [name, value] : other.settings) {
        const auto it = here.settings.find(name);
        if (it == here.settings.end() || it->second != value) return "settings differ: " + name;
      }
      return {};
    }
    const auto curves = [](const DocumentTest& test) {
      const auto it = test.settings.find("curves");
      return it != test.settings.end() && it->second == "true";
    };
    if (!curves(here) && curves(other)) return "settings differ: curves";
    if (r.d_mm <= here.touch_gap_mm || r.d_mm < here.clearance_mm) return {};
    const bool clearance = here.clearance_mm != other.clearance_mm;
    return std::string("settings differ: ") + (clearance ? "clearance_mm" : "touch_gap_mm");
  }

  const ClashDocument& run_;
  std::map<std::string, const DocumentTest*> tests_;
};

bool still_the_same(const DocumentResult& x, const DocumentResult& y) {
  return x.cls == y.cls && x.allowed == y.allowed && std::fabs(x.d_mm - y.d_mm) <= kSameMm;
}

using ByKey = std::unordered_map<std::string_view, const DocumentResult*>;

ByKey by_key(const ClashDocument& run) {
  ByKey map;
  map.reserve(run.results.size());
  for (const DocumentResult& r : run.results) map.emplace(r.key, &r);
  return map;
}

void compare_settings(const Looks& before, const Looks& after, ClashDiff& diff) {
  for (const DocumentTest& test : diff.before->tests) {
    const DocumentTest* const other = after.test(test.name);
    if (other == nullptr) {
      diff.tests_gone.push_back(test.name);
      continue;
    }
    std::map<std::string, std::pair<std::string, std::string>> values;
    for (const auto& [name, value] : test.settings) values[name].first = value;
    for (const auto& [name, value] : other->settings) values[name].second = value;
    for (const auto& [name, value] : values)
      if (value.first != value.second)
        diff.settings.push_back({test.name, name, value.first, value.second});
  }
  for (const DocumentTest& test : diff.after->tests)
    if (before.test(test.name) == nullptr) diff.tests_added.push_back(test.name);
}

}  // namespace

bool ClashDiff::has_new(bool hits_only) const {
  return std::ranges::any_of(added, [&](const DiffEntry& e) {
    return e.after->allowed.empty() && (!hits_only || e.after->cls == "HIT");
  });
}

bool ClashDiff::has_worse() const {
  return has_new(false) || std::ranges::any_of(changed, [](const DiffEntry& e) {
           if (!e.after->allowed.empty()) return false;
           return !e.before->allowed.empty() || severity(e.after->cls) > severity(e.before->cls) ||
                  (e.after->cls == e.before->cls && e.after->d_mm < e.before->d_mm - kSameMm);
         });
}

ClashDiff compare(const ClashDocument& before, const ClashDocument& after) {
  ClashDiff diff;
  diff.before = &before;
  diff.after = &after;
  const Looks looks_before(before), looks_after(after);
  compare_settings(looks_before, looks_after, diff);
  const ByKey old_results = by_key(before), new_results = by_key(after);
  for (const DocumentResult& r : after.results) {
    const auto was = old_results.find(r.key);
    if (was == old_results.end())
      diff.added.push_back({nullptr, &r, looks_before.reason(r, after.tests[r.test])});
    else
      (still_the_same(*was->second, r) ? diff.same : diff.changed).push_back({was->second, &r, {}});
  }
  for (const DocumentResult& r : before.results) {
    if (new_results.contains(r.key)) continue;
    std::string why = looks_after.reason(r, before.tests[r.test]);
    (why.empty() ? diff.gone : diff.cannot_tell).push_back({&r, nullptr, std::move(why)});
  }
  for (std::vector<DiffEntry>* list :
       {&diff.added, &diff.changed, &diff.same, &diff.gone, &diff.cannot_tell})
    sort_entries(*list);
  return diff;
}

}  // namespace strake::report
