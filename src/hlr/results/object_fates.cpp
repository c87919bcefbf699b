// SPDX-License-Identifier: Apache-2.0
#include "hlr/results/object_fates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hlr/prepare/view_diagnostics.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::hlr {
namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kObjectsPerItem = 4096;

std::uint32_t object_of(const EdgePiece& piece) { return model::index(piece.object); }

bool is_visible(const EdgePiece& piece) { return piece.state == State::visible; }

/// Pieces of a drawing by where they stand in it: from `first` to before `last`.
struct PieceRange {
  std::size_t first = 0, last = 0;
};

/// The code of an object all of whose lines run along the view direction. Every wire of a model may
/// be seen end-on in some view, so this is reported but is no defect of the data.
constexpr std::string_view kOnlyPoints = "only-points";

constexpr std::string_view kDegenerate = "object-degenerate", kFailed = "object-failed",
                           kInPart = "object-in-part";

/// Returns where the pieces of an object end that begin at `first`: by steps that double, as most
/// objects have a few and some a million.
std::size_t end_of_object(std::span<const EdgePiece> pieces, std::size_t first) {
  const std::uint32_t object = object_of(pieces[first]);
  std::size_t step = 1;
  while (step < pieces.size() - first && object_of(pieces[first + step]) == object) {
    first += step;
    step *= 2;
  }
  const auto ahead = pieces.subspan(first, std::min(step, pieces.size() - first));
  return first + static_cast<std::size_t>(std::ranges::upper_bound(ahead, object, {}, object_of) -
                                          ahead.begin());
}

/// Returns whether any body of an object has faces.
bool has_faces(const model::Scene& scene, std::uint32_t object) {
  for (std::uint32_t b = scene.first_body[object]; b < scene.first_body[object + 1]; ++b)
    for (const geometry::Part& part : scene.shapes[scene.bodies[b].grid_shape].parts)
      if (!part.triangles.empty()) return true;
  return false;
}

/// Returns the fate of an object that is on the grid, by its lines; advances `next` beyond them.
/// It looks at no more of them than it must: pieces of millions are in no cache.
Fate fate_of(const model::Scene& scene, std::uint32_t object, const Drawing& drawing,
             std::size_t& next) {
  const std::span<const EdgePiece> pieces = drawing.pieces;
  bool point = false;
  bool clipped = !drawing.clipped_left_out.empty() && drawing.clipped_left_out[object] > 0;
  bool hidden = !drawing.left_out.empty() && drawing.left_out[object] > 0;
  for (; next < pieces.size() && object_of(pieces[next]) == object; ++next) {
    const State state = pieces[next].state;
    if (state == State::visible) {
      next = end_of_object(pieces, next);
      return Fate::drawn;
    }
    hidden = hidden || state == State::hidden_by_self || state == State::hidden_by_other;
    clipped = clipped || state == State::clipped;
    point = point || state == State::projecting;
  }
  if (hidden) return Fate::hidden;
  if (point) return Fate::degenerate;
  // Smooth faces all round an eye have neither edge nor contour, and show no line: that is no
  // defect of theirs.
  return clipped || (drawing.view.perspective && has_faces(scene, object)) ? Fate::clipped
                                                                           : Fate::degenerate;
}

std::span<const model::IncompleteObject> lacking_of(const model::Scene& scene,
                                                    std::uint32_t object) {
  const auto found = std::ranges::equal_range(scene.lacking, model::ObjectId{object}, {},
                                              &model::IncompleteObject::object);
  return {found.begin(), found.end()};
}

/// Returns the fate of an object that has no body on the grid.
Fate fate_without_body(const model::Scene& scene, std::uint32_t object) {
  const auto lacking = lacking_of(scene, object);
  if (lacking.empty())
    return scene.model->objects[object].body_count > 0 ? Fate::left_out : Fate::degenerate;
  const bool vanished = std::ranges::all_of(
      lacking, [](const model::IncompleteObject& l) { return l.code == model::kVanished; });
  return vanished ? Fate::degenerate : Fate::failed;
}

/// Returns the objects that are drawn and lack some of their geometry, or are degenerate.
Result<std::vector<std::uint32_t>> objects_with_defects(const model::Scene& scene,
                                                        const Account& account,
                                                        const parallel::Context& context) {
  if (scene.lacking.empty() && account.of(Fate::degenerate) == 0)
    return std::vector<std::uint32_t>{};
  return parallel::collect<std::uint32_t>(
      context,
      {.name = "objects with defects", .n = account.fates.size(), .grain = kObjectsPerItem},
      [&](std::size_t o, std::vector<std::uint32_t>& out) {
        const auto object = static_cast<std::uint32_t>(o);
        const Fate fate = account.fates[object];
        if (fate != Fate::unselected &&
            (fate == Fate::degenerate || !lacking_of(scene, object).empty()))
          out.push_back(object);
      });
}

Status list_defects(const model::Scene& scene, std::span<const EdgePiece> pieces, Account& account,
                    const parallel::Context& context) {
  const auto defective = objects_with_defects(scene, account, context);
  if (!defective) return defective.error();
  for (const std::uint32_t object : *defective) {
    const auto lacking = lacking_of(scene, object);
    const bool placed = scene.first_body[object] < scene.first_body[object + 1];
    if (placed && !lacking.empty()) ++account.in_part;
    for (const model::IncompleteObject& l : lacking) account.defects.push_back({l.object, l.code});
    if (!lacking.empty()) continue;
    const bool points = std::ranges::binary_search(pieces, object, {}, object_of);
    account.defects.push_back({model::ObjectId{object}, points ? kOnlyPoints : "no-lines"});
  }
  return {};
}

}  // namespace

