// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/merge.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "hlr/results/object_fates.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::hlr {
namespace {

/// A run of elements of one of two arrays.
struct ElementRun {
  std::size_t first = 0, last = 0;
  bool fresh = false;  ///< of the new array
  [[nodiscard]] std::size_t size() const { return last - first; }
};

/// Puts runs together, of `kept` in ascending order and of `fresh` in any. They stay in their
/// memory where that holds them, as most of a drawing does not change. Errors: cancelled, out of
/// memory; then `kept` is of no use.
template <class T>
[[nodiscard]] Status splice(std::span<const ElementRun> runs, std::span<const T> fresh,
                            std::vector<T>& kept, const parallel::Context& context) {
  std::vector<std::size_t> begin(runs.size() + 1);
  for (std::size_t r = 0; r < runs.size(); ++r) begin[r + 1] = begin[r] + runs[r].size();
  const std::size_t total = begin.back();
  if (total <= kept.capacity()) {
    const auto move = [&](std::size_t r, bool up) {
      if (runs[r].fresh || (begin[r] > runs[r].first) != up || begin[r] == runs[r].first) return;
      const auto from = kept.begin() + static_cast<std::ptrdiff_t>(runs[r].first);
      const auto end = kept.begin() + static_cast<std::ptrdiff_t>(runs[r].last);
      const auto to = kept.begin() + static_cast<std::ptrdiff_t>(begin[r]);
      if (up)
        std::move_backward(from, end, to + static_cast<std::ptrdiff_t>(runs[r].size()));
      else
        std::move(from, end, to);
    };
    // What goes up makes room from the end on, what goes down from the start on: no run is
    // overwritten before it is moved.
    if (total > kept.size()) kept.resize(total);
    for (std::size_t r = runs.size(); r-- > 0;) move(r, true);
    for (std::size_t r = 0; r < runs.size(); ++r) move(r, false);
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (runs[r].fresh)
        std::ranges::copy(fresh.subspan(runs[r].first, runs[r].size()),
                          kept.begin() + static_cast<std::ptrdiff_t>(begin[r]));
    kept.resize(total);
    return {};
  }
  auto all = parallel::slots<T>(total, context);
  if (!all) return all.error();
  /// Only shares the work out: between 16'384 and 262'144 no difference can be seen (decision
  /// 0073).
  constexpr std::size_t kBlock = 65536;
  const Status status = parallel::for_each(
      context, {.name = "what stays of a drawing", .n = (total + kBlock - 1) / kBlock},
      [&](std::size_t block) {
        std::size_t at = block * kBlock;
        const std::size_t end = std::min(total, at + kBlock);
        auto r = static_cast<std::size_t>(std::ranges::upper_bound(begin, at) - begin.begin()) - 1;
        for (; at < end; ++r) {
          const std::size_t count = std::min(end, begin[r + 1]) - at;
          const std::span<const T> from = runs[r].fresh ? fresh : std::span<const T>(kept);
          std::ranges::copy(from.subspan(runs[r].first + (at - begin[r]), count),
                            all->begin() + static_cast<std::ptrdiff_t>(at));
          at += count;
        }
      });
  if (!status) return status;
  kept = std::move(*all);
  return {};
}

// Only shares the work out: between 4096 and 65'536 no difference can be seen (decision 0073).
constexpr std::size_t kLinesAtOnce = 16384;
constexpr auto kByObject = [](const auto& line) { return model::index(line.object); };

/// Objects that follow each other in both drawings, or now only.
struct ObjectRun {
  std::uint32_t first = 0, last = 0;  ///< numbers now
  std::uint32_t before = 0;           ///< number of the first in the earlier drawing
  bool fresh = false;                 ///< found anew
};

/// Returns the objects with lines, in order.
std::vector<ObjectRun> object_runs_of(const Comparison& comparison,
                                      const std::vector<bool>& to_solve) {
  std::vector<ObjectRun> all;
  const auto& before = comparison.before;
  for (std::uint32_t o = 0; o < before.size(); ++o) {
    const bool fresh = to_solve[o];
    if (!fresh && before[o] == model::kNoObject) continue;
    ObjectRun* const last = all.empty() ? nullptr : &all.back();
    const bool goes_on = last != nullptr && last->fresh == fresh && last->last == o &&
                         (fresh || before[o] == last->before + (o - last->first));
    if (goes_on)
      ++last->last;
    else
      all.push_back({o, o + 1, before[o], fresh});
  }
  return all;
}

/// Returns where the lines of a range of objects are, in an array that is sorted by object.
template <class T>
ElementRun run_of(std::span<const T> sorted, std::uint32_t first, std::uint32_t last) {
  const auto at = [&](std::uint32_t object) {
    return static_cast<std::size_t>(std::ranges::lower_bound(sorted, object, {}, kByObject) -
                                    sorted.begin());
  };
  return {at(first), at(last)};
}

template <class T>
std::vector<ElementRun> runs_of(std::span<const ObjectRun> object_runs, std::span<const T> kept,
                                std::span<const T> fresh) {
  std::vector<ElementRun> runs;
  for (const ObjectRun& s : object_runs) {
    ElementRun run = s.fresh ? run_of(fresh, s.first, s.last)
                             : run_of(kept, s.before, s.before + (s.last - s.first));
    run.fresh = s.fresh;
    runs.push_back(run);
  }
  return runs;
}

/// Returns by earlier number the number now; model::kNoObject for those that are gone.
std::vector<std::uint32_t> numbers_now(const Comparison& comparison, std::size_t earlier) {
  std::vector<std::uint32_t> now(earlier, model::kNoObject);
  for (std::uint32_t o = 0; o < comparison.before.size(); ++o)
    if (comparison.before[o] != model::kNoObject) now[comparison.before[o]] = o;
  return now;
}

/// Gives the lines that stay the numbers of their objects now.
template <class T, class Renumber>
Status renumber(std::vector<T>& lines, const parallel::Context& context, Renumber&& each) {
  return parallel::for_each(context,
                            {.name = "numbers now", .n = lines.size(), .grain = kLinesAtOnce},
                            [&](std::size_t i) { each(lines[i]); });
}

Status merge_pieces(const Comparison& comparison, const ResolvedLines& resolved,
                    std::span<const ObjectRun> object_runs, Drawing& drawing,
                    const parallel::Context& context) {
  const std::vector<ElementRun> runs =
      runs_of<EdgePiece>(object_runs, drawing.pieces, resolved.drawing.pieces);
  if (!comparison.same_numbers) {
    const auto now = numbers_now(comparison, drawing.counted.size());
    const auto number = [&](model::ObjectId& object) {
      object = model::ObjectId{now[model::index(object)]};
    };
    const Status status = renumber(drawing.pieces, context, [&](EdgePiece& piece) {
      number(piece.object);
      number(piece.other);
    });
    if (!status) return status;
  }
  return splice<EdgePiece>(runs, resolved.drawing.pieces, drawing.pieces, context);
}

/// Returns the curves that the edges of a run lie on: edges of an object begin with its first one.
ElementRun curves_under(const Curves& curves, const ElementRun& edges) {
  const auto curve = [&](std::size_t edge) {
    return edge < curves.edges.size() ? curves.edges[edge].curve : curves.all.size();
  };
  return {curve(edges.first), edges.size() == 0 ? curve(edges.first) : curve(edges.last),
          edges.fresh};
}

Status merge_curves(const Comparison& comparison, const ResolvedLines& resolved,
                    std::span<const ObjectRun> object_runs, Curves& curves, std::size_t earlier,
                    const parallel::Context& context) {
  const Curves& fresh = resolved.drawing.curves;
  if (curves.edges.empty() && fresh.edges.empty()) return {};
  const std::vector<ElementRun> edges = runs_of<CurvedEdge>(object_runs, curves.edges, fresh.edges);
  std::vector<ElementRun> runs;
  std::vector<std::size_t> first, to;  // by run, of its edges and of its curves
  std::size_t edges_before = 0, curves_before = 0;
  for (const ElementRun& run : edges) {
    runs.push_back(curves_under(run.fresh ? fresh : curves, run));
    first.push_back(edges_before);
    to.push_back(curves_before);
    edges_before += run.size();
    curves_before += runs.back().size();
  }
  first.push_back(edges_before);
  const auto now = numbers_now(comparison, earlier);
  if (Status s = splice<CurvedEdge>(edges, fresh.edges, curves.edges, context); !s) return s;
  if (Status s = splice<Curve>(runs, fresh.all, curves.all, context); !s) return s;
  return parallel::for_each(
      context, {.name = "curves of what stays", .n = runs.size()}, [&](std::size_t r) {
        for (std::size_t e = first[r]; e < first[r + 1]; ++e) {
          CurvedEdge& edge = curves.edges[e];
          if (!runs[r].fresh) edge.object = model::ObjectId{now[model::index(edge.object)]};
          edge.curve = static_cast<std::uint32_t>(edge.curve - runs[r].first + to[r]);
        }
      });
}

/// Returns values by object now, from those of the earlier drawing and those that are new.
template <class T>
std::vector<T> merged(const Comparison& comparison, const std::vector<bool>& to_solve,
                      const std::vector<T>& earlier, const std::vector<T>& fresh) {
  std::vector<T> now(comparison.before.size());
  for (std::size_t o = 0; o < now.size(); ++o) {
    const std::uint32_t before = comparison.before[o];
    if (to_solve[o])
      now[o] = fresh[o];
    else if (before != model::kNoObject)
      now[o] = earlier[before];
  }
  return now;
}

/// Returns how many objects that are drawn lack some of their geometry, but not all.
std::uint64_t count_in_part(const model::Scene& scene, const std::vector<bool>& drawn) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < scene.lacking.size(); ++i) {
    const model::ObjectId object = scene.lacking[i].object;
    if (i > 0 && scene.lacking[i - 1].object == object) continue;
    if ((drawn.empty() || drawn[model::index(object)]) && !scene.bodies_of(object).empty()) ++count;
  }
  return count;
}

}  // namespace

