// SPDX-License-Identifier: Apache-2.0
#include "drawing/neutral/neutral_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "core/checksum.hpp"
#include "drawing/buffered_writer.hpp"
#include "drawing/neutral/neutral_json.hpp"
#include "strake/drawing/write.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3l;

// Numbers of a drawing are whole micrometres within the range of the grid.
std::int64_t micrometres(double mm) { return geometry::snap(mm).value_or(0); }
Vec3l micrometres(const geometry::Vec3d& mm) { return geometry::snap(mm).value_or(Vec3l{}); }

/// The extents of the lines, in the model and on paper.
struct LineExtents {
  static constexpr std::int64_t kBig = std::int64_t{1} << 62U;
  geometry::Box3l model{{kBig, kBig, kBig}, {-kBig, -kBig, -kBig}};
  std::int64_t farthest_on_paper = 0;

  void add(const Line& line) {
    model.include(micrometres(line.a_mm));
    model.include(micrometres(line.b_mm));
    for (const double mm : {line.a_paper.x, line.a_paper.y, line.b_paper.x, line.b_paper.y})
      farthest_on_paper = std::max(farthest_on_paper, std::abs(micrometres(mm)));
  }
  void add(const LineExtents& other) {
    model.include(other.model);
    farthest_on_paper = std::max(farthest_on_paper, other.farthest_on_paper);
  }
  /// Returns the middle of the model, so that numbers relative to it are small.
  [[nodiscard]] Vec3l origin() const {
    if (model.empty()) return {};
    const auto middle = [](std::int64_t lo, std::int64_t hi) { return lo + (hi - lo) / 2; };
    return {middle(model.lo.x, model.hi.x), middle(model.lo.y, model.hi.y),
            middle(model.lo.z, model.hi.z)};
  }
  [[nodiscard]] bool fits_32_bits() const {
    constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
    if (model.empty()) return true;
    const Vec3l size = model.hi - model.lo;
    // An end lies at most half a size from the middle, or half a unit more.
    return std::max({size.x, size.y, size.z}) / 2 < kMax && farthest_on_paper <= kMax;
  }
};

Result<LineExtents> reach_of(const std::vector<Line>& lines, const parallel::Context& context) {
  return parallel::reduce(
      context, {.name = "reach of lines", .n = lines.size(), .grain = 65536}, LineExtents{},
      [&](LineExtents& part, std::size_t i) { part.add(lines[i]); },
      [](LineExtents& into, const LineExtents& part) { into.add(part); });
}

template <class Int>
ViewRow<Int> row_of(const Line& line, std::uint32_t curve, const Vec3l& origin,
                    const ListedObjects& listed) {
  ViewRow<Int> row;
  row.object = listed.number(line.object);
  row.other = listed.number(line.other);
  row.edge = line.edge;
  row.curve = curve;
  row.kind = static_cast<std::uint8_t>(line.kind);
  row.state = static_cast<std::uint8_t>(line.state);
  const auto model = [&](const geometry::Vec3d& mm) {
    const Vec3l v = micrometres(mm) - origin;
    return std::array<Int, 3>{static_cast<Int>(v.x), static_cast<Int>(v.y), static_cast<Int>(v.z)};
  };
  const auto paper = [](const PaperPoint& mm) {
    return std::array<Int, 2>{static_cast<Int>(micrometres(mm.x)),
                              static_cast<Int>(micrometres(mm.y))};
  };
  row.a = model(line.a_mm);
  row.b = model(line.b_mm);
  row.a_paper = paper(line.a_paper);
  row.b_paper = paper(line.b_paper);
  return row;
}

/// Returns the names of the values of an enumeration up to one, in order: ["sharp","contour"].
template <class Enum, class Name>
std::string names_to(Enum last, Name&& name) {
  std::string out;
  for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(last); ++i)
    out += fmt::format("{}\"{}\"", i == 0 ? "[" : ",", name(static_cast<Enum>(i)));
  return out + "]";
}

/// Returns the last kind of line that a file names: those that came after the first versions of the
/// format only where there are such lines, so that older programs read the others.
hlr::EdgeKind last_named_kind(const NeutralDrawing& drawing) {
  hlr::EdgeKind last = hlr::EdgeKind::smooth;
  for (const Line& line : drawing.lines) last = std::max(last, line.kind);
  return last;
}

