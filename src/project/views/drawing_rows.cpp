// SPDX-License-Identifier: Apache-2.0
#include "project/views/drawing_rows.hpp"

#include <algorithm>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/views/drawing_codec.hpp"
#include "project/views/number_columns.hpp"
#include "project/views/view_codec.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

using Bytes = std::vector<std::byte>;
using geometry::Box3l;

/// The corners of boxes, of which one that is empty has its own.
void write_boxes(BlobWriter& out, std::span<const Box3l> boxes) {
  std::vector<std::int64_t> corners;
  corners.reserve(boxes.size() * 2);
  for (int axis = 0; axis < 3; ++axis) {
    corners.clear();
    for (const Box3l& box : boxes) {
      corners.push_back(box.lo[axis]);
      corners.push_back(box.hi[axis]);
    }
    write_numbers(out, corners);
  }
}

std::vector<Box3l> read_boxes(BlobReader& in, std::size_t count) {
  std::vector<Box3l> boxes(count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::int64_t> corners = read_numbers(in, count * 2);
    if (in.failed()) return {};
    for (std::size_t b = 0; b < count; ++b) {
      boxes[b].lo[axis] = corners[b * 2];
      boxes[b].hi[axis] = corners[b * 2 + 1];
    }
  }
  const auto is_placed = [](const Box3l& box) {
    return box.empty() || (std::ranges::min({box.lo.x, box.lo.y, box.lo.z}) >= -kFarthestGrid &&
                           std::ranges::max({box.hi.x, box.hi.y, box.hi.z}) <= kFarthestGrid);
  };
  if (!std::ranges::all_of(boxes, is_placed)) in.refuse("a box lies outside what can be placed");
  return boxes;
}

/// What a drawing was solved from.
struct DrawnState {
  Snapshot made_from;
  std::vector<Box3l> boxes;
  DrawingParts parts;
};

/// What stands above the parts of what a drawing was solved from.
struct StateHead {
  Hash128 whole, names;
  std::uint64_t objects = 0;
  std::vector<DrawingPartHashes> parts;
};

BlobWriter write_state_head(const StateHead& head) {
  BlobWriter out;
  out.hash(head.whole);
  out.hash(head.names);
  out.number(head.objects);
  std::vector<Hash128> hashes;
  hashes.reserve(2 * head.parts.size());
  for (const DrawingPartHashes& part : head.parts) {
    hashes.push_back(part.lines);
    hashes.push_back(part.made_from);
  }
  out.column(std::span<const Hash128>(hashes));
  return out;
}

/// A row of the table of parts.
struct PartRow {
  Bytes lines, made_from;
};

Result<StateHead> decode_state_head(std::span<const std::byte> bytes,
                                    const std::vector<PartRow>& parts, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  StateHead head;
  head.whole = in->hash();
  head.names = in->hash();
  head.objects = in->number();
  const std::vector<Hash128> hashes = in->column<Hash128>();
  for (std::size_t h = 0; h + 1 < hashes.size(); h += 2)
    head.parts.push_back({hashes[h], hashes[h + 1]});
  // So there is room made for no more objects than there are parts for.
  if (hashes.size() != 2 * parts.size() ||
      count_drawing_parts(static_cast<std::size_t>(head.objects)) != parts.size())
    in->refuse("it has not the parts that it should have");
  if (const Status status = in->finish(); !status) return status.error();
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (BlobReader::raw_hash(parts[k].lines) != head.parts[k].lines ||
        BlobReader::raw_hash(parts[k].made_from) != head.parts[k].made_from)
      return Error{ErrorCode::input, "is damaged: a part of it is another one", what,
                   "take a copy of the project, or make it anew of its model files"};
  return head;
}

Result<std::vector<PartRow>> read_part_rows(Database& database, std::int64_t view,
                                            const std::string& what) {
  Result<Statement> select = database.prepare(
      "SELECT part, lines, made_from FROM drawing_part WHERE view = ?1 ORDER BY part");
  if (!select) return select.error();
  select->bind(1, view);
  std::vector<PartRow> rows;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return rows;
    if (select->integer(0) != static_cast<std::int64_t>(rows.size()))
      return database.damaged("a part of " + what + " is missing");
    const std::span<const std::byte> lines = select->bytes(1), made_from = select->bytes(2);
    rows.push_back({{lines.begin(), lines.end()}, {made_from.begin(), made_from.end()}});
  }
}

/// Returns what was written in one row, as versions of the tables before 5 did.
Result<DrawnState> decode_state_of_one_row(std::span<const std::byte> bytes,
                                           const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  DrawnState state;
  state.made_from = read_snapshot(*in);
  state.boxes = read_boxes(*in, state.made_from.identities.size());
  if (const Status status = in->finish(); !status) return status.error();
  return state;
}

