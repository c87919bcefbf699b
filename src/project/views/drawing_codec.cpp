// SPDX-License-Identifier: Apache-2.0
#include "project/views/drawing_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "project/views/number_columns.hpp"
#include "project/views/piece_blocks.hpp"
#include "project/views/view_codec.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {

namespace {

/// Forms of a drawing: all in one blob, at first without hatches, and with its lines in parts.
constexpr std::uint64_t kFormWithoutHatches = 1, kFormOfOne = 2, kFormInParts = 3;

/// How many objects have their lines in one part: enough that a part is compressed well, and few
/// enough that lines which a change reaches all over a drawing write little of it.
constexpr std::size_t kObjectsPerDrawingPart = 256;
constexpr std::size_t kMaxOf32Bits = std::size_t{1} << 32U;

/// Appends the numbers that `get` takes from each item, `each` to an item.
template <class Item, class Get>
void write_column(BlobWriter& out, std::span<const Item> items, std::size_t each, Get&& get) {
  std::vector<std::int64_t> values;
  values.reserve(items.size() * each);
  for (const Item& item : items)
    for (std::size_t k = 0; k < each; ++k) values.push_back(get(item, k));
  write_numbers(out, values);
}

/// What a drawing says of a range of objects, where it lies.
struct LinesOfObjects {
  std::span<const std::uint32_t> left_out;
  /// What is written only where the options have it counted.
  std::optional<std::span<const std::uint32_t>> clipped_left_out;
  std::span<const hlr::LineCount> counted;
  std::span<const hlr::Hatch> hatches;
  std::span<const hlr::Curve> curves;
  std::span<const hlr::CurvedEdge> edges;
  std::uint32_t first_curve = 0;  ///< number of the first of the curves
  std::span<const hlr::EdgePiece> pieces;
};

/// Returns the lines of a range out of those that are sorted by object.
template <class T>
std::span<const T> lines_of(const std::vector<T>& sorted, ObjectRange objects) {
  const auto at = [&](std::size_t object) {
    return std::ranges::lower_bound(sorted, object, {},
                                    [](const T& line) { return model::index(line.object); });
  };
  return {at(objects.first), at(objects.last)};
}

/// Returns the entries of a range out of those by object, if there are any.
template <class T>
std::span<const T> entries_of(const std::vector<T>& by_object, ObjectRange objects) {
  if (by_object.empty()) return {};
  return std::span(by_object).subspan(objects.first, objects.size());
}

/// Curves are in the order of the objects whose edges lie on them.
LinesOfObjects lines_of(const hlr::Drawing& drawing, ObjectRange objects) {
  const hlr::Curves& curves = drawing.curves;
  LinesOfObjects lines{.left_out = entries_of(drawing.left_out, objects),
                       .clipped_left_out = std::nullopt,
                       .counted = entries_of(drawing.counted, objects),
                       .hatches = entries_of(drawing.hatches, objects),
                       .curves = {},
                       .edges = lines_of(curves.edges, objects),
                       .pieces = lines_of(drawing.pieces, objects)};
  if (!drawing.options.clipped)
    lines.clipped_left_out = entries_of(drawing.clipped_left_out, objects);
  if (lines.edges.empty()) return lines;
  const std::span<const hlr::CurvedEdge> after =
      lines_of(curves.edges, {objects.last, drawing.account.fates.size()});
  const std::size_t first = lines.edges.front().curve;
  const std::size_t last = after.empty() ? curves.all.size() : after.front().curve;
  lines.first_curve = static_cast<std::uint32_t>(first);
  if (first <= last && last <= curves.all.size())
    lines.curves = std::span(curves.all).subspan(first, last - first);
  return lines;
}

void write_curves(BlobWriter& out, const LinesOfObjects& lines) {
  std::vector<double> sizes;
  sizes.reserve(lines.curves.size() * 9);
  for (const hlr::Curve& curve : lines.curves)
    for (const geometry::Vec3d& v : {curve.at.centre, curve.at.u, curve.at.v})
      for (int k = 0; k < 3; ++k) sizes.push_back(v[k]);
  out.reals(sizes);
  for (int axis = 0; axis < 3; ++axis)
    write_column(out, lines.curves, 1,
                 [axis](const hlr::Curve& curve, std::size_t /*k*/) { return curve.origin[axis]; });
  std::vector<std::uint32_t> edges;
  edges.reserve(lines.edges.size() * 3);
  for (const hlr::CurvedEdge& edge : lines.edges) {
    edges.push_back(model::index(edge.object));
    edges.push_back(edge.edge);
    edges.push_back(edge.curve - lines.first_curve);
  }
  out.column(std::span<const std::uint32_t>(edges));
}

/// Curves are numbered from the first of the range.
hlr::Curves read_curves(BlobReader& in, ObjectRange objects) {
  const std::vector<double> sizes = in.column<double>();
  if (sizes.size() % 9 != 0 ||
      !std::ranges::all_of(sizes, [](double size) { return std::isfinite(size); }))
    in.refuse("a curve has no size");
  if (in.failed()) return {};
  const std::size_t count = sizes.size() / 9;
  std::array<std::vector<std::int64_t>, 3> origins;
  for (std::vector<std::int64_t>& column : origins) column = read_numbers(in, count);
  const std::vector<std::uint32_t> edges = in.column<std::uint32_t>();
  if (edges.size() % 3 != 0) in.refuse("an edge has no curve");
  if (in.failed()) return {};
  hlr::Curves curves;
  for (std::size_t c = 0; c < count; ++c) {
    const double* const s = sizes.data() + c * 9;
    curves.all.push_back({{origins[0][c], origins[1][c], origins[2][c]},
                          {{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, {s[6], s[7], s[8]}}});
    for (const std::vector<std::int64_t>& column : origins)
      if (!is_on_grid(column[c])) in.refuse("a curve lies outside what can be placed");
  }
  std::uint32_t next = 0,
                first = 0;  // numbers of curves: the next one, and the first of the object
  for (std::size_t e = 0; e < edges.size(); e += 3) {
    const std::uint32_t object = edges[e], curve = edges[e + 2];
    if (object < objects.first || object >= objects.last || curve >= count)
      in.refuse("an edge has no curve");
    // Merging drawings takes the curves of an object as one block, in the order of its edges.
    const bool begins = e == 0 || object != edges[e - 3];
    if (begins) first = next;
    if (curve > next || curve < first || (begins && curve != next))
      in.refuse("curves are not in the order of objects");
    if (curve == next) ++next;
    curves.edges.push_back({model::ObjectId{object}, edges[e + 1], curve});
  }
  if (next != count) in.refuse("a curve has no edge");
  const auto key = [](const hlr::CurvedEdge& e) { return std::pair(e.object, e.edge); };
  if (!std::ranges::is_sorted(curves.edges, {}, key)) in.refuse("curved edges are not in order");
  return curves;
}

void write(BlobWriter& out, const LinesOfObjects& lines) {
  out.column(lines.left_out);
  if (lines.clipped_left_out) out.column(*lines.clipped_left_out);
  write_column(out, lines.counted, 2, [](const hlr::LineCount& count, std::size_t k) {
    return static_cast<std::int64_t>(k == 0 ? count.edges : count.specks);
  });
  write(out, lines.hatches);
  write_curves(out, lines);
  write_pieces(out, lines.pieces);
}

/// Appends all lines, as they are.
void write_all_lines(BlobWriter& out, const hlr::Drawing& drawing) {
  using Counts = std::optional<std::span<const std::uint32_t>>;
  write(out,
        LinesOfObjects{.left_out = drawing.left_out,
                       .clipped_left_out =
                           drawing.options.clipped ? Counts() : Counts(drawing.clipped_left_out),
                       .counted = drawing.counted,
                       .hatches = drawing.hatches,
                       .curves = drawing.curves.all,
                       .edges = drawing.curves.edges,
                       .pieces = drawing.pieces});
}

std::vector<hlr::LineCount> read_line_counts(BlobReader& in, std::size_t objects) {
  const std::vector<std::int64_t> values = read_numbers(in, objects * 2);
  std::vector<hlr::LineCount> counts;
  counts.reserve(values.size() / 2);
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    if (!is_number(values[i], kMaxOf32Bits) || !is_number(values[i + 1], kMaxOf32Bits)) {
      in.refuse("an object has a number of lines that is none");
      return {};
    }
    counts.push_back(
        {static_cast<std::uint32_t>(values[i]), static_cast<std::uint32_t>(values[i + 1])});
  }
  return counts;
}

/// What was written of a range of objects; its pieces lie in the reader still.
struct ReadLines {
  std::vector<std::uint32_t> left_out, clipped_left_out;
  std::vector<hlr::LineCount> counted;
  std::vector<hlr::Hatch> hatches;
  hlr::Curves curves;  ///< numbered from the first of the range
  PieceBlocks pieces;
};

ReadLines read_lines(BlobReader& in, ObjectRange objects, const hlr::Options& options,
                     bool with_hatches) {
  ReadLines lines;
  lines.left_out = in.column<std::uint32_t>();
  if (!options.clipped) lines.clipped_left_out = in.column<std::uint32_t>();
  for (const std::size_t size : {lines.left_out.size(), lines.clipped_left_out.size()})
    if (size != 0 && size != objects.size()) in.refuse("columns are not of one length");
  lines.counted = read_line_counts(in, objects.size());
  if (with_hatches) lines.hatches = read_hatches(in);
  if (!lines.hatches.empty() && lines.hatches.size() != objects.size())
    in.refuse("columns are not of one length");
  lines.curves = read_curves(in, objects);
  lines.pieces = take_pieces(in, objects);
  return lines;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Puts the lines of all ranges, in order, into a drawing whose head is there. A fault is that of
/// `in`.
Status join(std::span<const ReadLines> ranges, BlobReader& in, hlr::Drawing& drawing,
            const parallel::Context& context) {
  std::vector<PieceBlocks> blocks;
  blocks.reserve(ranges.size());
  std::size_t curves = 0, edges = 0;
  for (const ReadLines& lines : ranges) {
    curves += lines.curves.all.size();
    edges += lines.curves.edges.size();
  }
  drawing.curves.all.reserve(curves);
  drawing.curves.edges.reserve(edges);
  for (const ReadLines& lines : ranges) {
    append(drawing.left_out, lines.left_out);
    append(drawing.clipped_left_out, lines.clipped_left_out);
    append(drawing.counted, lines.counted);
    append(drawing.hatches, lines.hatches);
    const auto before = static_cast<std::uint32_t>(drawing.curves.all.size());
    append(drawing.curves.all, lines.curves.all);
    for (hlr::CurvedEdge edge : lines.curves.edges) {
      edge.curve += before;
      drawing.curves.edges.push_back(edge);
    }
    blocks.push_back(lines.pieces);
  }
  const std::size_t objects = drawing.account.fates.size();
  for (const std::size_t size :
       {drawing.left_out.size(), drawing.clipped_left_out.size(), drawing.hatches.size()})
    if (size != 0 && size != objects) in.refuse("columns are not of one length");
  if (in.failed()) return {};
  Result<std::vector<hlr::EdgePiece>> pieces = read_pieces(blocks, objects, in, context);
  if (!pieces) return pieces.error();
  drawing.pieces = std::move(*pieces);
  return {};
}

void write_head(BlobWriter& out, const hlr::Drawing& drawing, std::uint64_t form) {
  out.number(form);
  write(out, drawing.view);
  write(out, drawing.options);
  out.real(drawing.contact_distance_mm);
  out.real(drawing.weld_mm);
  out.real(drawing.sag_mm);
  write(out, drawing.origin);
  write(out, drawing.counters);
  write(out, drawing.account);
  write(out, drawing.diagnostics);
}

/// What comes before lines, and in which form they follow.
struct ReadHead {
  hlr::Drawing drawing;
  std::uint64_t form = 0;
};

ReadHead read_head(BlobReader& in) {
  ReadHead head;
  hlr::Drawing& drawing = head.drawing;
  head.form = in.number();
  drawing.view = read_view(in);
  drawing.options = read_options(in);
  for (double* const value : {&drawing.contact_distance_mm, &drawing.weld_mm, &drawing.sag_mm}) {
    *value = in.real();
    if (!std::isfinite(*value)) in.refuse("a number is not finite");
  }
  drawing.origin = read_vector(in);
  drawing.counters = read_counters(in);
  drawing.account = read_account(in);
  drawing.diagnostics = read_diagnostics(in);
  return head;
}

constexpr std::string_view kUnknownForm = "a drawing is of a form that this version cannot read";

/// A part that is unpacked.
struct OpenedPart {
  BlobReader in;
  ReadLines lines;
};

Result<OpenedPart> open_part(std::span<const std::byte> blob, ObjectRange objects,
                             const hlr::Options& options, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(blob, what);
  if (!in) return in.error();
  OpenedPart part{std::move(*in), {}};
  part.lines = read_lines(part.in, objects, options, true);
  if (const Status status = part.in.finish(); !status) return status.error();
  return part;
}

}  // namespace

std::size_t count_drawing_parts(std::size_t objects) {
  // No number is too large for it: it may come out of a file.
  const std::size_t rest = objects % kObjectsPerDrawingPart == 0 ? 0 : 1;
  return std::max<std::size_t>(1, objects / kObjectsPerDrawingPart + rest);
}

ObjectRange objects_of_drawing_part(std::size_t part, std::size_t objects) {
  return {std::min(objects, part * kObjectsPerDrawingPart),
          std::min(objects, (part + 1) * kObjectsPerDrawingPart)};
}

void write(BlobWriter& out, const hlr::Drawing& drawing) {
  write_head(out, drawing, kFormOfOne);
  write_all_lines(out, drawing);
}

void write_head(BlobWriter& out, const hlr::Drawing& drawing) {
  write_head(out, drawing, kFormInParts);
}

Status write_lines(BlobWriter& out, const hlr::Drawing& drawing, ObjectRange objects) {
  const LinesOfObjects lines = lines_of(drawing, objects);
  const auto is_of_range = [&](const hlr::CurvedEdge& edge) {
    return edge.curve >= lines.first_curve && edge.curve - lines.first_curve < lines.curves.size();
  };
  if (!std::ranges::all_of(lines.edges, is_of_range))
    return Error{ErrorCode::internal, "curves are not in the order of objects", {}, {}};
  write(out, lines);
  return {};
}

Result<hlr::Drawing> read_drawing(BlobReader& in, const parallel::Context& context) {
  ReadHead head = read_head(in);
  if (head.form != kFormOfOne && head.form != kFormWithoutHatches) in.refuse(kUnknownForm);
  const ReadLines lines = read_lines(in, {0, head.drawing.account.fates.size()},
                                     head.drawing.options, head.form == kFormOfOne);
  if (const Status status = join(std::span(&lines, 1), in, head.drawing, context); !status)
    return status.error();
  return std::move(head.drawing);
}

Result<hlr::Drawing> read_parts_of_drawing(BlobReader& in,
                                           std::span<const std::span<const std::byte>> parts,
                                           const std::string& what,
                                           const parallel::Context& context) {
  ReadHead head = read_head(in);
  const std::size_t objects = head.drawing.account.fates.size();
  if (head.form != kFormInParts) in.refuse(kUnknownForm);
  if (parts.size() != count_drawing_parts(objects))
    in.refuse("it has not the parts that it should have");
  if (in.failed()) return hlr::Drawing{};
  Result<std::vector<OpenedPart>> opened = parallel::transform(
      context, {.name = "unpack stored lines", .n = parts.size()},
      [&](std::size_t k) -> Result<OpenedPart> {
        return open_part(parts[k], objects_of_drawing_part(k, objects), head.drawing.options, what);
      });
  if (!opened) return opened.error();
  std::vector<ReadLines> ranges;
  ranges.reserve(opened->size());
  for (OpenedPart& part : *opened) ranges.push_back(std::move(part.lines));
  if (const Status status = join(ranges, in, head.drawing, context); !status) return status.error();
  return std::move(head.drawing);
}

namespace {

/// Returns the drawing as bytes, without what tells only how much work it was.
Result<std::vector<std::byte>> bytes_of_result(const hlr::Drawing& drawing) {
  BlobWriter out;
  const hlr::Counters& all = drawing.counters;
  write(out, hlr::Counters{.feature_edges = all.feature_edges,
                           .specks = all.specks,
                           .left_out = all.left_out,
                           .seams = all.seams,
                           .uncut_objects = all.uncut_objects});
  write(out, drawing.view);
  write(out, drawing.options);
  for (const double value : {drawing.contact_distance_mm, drawing.weld_mm, drawing.sag_mm})
    out.real(value);
  write(out, drawing.origin);
  write(out, drawing.account);
  write(out, drawing.diagnostics);
  write_all_lines(out, drawing);
  return out.finish();
}

}  // namespace

Result<bool> are_equal(const hlr::Drawing& x, const hlr::Drawing& y) {
  const auto of_x = bytes_of_result(x);
  if (!of_x) return of_x.error();
  const auto of_y = bytes_of_result(y);
  if (!of_y) return of_y.error();
  return *of_x == *of_y;
}

}  // namespace strake::project
