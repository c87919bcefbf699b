// SPDX-License-Identifier: Apache-2.0
#include "hlr/visibility/specks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/numeric/vector_math.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// A contact distance leaves at most this many times its length of an edge open.
constexpr std::int64_t kContactsPerSpeck = 2;

bool has_ink(State state) { return state != State::clipped && state != State::projecting; }

bool is_hidden(State state) {
  return state == State::hidden_by_self || state == State::hidden_by_other;
}

/// An interval of an edge, of one of two kinds, of which the first is preferred.
struct EdgeSpan {
  Vec3l a, b;
  std::size_t first = 0, last = 0;  ///< pieces
  std::uint8_t kind = 0;
  bool stays = false;  ///< neither a speck nor absorbed, whatever is beside it
};

/// Gives specks the kind of what is beside them.
class Absorber {
 public:
  Absorber(const SpeckRule& rule, std::int64_t longest, std::vector<EdgeSpan>& spans)
      : rule_(rule), longest_(longest), spans_(spans) {}

  /// Returns how many specks there were. A speck with nothing beside it but spans that stay comes
  /// to stay.
  std::size_t run() {
    std::size_t specks = 0;
    for (std::size_t first = 0; first < spans_.size();) {
      std::size_t last = first;
      while (last < spans_.size() && is_speck(spans_[last])) ++last;
      if (first < last) settle(first, last);
      specks += last - first;
      first = last + 1;
    }
    return specks;
  }

 private:
  [[nodiscard]] bool is_speck(const EdgeSpan& span) const {
    return !span.stays && rule_.within(span.a, span.b, longest_);
  }

  void settle(std::size_t first, std::size_t last) {
    const EdgeSpan* const before = first > 0 ? &spans_[first - 1] : nullptr;
    const EdgeSpan* const after = last < spans_.size() ? &spans_[last] : nullptr;
    const bool is_short = rule_.within(spans_[first].a, spans_[last - 1].b, longest_);
    const bool lonely = (before == nullptr || before->stays) && (after == nullptr || after->stays);
    const bool at_end = before != nullptr || after != nullptr;
    const std::uint8_t kind =
        is_short && !lonely ? kind_beside(before, after) : largest(first, last);
    for (std::size_t i = first; i < last; ++i) {
      spans_[i].kind = kind;
      spans_[i].stays = is_short && lonely && at_end;
    }
  }

  /// Returns the kind of the longer neighbour.
  [[nodiscard]] std::uint8_t kind_beside(const EdgeSpan* before, const EdgeSpan* after) const {
    if (before == nullptr || before->stays) return after->kind;
    if (after == nullptr || after->stays) return before->kind;
    const double x = rule_.length(before->a, before->b), y = rule_.length(after->a, after->b);
    if (x == y) return std::min(before->kind, after->kind);
    return x > y ? before->kind : after->kind;
  }

  [[nodiscard]] std::uint8_t largest(std::size_t first, std::size_t last) const {
    std::array<double, 2> length{};
    for (std::size_t i = first; i < last; ++i)
      length[spans_[i].kind] += rule_.length(spans_[i].a, spans_[i].b);
    return length[0] >= length[1] ? 0 : 1;
  }

  const SpeckRule& rule_;
  std::int64_t longest_;
  std::vector<EdgeSpan>& spans_;
};

/// The specks of one edge: first visible or hidden is settled, whoever hides it; then who hides it.
class EdgeSpecks {
 public:
  EdgeSpecks(const SpeckRule& rule, std::span<EdgePiece> pieces)
      : rule_(rule), pieces_(pieces), longest_(rule.longest(pieces.front())) {}

  [[nodiscard]] bool any() const {
    return std::ranges::any_of(pieces_, [&](const EdgePiece& piece) {
      return has_ink(piece.state) && rule_.within(piece.a, piece.b, longest_);
    });
  }

  std::size_t absorb() {
    const bool any_visible =
        std::ranges::find(pieces_, State::visible, &EdgePiece::state) != pieces_.end();
    std::vector<EdgeSpan> visible_spans = spans(0, pieces_.size(), [](const EdgePiece& p) {
      return static_cast<std::uint8_t>(is_hidden(p.state) ? 1 : 0);
    });
    std::size_t specks = Absorber(rule_, longest_, visible_spans).run();
    for (const EdgeSpan& span : visible_spans) show(span);
    // What hides pieces that are left out depends on the order in which it was found, and whether
    // an edge that is hidden wholly has pieces at all.
    if (!rule_.keeps_hidden()) return any_visible ? specks : 0;
    for (std::size_t first = 0; first < pieces_.size();) {
      std::size_t last = first;
      while (last < pieces_.size() && is_hidden(pieces_[last].state)) ++last;
      if (last > first + 1) specks += absorb_by_occluder(first, last);
      first = last + 1;
    }
    return specks;
  }