/// Puts the values of a part where the state has them.
Status decode_state_part(std::span<const std::byte> bytes, ObjectRange objects,
                         const std::string& what, DrawnState& state) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  const std::vector<std::uint64_t> identities = in->column<std::uint64_t>();
  const std::vector<Hash128> signatures = in->column<Hash128>();
  if (identities.size() != objects.size() || signatures.size() != objects.size())
    in->refuse("it has not as many signatures as objects");
  const std::vector<Box3l> boxes = read_boxes(*in, objects.size());
  if (const Status status = in->finish(); !status) return status;
  const auto first = static_cast<std::ptrdiff_t>(objects.first);
  std::ranges::copy(identities, state.made_from.identities.begin() + first);
  std::ranges::copy(signatures, state.made_from.signatures.begin() + first);
  std::ranges::copy(boxes, state.boxes.begin() + first);
  return {};
}

BlobWriter write_state_part(const Snapshot& made_from, std::span<const Box3l> boxes,
                            ObjectRange objects) {
  BlobWriter out;
  out.column(std::span(made_from.identities).subspan(objects.first, objects.size()));
  out.column(std::span(made_from.signatures).subspan(objects.first, objects.size()));
  write_boxes(out, boxes.subspan(objects.first, objects.size()));
  return out;
}

Result<DrawnState> decode_state(const StateHead& head, std::span<const std::byte> bytes,
                                const std::vector<PartRow>& parts, const std::string& what,
                                const parallel::Context& context) {
  const auto objects = static_cast<std::size_t>(head.objects);
  DrawnState state;
  state.parts = {BlobReader::raw_hash(bytes), head.parts};
  state.made_from.whole = head.whole;
  state.made_from.names = head.names;
  state.made_from.identities.resize(objects);
  state.made_from.signatures.resize(objects);
  state.boxes.resize(objects);
  const Status status =
      parallel::for_each(context, {.name = "stored state", .n = parts.size()}, [&](std::size_t k) {
        return decode_state_part(parts[k].made_from, objects_of_drawing_part(k, objects), what,
                                 state);
      });
  if (!status) return status.error();
  return state;
}

/// The row of a drawing, and those of its parts.
struct DrawingRows {
  Bytes lines, made_from;
  std::vector<PartRow> parts;
};

Result<std::optional<DrawingRows>> read_rows_of(Database& database, std::int64_t view,
                                                std::optional<std::string_view> program,
                                                const std::string& what) {
  Result<Statement> select =
      database.prepare("SELECT lines, made_from, program FROM drawing WHERE view = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, view).step();
  if (!there) return there.error();
  if (!*there || (program && select->text(2) != *program)) return std::optional<DrawingRows>();
  const std::span<const std::byte> lines = select->bytes(0), made_from = select->bytes(1);
  DrawingRows rows{{lines.begin(), lines.end()}, {made_from.begin(), made_from.end()}, {}};
  Result<std::vector<PartRow>> parts = read_part_rows(database, view, what);
  if (!parts) return parts.error();
  rows.parts = std::move(*parts);
  return std::optional(std::move(rows));
}

Result<hlr::Drawing> decode_lines(const DrawingRows& rows, std::size_t objects,
                                  const std::string& what, const parallel::Context& context) {
  Result<BlobReader> in = BlobReader::open(rows.lines, what);
  if (!in) return in.error();
  std::vector<std::span<const std::byte>> parts;
  parts.reserve(rows.parts.size());
  for (const PartRow& row : rows.parts) parts.emplace_back(row.lines);
  Result<hlr::Drawing> drawing =
      parts.empty() ? read_drawing(*in, context) : read_parts_of_drawing(*in, parts, what, context);
  if (!drawing) return drawing;
  if (!in->failed() && drawing->account.fates.size() != objects)
    in->refuse("it is of another number of objects than its state");
  if (const Status status = in->finish(); !status) return status.error();
  return drawing;
}

/// Encodes a part; without bytes where it is stored.
Result<EncodedDrawingPart> encode_part(const DrawingToStore& to_store, std::size_t part) {
  const std::size_t objects = to_store.made_from.identities.size();
  const ObjectRange range = objects_of_drawing_part(part, objects);
  const StoredDrawing* const stored = to_store.stored;
  const bool is_known =
      stored != nullptr && part < stored->parts.hashes.size() &&
      objects_of_drawing_part(part, stored->made_from.identities.size()).last == range.last;
  if (is_known && to_store.touched != nullptr && !to_store.touched->empty()) {
    const auto same = [&](const auto& then, const auto& now) {
      return std::ranges::equal(std::span(then).subspan(range.first, range.size()),
                                std::span(now).subspan(range.first, range.size()));
    };
    bool stands = same(stored->made_from.identities, to_store.made_from.identities) &&
                  same(stored->made_from.signatures, to_store.made_from.signatures) &&
                  same(stored->boxes, to_store.boxes);
    for (std::size_t o = range.first; stands && o < range.last; ++o)
      stands = !(*to_store.touched)[o];
    if (stands) return EncodedDrawingPart{stored->parts.hashes[part], {}, {}};
  }
  BlobWriter lines;
  if (const Status written = write_lines(lines, to_store.drawing, range); !written)
    return written.error();
  BlobWriter state = write_state_part(to_store.made_from, to_store.boxes, range);
  EncodedDrawingPart encoded{{lines.raw_hash(), state.raw_hash()}, {}, {}};
  if (is_known && encoded.hashes == stored->parts.hashes[part]) return encoded;
  Result<Bytes> bytes = lines.finish();
  if (!bytes) return bytes.error();
  encoded.lines = std::move(*bytes);
  bytes = state.finish();
  if (!bytes) return bytes.error();
  encoded.made_from = std::move(*bytes);
  return encoded;
}

}  // namespace

