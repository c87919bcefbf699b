// SPDX-License-Identifier: Apache-2.0
#include "project/views/drawing_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "project/views/number_columns.hpp"
#include "project/views/piece_blocks.hpp"
#include "project/views/view_codec.hpp"

namespace strake::project {

namespace {

constexpr std::uint64_t kDrawingForm = 2, kFormWithoutHatches = 1;
constexpr std::size_t kMostOf32Bits = std::size_t{1} << 32U;

/// Appends the numbers that `get` takes from each item, `each` to an item.
template <class Item, class Get>
void write_column(BlobWriter& out, std::span<const Item> items, std::size_t each, Get&& get) {
  std::vector<std::int64_t> values;
  values.reserve(items.size() * each);
  for (const Item& item : items)
    for (std::size_t k = 0; k < each; ++k) values.push_back(get(item, k));
  write_numbers(out, values);
}

void write_curves(BlobWriter& out, const hlr::Curves& curves) {
  std::vector<double> sizes;
  sizes.reserve(curves.all.size() * 9);
  for (const hlr::Curve& curve : curves.all)
    for (const geometry::Vec3d& v : {curve.at.centre, curve.at.u, curve.at.v})
      for (int k = 0; k < 3; ++k) sizes.push_back(v[k]);
  out.reals(sizes);
  for (int axis = 0; axis < 3; ++axis)
    write_column(out, std::span<const hlr::Curve>(curves.all), 1,
                 [axis](const hlr::Curve& curve, std::size_t /*k*/) { return curve.origin[axis]; });
  std::vector<std::uint32_t> edges;
  edges.reserve(curves.edges.size() * 3);
  for (const hlr::CurvedEdge& edge : curves.edges) {
    edges.push_back(model::index(edge.object));
    edges.push_back(edge.edge);
    edges.push_back(edge.curve);
  }
  out.column(std::span<const std::uint32_t>(edges));
}

hlr::Curves read_curves(BlobReader& in, std::size_t objects) {
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
  for (std::size_t e = 0; e < edges.size(); e += 3) {
    if (edges[e] >= objects || edges[e + 2] >= count) in.refuse("an edge has no curve");
    curves.edges.push_back({model::ObjectId{edges[e]}, edges[e + 1], edges[e + 2]});
  }
  const auto key = [](const hlr::CurvedEdge& e) { return std::pair(e.object, e.edge); };
  if (!std::ranges::is_sorted(curves.edges, {}, key)) in.refuse("curved edges are not in order");
  return curves;
}

void write_lines(BlobWriter& out, const hlr::Drawing& drawing) {
  out.column(std::span<const std::uint32_t>(drawing.left_out));
  const std::span<const hlr::LineCount> counted = drawing.counted;
  write_column(out, counted, 2, [](const hlr::LineCount& count, std::size_t k) {
    return static_cast<std::int64_t>(k == 0 ? count.edges : count.specks);
  });
  write(out, std::span<const hlr::Hatch>(drawing.hatches));
  write_curves(out, drawing.curves);
  write_pieces(out, drawing.pieces);
}

std::vector<hlr::LineCount> read_line_counts(BlobReader& in, std::size_t objects) {
  const std::vector<std::int64_t> values = read_numbers(in, objects * 2);
  std::vector<hlr::LineCount> counts;
  counts.reserve(values.size() / 2);
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    if (!is_number(values[i], kMostOf32Bits) || !is_number(values[i + 1], kMostOf32Bits)) {
      in.refuse("an object has a number of lines that is none");
      return {};
    }
    counts.push_back(
        {static_cast<std::uint32_t>(values[i]), static_cast<std::uint32_t>(values[i + 1])});
  }
  return counts;
}

}  // namespace

void write(BlobWriter& out, const hlr::Drawing& drawing) {
  out.number(kDrawingForm);
  write(out, drawing.view);
  write(out, drawing.options);
  out.real(drawing.contact_distance_mm);
  out.real(drawing.weld_mm);
  out.real(drawing.sag_mm);
  write(out, drawing.origin);
  write(out, drawing.counters);
  write(out, drawing.account);
  write(out, drawing.diagnostics);
  write_lines(out, drawing);
}

Result<hlr::Drawing> read_drawing(BlobReader& in, const parallel::Context& context) {
  hlr::Drawing drawing;
  const std::uint64_t form = in.number();
  if (form != kDrawingForm && form != kFormWithoutHatches)
    in.refuse("a drawing is of a form that this version cannot read");
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
  const std::size_t objects = drawing.account.fates.size();
  drawing.left_out = in.column<std::uint32_t>();
  if (!drawing.left_out.empty() && drawing.left_out.size() != objects)
    in.refuse("columns are not of one length");
  drawing.counted = read_line_counts(in, objects);
  if (form == kDrawingForm) drawing.hatches = read_hatches(in);
  if (!drawing.hatches.empty() && drawing.hatches.size() != objects)
    in.refuse("columns are not of one length");
  drawing.curves = read_curves(in, objects);
  Result<std::vector<hlr::EdgePiece>> pieces = read_pieces(in, objects, context);
  if (!pieces) return pieces.error();
  drawing.pieces = std::move(*pieces);
  return drawing;
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
  write_lines(out, drawing);
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