 private:
  template <class Kind>
  std::vector<EdgeSpan> spans(std::size_t first, std::size_t last, Kind&& kind) const {
    std::vector<EdgeSpan> result;
    for (std::size_t i = first; i < last; ++i) {
      const EdgePiece& piece = pieces_[i];
      const EdgeSpan next{piece.a, piece.b, i, i + 1, kind(piece), !has_ink(piece.state)};
      if (!result.empty() && result.back().kind == next.kind && result.back().stays == next.stays) {
        result.back().b = next.b;
        result.back().last = next.last;
      } else {
        result.push_back(next);
      }
    }
    return result;
  }

  /// Pieces that become hidden are so by what hides them, or by what hides the piece beside them.
  void show(const EdgeSpan& span) {
    for (std::size_t i = span.first; i < span.last; ++i) {
      EdgePiece& piece = pieces_[i];
      if (!has_ink(piece.state)) continue;
      if (span.stays)
        piece.state = State::clipped;
      else if (span.kind == 0)
        piece.state = State::visible;
      else if (!is_hidden(piece.state))
        piece.state = hidden_beside(i);
    }
  }
  [[nodiscard]] State hidden_beside(std::size_t i) const {
    for (std::size_t k = i; k > 0 && has_ink(pieces_[k - 1].state); --k)
      if (is_hidden(pieces_[k - 1].state)) return pieces_[k - 1].state;
    for (std::size_t k = i + 1; k < pieces_.size(); ++k)
      if (is_hidden(pieces_[k].state)) return pieces_[k].state;
    return State::hidden_by_other;
  }

  std::size_t absorb_by_occluder(std::size_t first, std::size_t last) {
    std::vector<EdgeSpan> by = spans(first, last, [](const EdgePiece& p) {
      return static_cast<std::uint8_t>(p.state == State::hidden_by_self ? 0 : 1);
    });
    const std::size_t specks = Absorber(rule_, longest_, by).run();
    for (const EdgeSpan& span : by)
      for (std::size_t i = span.first; i < span.last; ++i)
        pieces_[i].state = span.kind == 0 ? State::hidden_by_self : State::hidden_by_other;
    return specks;
  }

  const SpeckRule& rule_;
  std::span<EdgePiece> pieces_;
  std::int64_t longest_;
};

/// Specks of one object that hang together by their ends.
class Clusters {
 public:
  Clusters(const SpeckRule& rule, std::span<const EdgePiece> pieces,
           std::span<const std::size_t> specks)
      : rule_(rule), pieces_(pieces), specks_(specks) {
    for (const std::size_t s : specks) {
      points_.push_back(pieces[s].a);
      points_.push_back(pieces[s].b);
    }
    std::ranges::sort(points_);
    points_.erase(std::ranges::unique(points_).begin(), points_.end());
    root_.resize(points_.size());
    std::iota(root_.begin(), root_.end(), std::size_t{0});
    for (const std::size_t s : specks) unite(number(pieces[s].a), number(pieces[s].b));
    measure_clusters();
  }

  /// Returns whether the cluster of a speck joins nothing.
  [[nodiscard]] bool is_lone(std::size_t speck) const {
    const std::size_t root = root_of(number(pieces_[speck].a));
    return !wide_[root] && held_[root] < 2;
  }

 private:
  [[nodiscard]] std::size_t number(const Vec3l& point) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(points_, point) - points_.begin());
  }
  [[nodiscard]] std::size_t root_of(std::size_t point) const {
    while (root_[point] != point) point = root_[point];
    return point;
  }
  /// The root of a cluster is its first point.
  void unite(std::size_t p, std::size_t q) {
    p = root_of(p);
    q = root_of(q);
    root_[std::max(p, q)] = std::min(p, q);
  }

  void measure_clusters() {
    std::int64_t longest = 0;
    for (const std::size_t s : specks_) longest = std::max(longest, rule_.longest(pieces_[s]));
    wide_.resize(points_.size());
    held_.resize(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (!rule_.within(points_[root_of(p)], points_[p], longest)) wide_[root_of(p)] = true;
    std::vector<bool> known(points_.size());
    std::size_t next = 0;  // index into specks_
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (next < specks_.size() && specks_[next] == i) {
        ++next;
        continue;
      }
      if (pieces_[i].state != State::visible) continue;
      for (const Vec3l& end : {pieces_[i].a, pieces_[i].b}) {
        const std::size_t p = number(end);
        if (p == points_.size() || points_[p] != end || known[p]) continue;
        known[p] = true;
        ++held_[root_of(p)];
      }
    }
  }

  const SpeckRule& rule_;
  std::span<const EdgePiece> pieces_;
  std::span<const std::size_t> specks_;
  std::vector<Vec3l> points_;
  std::vector<std::size_t> root_;
  std::vector<bool> wide_;         ///< by root: the cluster is longer than a speck
  std::vector<std::size_t> held_;  ///< by root: how many of its points are on other lines
};

bool is_visible_speck(const SpeckRule& rule, const EdgePiece& piece) {
  return piece.state == State::visible && rule.within(piece.a, piece.b, rule.longest(piece));
}