Result<std::optional<StoredDrawing>> read_drawing_rows(Database& database, std::int64_t view,
                                                       const WantedDrawing& wanted,
                                                       const std::string& of_view,
                                                       const parallel::Context& context) {
  const std::string what = "the drawing" + of_view, what_state = "the state" + of_view;
  const Result<std::optional<DrawingRows>> found =
      read_rows_of(database, view, wanted.program, what);
  if (!found) return found.error();
  if (!*found) return std::optional<StoredDrawing>();
  const DrawingRows& rows = **found;
  Result<DrawnState> state = DrawnState();
  if (rows.parts.empty()) {
    state = decode_state_of_one_row(rows.made_from, what_state);
  } else {
    const Result<StateHead> head = decode_state_head(rows.made_from, rows.parts, what_state);
    if (!head) return head.error();
    if (wanted.whole && *wanted.whole != head->whole) return std::optional<StoredDrawing>();
    state = decode_state(*head, rows.made_from, rows.parts, what_state, context);
  }
  if (!state) return state.error();
  if (wanted.whole && *wanted.whole != state->made_from.whole)
    return std::optional<StoredDrawing>();
  Result<hlr::Drawing> drawing = decode_lines(rows, state->boxes.size(), what, context);
  if (!drawing) return drawing.error();
  return std::optional(StoredDrawing{std::move(*drawing), std::move(state->made_from),
                                     std::move(state->boxes), std::move(state->parts)});
}

Result<EncodedDrawing> encode_drawing(const DrawingToStore& to_store,
                                      const parallel::Context& context) {
  const std::size_t objects = to_store.drawing.account.fates.size();
  const Snapshot& made_from = to_store.made_from;
  const auto lacks = [&](std::size_t size) { return size != 0 && size != objects; };
  if (made_from.identities.size() != objects || made_from.signatures.size() != objects ||
      to_store.boxes.size() != objects || to_store.drawing.counted.size() != objects ||
      (to_store.touched != nullptr && lacks(to_store.touched->size())) ||
      lacks(to_store.drawing.left_out.size()) || lacks(to_store.drawing.clipped_left_out.size()) ||
      lacks(to_store.drawing.hatches.size()))
    return Error{ErrorCode::internal,
                 "a drawing and what it was solved from are not of the same objects",
                 {},
                 {}};
  Result<std::vector<EncodedDrawingPart>> parts =
      parallel::transform(context, {.name = "encode lines", .n = count_drawing_parts(objects)},
                          [&](std::size_t k) { return encode_part(to_store, k); });
  if (!parts) return parts.error();
  StateHead head{made_from.whole, made_from.names, objects, {}};
  for (const EncodedDrawingPart& part : *parts) head.parts.push_back(part.hashes);
  BlobWriter lines;
  write_head(lines, to_store.drawing);
  Result<Bytes> of_lines = lines.finish();
  if (!of_lines) return of_lines.error();
  Result<Bytes> of_state = write_state_head(head).finish();
  if (!of_state) return of_state.error();
  return EncodedDrawing{std::move(*of_lines), std::move(*of_state), std::move(*parts)};
}