template <class Int>
void write_form(BufferedWriter& out, const Vec3l& origin, hlr::EdgeKind last_kind) {
  out << "\"rows\":{\"bytes\":" << std::to_string(sizeof(ViewRow<Int>))
      << ",\"fields\":" << row_fields<Int>()
      << ",\n\"origin_um\":" << fmt::format("[{},{},{}]", origin.x, origin.y, origin.z)
      << ",\"kinds\":" << names_to(last_kind, kind_name)
      << ",\"states\":" << names_to(LineState::duplicate, state_name) << ",\"checksum\":\""
      << kChecksumName << "\"}}\n";
}

/// Returns the text with its length before it, in one string.
template <class Int>
std::string head_of(const NeutralDrawing& drawing, const model::Model& model,
                    const ListedObjects& listed, const Vec3l& origin) {
  std::string text;
  {
    const auto append = [&](std::string_view part) { text += part; };
    BufferedWriter out(append);
    write_view_head(out, drawing, model, listed);
    write_form<Int>(out, origin, last_named_kind(drawing));
  }
  while (text.size() % kRowsAlign != 0) text += ' ';
  const std::uint64_t size = text.size();
  return std::string(reinterpret_cast<const char*>(&size), sizeof size) + text;
}

template <class Int>
Status write_all(const NeutralDrawing& drawing, const model::Model& model, const Vec3l& origin,
                 Sink sink, const parallel::Context& context) {
  const ListedObjects listed(drawing.lines, model.objects.size());
  Checksum checksum;
  const auto put = [&](std::string_view bytes) {
    checksum.add(bytes);
    sink(bytes);
  };
  put(kViewMagic);
  put(head_of<Int>(drawing, model, listed, origin));
  const auto encode = [&](std::size_t begin, std::size_t end, std::string& out) {
    out.reserve((end - begin) * sizeof(ViewRow<Int>));
    for (std::size_t i = begin; i < end; ++i) {
      const Line& line = drawing.lines[i];
      const ViewRow<Int> row = row_of<Int>(line, drawing.curves.index_of(line), origin, listed);
      out.append(reinterpret_cast<const char*>(&row), sizeof row);
    }
  };
  const Status written =
      write_in_batches("neutral drawing", drawing.lines.size(), encode, put, context);
  if (written) sink(checksum_bytes(checksum.value()));
  return written;
}

}  // namespace

std::string checksum_bytes(const Hash128& checksum) {
  const std::array<std::uint64_t, 2> halves{checksum.low, checksum.high};
  static_assert(sizeof halves == kChecksumBytes);
  return {reinterpret_cast<const char*>(halves.data()), sizeof halves};
}

template <class Int>
std::string row_fields() {
  std::string out;
  const auto field = [&](std::string_view name, std::string_view type, std::size_t offset,
                         std::size_t count) {
    out += fmt::format("{}{{\"name\":\"{}\",\"type\":\"{}\",\"offset\":{},\"count\":{}}}",
                       out.empty() ? "[" : ",", name, type, offset, count);
  };
  const std::string_view whole = sizeof(Int) == 4 ? "int32" : "int64";
  field("object_index", "uint32", offsetof(ViewRow<Int>, object), 1);
  field("other_index", "uint32", offsetof(ViewRow<Int>, other), 1);
  field("edge", "uint32", offsetof(ViewRow<Int>, edge), 1);
  field("curve_index", "uint32", offsetof(ViewRow<Int>, curve), 1);
  field("kind", "uint8", offsetof(ViewRow<Int>, kind), 1);
  field("state", "uint8", offsetof(ViewRow<Int>, state), 1);
  field("a_um", whole, offsetof(ViewRow<Int>, a), 3);
  field("b_um", whole, offsetof(ViewRow<Int>, b), 3);
  field("a_paper_um", whole, offsetof(ViewRow<Int>, a_paper), 2);
  field("b_paper_um", whole, offsetof(ViewRow<Int>, b_paper), 2);
  return out + "]";
}
template std::string row_fields<std::int32_t>();
template std::string row_fields<std::int64_t>();

Status write_view_rows(const NeutralDrawing& drawing, const model::Model& model, Sink sink,
                       const parallel::Context& context) {
  const Result<LineExtents> reach = reach_of(drawing.lines, context);
  if (!reach) return reach.error();
  const Vec3l origin = reach->origin();
  return reach->fits_32_bits() ? write_all<std::int32_t>(drawing, model, origin, sink, context)
                               : write_all<std::int64_t>(drawing, model, origin, sink, context);
}

}  // namespace strake::drawing