/// Dots those of one object; returns how many.
std::uint32_t dot_lone_specks(const SpeckRule& rule, std::span<EdgePiece> pieces) {
  std::vector<std::size_t> specks;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (is_visible_speck(rule, pieces[i])) specks.push_back(i);
  if (specks.empty()) return 0;
  const Clusters clusters(rule, pieces, specks);
  std::uint32_t dotted = 0;
  for (const std::size_t s : specks) {
    if (!clusters.is_lone(s)) continue;
    pieces[s].state = State::projecting;
    ++dotted;
  }
  return dotted;
}

}  // namespace

SpeckRule::SpeckRule(const ViewJob& job)
    : viewer_(job.viewer),
      origin_(job.origin),
      direction_length_(geometry::length(job.direction().as<double>())),
      keeps_hidden_(job.options.hidden) {}

Result<SpeckRule> SpeckRule::of(const ViewJob& job, const parallel::Context& context) {
  SpeckRule rule(job);
  const std::vector<std::uint32_t>& first_body = job.scene->first_body;
  auto longest = parallel::transform(
      context, {.name = "hidden lines: longest specks", .n = job.drawn.size(), .grain = 4096},
      [&](std::size_t object) {
        std::int64_t longest_speck = 0;
        if (job.options.keep_specks) return longest_speck;
        for (std::size_t b = first_body[object]; b < first_body[object + 1]; ++b)
          longest_speck = std::max(longest_speck, kContactsPerSpeck * job.contact[b]);
        return longest_speck;
      });
  if (!longest) return longest.error();
  rule.longest_ = std::move(*longest);
  return rule;
}

std::int64_t SpeckRule::longest(model::ObjectId object, model::ObjectId other) const {
  return std::max(longest_[model::index(object)], longest_[model::index(other)]);
}

double SpeckRule::length(const Vec3l& a, const Vec3l& b) const {
  const Vec3d along = (b - a).as<double>();
  if (!viewer_.eye)
    return geometry::length(cross(along, viewer_.direction.as<double>())) / direction_length_;
  const Vec3d p = (a - origin_).as<double>(), q = (b - origin_).as<double>();
  const double nearer = std::min(geometry::length(p), geometry::length(q));
  return nearer > 0 ? geometry::length(cross(p, along)) / nearer : geometry::length(along);
}

bool SpeckRule::within(const Vec3l& a, const Vec3l& b, std::int64_t longest) const {
  return longest > 0 && length(a, b) <= static_cast<double>(longest);
}

std::size_t absorb_specks(const SpeckRule& rule, std::size_t first,
                          std::vector<EdgePiece>& pieces) {
  if (pieces.size() - first < 2) return 0;
  const std::span<EdgePiece> own = std::span(pieces).subspan(first);
  EdgeSpecks edge(rule, own);
  if (!edge.any()) return 0;
  const std::size_t specks = edge.absorb();
  std::size_t kept = 0;
  for (std::size_t i = 1; i < own.size(); ++i)
    if (own[i].state == own[kept].state)
      own[kept].b = own[i].b;
    else
      own[++kept] = own[i];
  pieces.resize(first + kept + 1);
  return specks;
}

UnwantedPieces leave_out_unwanted(const Options& options, std::size_t first,
                                  std::vector<EdgePiece>& pieces) {
  const auto begin = pieces.begin() + static_cast<std::ptrdiff_t>(first);
  const auto kept = std::remove_if(
      begin, pieces.end(), [&](const EdgePiece& piece) { return !keeps(options, piece.state); });
  UnwantedPieces unwanted{.hidden = kept != pieces.end()};
  pieces.erase(kept, pieces.end());
  const auto is_clipped = [](const EdgePiece& piece) { return piece.state == State::clipped; };
  if (!options.clipped && std::all_of(begin, pieces.end(), is_clipped)) {
    unwanted.clipped = static_cast<std::uint32_t>(pieces.end() - begin);
    pieces.erase(begin, pieces.end());
  }
  return unwanted;
}

bool has_visible_specks(const SpeckRule& rule, std::size_t first,
                        std::span<const EdgePiece> pieces) {
  return std::ranges::any_of(pieces.subspan(first),
                             [&](const EdgePiece& piece) { return is_visible_speck(rule, piece); });
}

Status dot_lone_specks(const ViewJob& job, const SpeckedObjects& specked,
                       const parallel::Context& context, Drawing& drawing) {
  if (job.options.keep_specks || std::ranges::find(specked, 1) == specked.end()) return {};
  const auto made = SpeckRule::of(job, context);
  if (!made) return made.error();
  const SpeckRule& rule = *made;
  return parallel::for_each(
      context, {.name = "hidden lines: specks", .n = specked.size(), .grain = 1024},
      [&](std::size_t object) {
        if (specked[object] == 0) return;
        const auto own = std::ranges::equal_range(
            drawing.pieces, model::ObjectId{static_cast<std::uint32_t>(object)}, {},
            &EdgePiece::object);
        drawing.counted[object].specks += dot_lone_specks(rule, own);
      });
}

}  // namespace strake::hlr