Result<bool> is_still_stored(Database& database, std::int64_t view, const StoredDrawing& stored) {
  if (stored.parts.hashes.empty()) return false;
  Result<Statement> select = database.prepare("SELECT made_from FROM drawing WHERE view = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, view).step();
  if (!there) return there.error();
  return *there && BlobReader::raw_hash(select->bytes(0)) == stored.parts.seal;
}

Status write_drawing_parts(Database& database, std::int64_t view,
                           std::span<const EncodedDrawingPart> parts) {
  Result<Statement> remove =
      database.prepare("DELETE FROM drawing_part WHERE view = ?1 AND part >= ?2");
  if (!remove) return remove.error();
  remove->bind(1, view).bind(2, static_cast<std::int64_t>(parts.size()));
  if (const Status status = remove->run(); !status) return status;
  Result<Statement> put = database.prepare(
      "INSERT OR REPLACE INTO drawing_part (view, part, lines, made_from) "
      "VALUES (?1, ?2, ?3, ?4)");
  if (!put) return put.error();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].lines.empty()) continue;
    put->bind(1, view).bind(2, static_cast<std::int64_t>(k));
    put->bind(3, std::span<const std::byte>(parts[k].lines));
    put->bind(4, std::span<const std::byte>(parts[k].made_from));
    if (const Status status = put->run(); !status) return status;
  }
  return {};
}

namespace {

Result<std::vector<std::int64_t>> views_with_drawings(Database& database) {
  Result<Statement> select = database.prepare("SELECT view FROM drawing ORDER BY view");
  if (!select) return select.error();
  std::vector<std::int64_t> views;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return views;
    views.push_back(select->integer(0));
  }
}

Status write_state_of_all(Database& database, std::int64_t view, BlobWriter state) {
  Result<Statement> update = database.prepare("UPDATE drawing SET made_from = ?2 WHERE view = ?1");
  if (!update) return update.error();
  const Result<Bytes> bytes = state.finish();
  if (!bytes) return bytes.error();
  return update->bind(1, view).bind(2, std::span<const std::byte>(*bytes)).run();
}

/// Writes the parts of a state whose bytes are others than those stored.
Status write_state_parts(Database& database, std::int64_t view, DrawnState& state) {
  Result<Statement> update =
      database.prepare("UPDATE drawing_part SET made_from = ?3 WHERE view = ?1 AND part = ?2");
  if (!update) return update.error();
  const std::size_t objects = state.boxes.size();
  for (std::size_t k = 0; k < state.parts.hashes.size(); ++k) {
    BlobWriter part =
        write_state_part(state.made_from, state.boxes, objects_of_drawing_part(k, objects));
    Hash128& hash = state.parts.hashes[k].made_from;
    if (part.raw_hash() == hash) continue;
    hash = part.raw_hash();
    const Result<Bytes> bytes = part.finish();
    if (!bytes) return bytes.error();
    update->bind(1, view).bind(2, static_cast<std::int64_t>(k));
    update->bind(3, std::span<const std::byte>(*bytes));
    if (const Status status = update->run(); !status) return status;
  }
  return {};
}

Status unless_damaged(const Error& error) {
  return error.code == ErrorCode::input ? Status() : Status(error);
}

Status rename_objects_of(Database& database, std::int64_t view, const NewIdentities& renamed) {
  const std::string what = "the state of a drawing";
  const Result<std::optional<DrawingRows>> found = read_rows_of(database, view, std::nullopt, what);
  if (!found) return unless_damaged(found.error());
  if (!*found) return {};
  const DrawingRows& rows = **found;
  if (rows.parts.empty()) {
    Result<DrawnState> state = decode_state_of_one_row(rows.made_from, what);
    if (!state) return unless_damaged(state.error());
    rename_objects(state->made_from, renamed);
    BlobWriter out;
    write(out, state->made_from);
    write_boxes(out, state->boxes);
    return write_state_of_all(database, view, std::move(out));
  }
  const Result<StateHead> head = decode_state_head(rows.made_from, rows.parts, what);
  if (!head) return unless_damaged(head.error());
  Result<DrawnState> state = decode_state(*head, rows.made_from, rows.parts, what, {});
  if (!state) return unless_damaged(state.error());
  rename_objects(state->made_from, renamed);
  if (const Status status = write_state_parts(database, view, *state); !status) return status;
  return write_state_of_all(
      database, view,
      write_state_head({head->whole, state->made_from.names, head->objects, state->parts.hashes}));
}

}  // namespace

Status rename_objects_of_drawings(Database& database, const NewIdentities& renamed) {
  const Result<std::vector<std::int64_t>> views = views_with_drawings(database);
  if (!views) return views.error();
  for (const std::int64_t view : *views)
    if (const Status status = rename_objects_of(database, view, renamed); !status) return status;
  return {};
}

}  // namespace strake::project