Status merge_lines(const Comparison& comparison, const ResolvedLines& resolved, Drawing& earlier,
                   const parallel::Context& context) {
  const std::vector<ObjectRun> object_runs = object_runs_of(comparison, resolved.to_solve);
  const std::size_t objects = earlier.counted.size();
  if (Status s = merge_pieces(comparison, resolved, object_runs, earlier, context); !s) return s;
  if (Status s = merge_curves(comparison, resolved, object_runs, earlier.curves, objects, context);
      !s)
    return s;
  earlier.counted =
      merged(comparison, resolved.to_solve, earlier.counted, resolved.drawing.counted);
  if (!earlier.options.hidden)
    earlier.left_out =
        merged(comparison, resolved.to_solve, earlier.left_out, resolved.drawing.left_out);
  if (!earlier.options.clipped)
    earlier.clipped_left_out = merged(comparison, resolved.to_solve, earlier.clipped_left_out,
                                      resolved.drawing.clipped_left_out);
  return {};
}

Status merge_account(const model::Scene& scene, const std::vector<bool>& drawn,
                     const Comparison& comparison, const ResolvedLines& resolved, Drawing& drawing,
                     const parallel::Context& context) {
  auto fresh = account_of(scene, resolved.to_solve, resolved.drawing, context);
  if (!fresh) return fresh.error();
  Account& account = drawing.account;
  const auto now = numbers_now(comparison, account.fates.size());
  std::vector<Defect> kept, defects;
  for (Defect defect : account.defects) {
    const std::uint32_t object = now[model::index(defect.object)];
    if (object == model::kNoObject || resolved.to_solve[object]) continue;
    defect.object = model::ObjectId{object};
    kept.push_back(defect);
  }
  std::ranges::merge(kept, fresh->defects, std::back_inserter(defects), {}, &Defect::object,
                     &Defect::object);
  account.defects = std::move(defects);
  account.fates = merged(comparison, resolved.to_solve, account.fates, fresh->fates);
  account.count = {};
  for (const Fate fate : account.fates) ++account.count[static_cast<std::size_t>(fate)];
  account.in_part = count_in_part(scene, drawn);
  return {};
}

}  // namespace strake::hlr