void make_room_for_counts(const Options& options, std::size_t objects, Drawing& drawing) {
  drawing.counted.resize(objects);
  if (!options.hidden) drawing.left_out.resize(objects);
  if (!options.clipped) drawing.clipped_left_out.resize(objects);
}

Status leave_out_hidden_objects(const parallel::Context& context, Drawing& drawing) {
  const std::span<const EdgePiece> pieces = drawing.pieces;
  const std::span<const std::uint32_t> left_out = drawing.left_out;
  const auto unseen = parallel::collect<PieceRange>(
      context,
      {.name = "objects without a visible line",
       .n = (left_out.size() + kObjectsPerItem - 1) / kObjectsPerItem},
      [&](std::size_t item, std::vector<PieceRange>& out) {
        const std::size_t begin = item * kObjectsPerItem;
        const std::size_t end = std::min(left_out.size(), begin + kObjectsPerItem);
        auto rest = pieces.begin();
        for (std::size_t object = begin; object < end; ++object) {
          if (left_out[object] == 0) continue;
          const auto of = std::ranges::equal_range(
              rest, pieces.end(), static_cast<std::uint32_t>(object), {}, object_of);
          rest = of.end();
          if (std::ranges::any_of(of, is_visible)) continue;
          if (!drawing.clipped_left_out.empty()) drawing.clipped_left_out[object] = 0;
          if (!of.empty())
            out.push_back({static_cast<std::size_t>(of.begin() - pieces.begin()),
                           static_cast<std::size_t>(of.end() - pieces.begin())});
        }
      });
  if (!unseen) return unseen.error();
  if (unseen->empty()) return {};
  const auto at = [&](std::size_t i) {
    return drawing.pieces.begin() + static_cast<std::ptrdiff_t>(i);
  };
  auto kept = at(unseen->front().first);
  for (std::size_t i = 0; i < unseen->size(); ++i) {
    const std::size_t next = i + 1 < unseen->size() ? (*unseen)[i + 1].first : pieces.size();
    kept = std::move(at((*unseen)[i].last), at(next), kept);
  }
  drawing.pieces.erase(kept, drawing.pieces.end());
  return {};
}

Result<Account> account_of(const model::Scene& scene, const std::vector<bool>& drawn,
                           const Drawing& drawing, const parallel::Context& context) {
  const std::span<const EdgePiece> pieces = drawing.pieces;
  Account account;
  account.fates.resize(drawn.size());
  using Counts = std::array<std::uint64_t, kFates>;
  const auto count = parallel::reduce(
      context,
      {.name = "account of objects", .n = (drawn.size() + kObjectsPerItem - 1) / kObjectsPerItem},
      Counts{},
      [&](Counts& of_fate, std::size_t item) {
        const auto begin = static_cast<std::uint32_t>(item * kObjectsPerItem);
        const auto end =
            static_cast<std::uint32_t>(std::min(drawn.size(), begin + kObjectsPerItem));
        auto next = static_cast<std::size_t>(
            std::ranges::lower_bound(pieces, begin, {}, object_of) - pieces.begin());
        for (std::uint32_t object = begin; object < end; ++object) {
          Fate& fate = account.fates[object];
          if (drawn[object])
            fate = scene.first_body[object] < scene.first_body[object + 1]
                       ? fate_of(scene, object, drawing, next)
                       : fate_without_body(scene, object);
          ++of_fate[static_cast<std::size_t>(fate)];
        }
      },
      [](Counts& into, const Counts& of_fate) {
        for (std::size_t f = 0; f < kFates; ++f) into[f] += of_fate[f];
      });
  if (!count) return count.error();
  account.count = *count;
  if (const Status status = list_defects(scene, pieces, account, context); !status)
    return status.error();
  return account;
}

void sum_up_lines(Drawing& drawing) {
  Counters& counters = drawing.counters;
  counters.feature_edges = counters.specks = counters.left_out = 0;
  for (const LineCount& count : drawing.counted) {
    counters.feature_edges += count.edges;
    counters.specks += count.specks;
  }
  for (const std::uint32_t edges : drawing.left_out) counters.left_out += edges;
}

void report_defects(const model::Model& model, const Account& account, Diagnostics& diagnostics) {
  for (std::size_t d = 0; d < account.defects.size();) {
    const model::ObjectId id = account.defects[d].object;
    std::string codes;
    for (; d < account.defects.size() && account.defects[d].object == id; ++d)
      codes.append(codes.empty() ? "" : ", ").append(account.defects[d].code);
    if (codes == kOnlyPoints) continue;
    const Fate fate = account.fates[model::index(id)];
    const bool degenerate = fate == Fate::degenerate, failed = fate == Fate::failed;
    const std::string_view code = degenerate ? kDegenerate : failed ? kFailed : kInPart;
    const std::string_view words =
        degenerate ? "it makes no line in this view"
        : failed   ? "its geometry could not be read or placed; the object is skipped"
                   : "some of its geometry could not be read or placed; the rest is drawn";
    if (diagnostics.count(code) >= Diagnostics::kMaxPerCode) {
      diagnostics.add(Severity::warning, code, {}, {});
      continue;
    }
    diagnostics.add(Severity::warning, code, fmt::format("{} ({})", words, codes),
                    object_text(model, id));
  }
}

bool is_code_of_defect(std::string_view code) {
  return code == kDegenerate || code == kFailed || code == kInPart;
}

}  // namespace strake::hlr
