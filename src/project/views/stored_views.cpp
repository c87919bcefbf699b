// SPDX-License-Identifier: Apache-2.0
#include "project/views/stored_views.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/snapshot/object_names.hpp"
#include "project/views/drawing_codec.hpp"
#include "project/views/number_columns.hpp"
#include "project/views/view_codec.hpp"
#include "strake/core/version.hpp"

namespace strake::project {

namespace {

using geometry::Box3l;

constexpr std::string_view kListViews =
    "SELECT v.name, v.settings, v.created, v.changed, d.program, d.drawn, d.objects, d.pieces, "
    "d.edges, d.edges_solved, d.seconds FROM view v LEFT JOIN drawing d ON d.view = v.id "
    "ORDER BY v.name";

std::uint64_t count_of(const Statement& row, int column) {
  return static_cast<std::uint64_t>(row.integer(column));
}

StoredView view_of(const Statement& row) {
  StoredView view{std::string(row.text(0)), std::string(row.text(1)), std::string(row.text(2)),
                  std::string(row.text(3)), std::nullopt};
  if (row.is_null(4)) return view;
  view.last = DrawnView{.program = std::string(row.text(4)),
                        .drawn = std::string(row.text(5)),
                        .objects = count_of(row, 6),
                        .pieces = count_of(row, 7),
                        .edges = count_of(row, 8),
                        .edges_solved = count_of(row, 9),
                        .seconds = row.real(10)};
  return view;
}

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
};

Result<DrawnState> decode_state(std::span<const std::byte> bytes, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  DrawnState state;
  state.made_from = read_snapshot(*in);
  state.boxes = read_boxes(*in, state.made_from.identities.size());
  if (const Status status = in->finish(); !status) return status.error();
  return state;
}

Result<std::vector<std::byte>> encode_state(const Snapshot& made_from,
                                            std::span<const Box3l> boxes) {
  BlobWriter out;
  write(out, made_from);
  write_boxes(out, boxes);
  return out.finish();
}

/// Returns nothing where the drawing was solved under another signature than `whole`, if that is
/// given.
Result<std::optional<StoredDrawing>> decode(const Statement& row, std::string_view name,
                                            const std::optional<Hash128>& whole,
                                            const parallel::Context& context) {
  const std::string of_view = " of the view '" + std::string(name) + "'";
  StoredDrawing stored;
  Result<DrawnState> state = decode_state(row.bytes(1), "the state" + of_view);
  if (!state) return state.error();
  stored.made_from = std::move(state->made_from);
  stored.boxes = std::move(state->boxes);
  if (whole && *whole != stored.made_from.whole) return std::optional<StoredDrawing>();
  Result<BlobReader> lines = BlobReader::open(row.bytes(0), "the drawing" + of_view);
  if (!lines) return lines.error();
  Result<hlr::Drawing> drawing = read_drawing(*lines, context);
  if (!drawing) return drawing.error();
  stored.drawing = std::move(*drawing);
  if (!lines->failed() && stored.drawing.account.fates.size() != stored.boxes.size())
    lines->refuse("it is of another number of objects than its state");
  if (const Status status = lines->finish(); !status) return status.error();
  return std::optional(std::move(stored));
}

/// A drawing as the bytes of its row.
struct EncodedDrawing {
  std::vector<std::byte> lines, made_from, names, far_objects;
};

Result<EncodedDrawing> encode(const ViewToStore& view) {
  BlobWriter lines;
  write(lines, *view.drawing);
  auto bytes = lines.finish();
  if (!bytes) return bytes.error();
  auto state = encode_state(*view.made_from, *view.boxes);
  if (!state) return state.error();
  auto names = encode_names(*view.model);
  if (!names) return names.error();
  BlobWriter far;
  far.column(view.far_objects);
  auto far_objects = far.finish();
  if (!far_objects) return far_objects.error();
  return EncodedDrawing{std::move(*bytes), std::move(*state), std::move(*names),
                        std::move(*far_objects)};
}

constexpr std::string_view kSaveSettings =
    "INSERT INTO view (name, settings, created, changed) VALUES (?1, ?2, "
    "strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), strftime('%Y-%m-%dT%H:%M:%SZ', 'now')) "
    "ON CONFLICT (name) DO UPDATE SET settings = excluded.settings, changed = excluded.changed "
    "WHERE settings <> excluded.settings";

constexpr std::string_view kSaveDrawing =
    "INSERT OR REPLACE INTO drawing (view, program, drawn, objects, pieces, edges, edges_solved, "
    "seconds, lines, made_from) SELECT id, ?2, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), ?3, ?4, ?5, "
    "?6, ?7, ?8, ?9 FROM view WHERE name = ?1";

constexpr std::string_view kSaveObjects =
    "INSERT OR REPLACE INTO drawing_objects (view, names, far) SELECT id, ?2, ?3 FROM view "
    "WHERE name = ?1";

Status save_settings(Database& database, const ViewToStore& view) {
  auto statement = database.prepare(kSaveSettings);
  if (!statement) return statement.error();
  return statement->bind(1, view.name).bind(2, *view.settings).run();
}

Status save_drawing(Database& database, const ViewToStore& view, const EncodedDrawing& encoded) {
  auto statement = database.prepare(kSaveDrawing);
  if (!statement) return statement.error();
  const auto whole = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  statement->bind(1, view.name)
      .bind(2, version())
      .bind(3, whole(view.drawing->account.fates.size()))
      .bind(4, whole(view.drawing->pieces.size()))
      .bind(5, whole(view.drawing->counters.feature_edges))
      .bind(6, whole(view.edges_solved))
      .bind(7, view.seconds)
      .bind(8, std::span<const std::byte>(encoded.lines))
      .bind(9, std::span<const std::byte>(encoded.made_from));
  if (const Status status = statement->run(); !status) return status;
  auto objects = database.prepare(kSaveObjects);
  if (!objects) return objects.error();
  return objects->bind(1, view.name)
      .bind(2, std::span<const std::byte>(encoded.names))
      .bind(3, std::span<const std::byte>(encoded.far_objects))
      .run();
}

}  // namespace

Result<std::vector<StoredView>> list_views(Database& database) {
  auto statement = database.prepare(kListViews);
  if (!statement) return statement.error();
  std::vector<StoredView> views;
  for (;;) {
    const Result<bool> there = statement->step();
    if (!there) return there.error();
    if (!*there) return views;
    views.push_back(view_of(*statement));
  }
}

Result<StoredView> find_view(Database& database, std::string_view name) {
  auto views = list_views(database);
  if (!views) return views.error();
  std::string names;
  for (StoredView& view : *views) {
    if (view.name == name) return std::move(view);
    names += (names.empty() ? "there are " : ", ") + ("'" + view.name + "'");
  }
  return Error{ErrorCode::usage,
               "the project has no view '" + std::string(name) + "'",
               {},
               names.empty() ? "'strake draw -p FILE --save NAME' makes one" : names};
}

Result<std::optional<StoredDrawing>> load_drawing(Database& database, std::string_view name,
                                                  const Hash128& whole,
                                                  const parallel::Context& context) {
  auto statement = database.prepare(
      "SELECT d.lines, d.made_from FROM drawing d JOIN view v ON v.id = d.view "
      "JOIN drawing_objects o ON o.view = d.view WHERE v.name = ?1 AND d.program = ?2");
  if (!statement) return statement.error();
  const Result<bool> there = statement->bind(1, name).bind(2, version()).step();
  if (!there) return there.error();
  if (!*there) return std::optional<StoredDrawing>();
  return decode(*statement, name, whole, context);
}

namespace {

/// Reads the objects of a drawing from the columns `names` and `far` of a row.
Status read_former_objects(const Statement& row, int names, int far, const std::string& of_view,
                           FormerDrawing& former) {
  Result<model::Model> model = decode_names(row.bytes(names), "the objects" + of_view);
  if (!model) return model.error();
  former.model = std::move(*model);
  Result<BlobReader> in = BlobReader::open(row.bytes(far), "the far objects" + of_view);
  if (!in) return in.error();
  former.far_objects = in->column<model::ObjectId>();
  for (const model::ObjectId id : former.far_objects)
    if (model::index(id) >= former.model.objects.size()) in->refuse("there is no such object");
  return in->finish();
}

}  // namespace

Result<FormerDrawing> former_drawing(Database& database, std::string_view name,
                                     const parallel::Context& context) {
  const Result<StoredView> view = find_view(database, name);
  if (!view) return view.error();
  auto statement = database.prepare(
      "SELECT d.lines, d.made_from, o.names, o.far FROM drawing d JOIN drawing_objects o ON "
      "o.view = d.view JOIN view v ON v.id = d.view WHERE v.name = ?1");
  if (!statement) return statement.error();
  const Result<bool> there = statement->bind(1, name).step();
  if (!there) return there.error();
  const std::string of_view = " of the view '" + std::string(name) + "'";
  if (!*there)
    return Error{ErrorCode::usage,
                 "there is no drawing" + of_view + " with the names of its objects",
                 {},
                 "'strake draw -p FILE --stored NAME' stores one"};
  Result<std::optional<StoredDrawing>> stored = decode(*statement, name, std::nullopt, context);
  if (!stored) return stored.error();
  FormerDrawing former;
  former.drawing = std::move((**stored).drawing);
  if (const Status status = read_former_objects(*statement, 2, 3, of_view, former); !status)
    return status.error();
  if (former.model.objects.size() != former.drawing.account.fates.size())
    return database.damaged("the drawing" + of_view +
                            " is of another number of objects than are named");
  return former;
}

Status store_view(Database& database, const ViewToStore& view) {
  EncodedDrawing encoded;
  if (view.drawing != nullptr) {
    auto bytes = encode(view);
    if (!bytes) return bytes.error();
    encoded = std::move(*bytes);
  }
  Result<Transaction> transaction = Transaction::begin(database);
  if (!transaction) return transaction.error();
  if (view.settings)
    if (Status status = save_settings(database, view); !status) return status;
  if (view.drawing != nullptr)
    if (Status status = save_drawing(database, view, encoded); !status) return status;
  return transaction->commit();
}

Status rename_objects_of_views(Database& database, const NewIdentities& renamed) {
  auto select = database.prepare("SELECT view, made_from FROM drawing ORDER BY view");
  if (!select) return select.error();
  std::vector<std::pair<std::int64_t, DrawnState>> states;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) break;
    Result<DrawnState> state = decode_state(select->bytes(1), "the state of a drawing");
    if (state) states.emplace_back(select->integer(0), std::move(*state));
  }
  auto update = database.prepare("UPDATE drawing SET made_from = ?2 WHERE view = ?1");
  if (!update) return update.error();
  for (auto& [view, state] : states) {
    rename_objects(state.made_from, renamed);
    const auto bytes = encode_state(state.made_from, state.boxes);
    if (!bytes) return bytes.error();
    update->bind(1, view).bind(2, std::span<const std::byte>(*bytes));
    if (const Status status = update->run(); !status) return status;
  }
  return {};
}

namespace {

/// Reads the drawing that a row of check_views() stands at.
Status check_drawing(const Database& database, const Statement& row,
                     const parallel::Context& context) {
  const auto drawing = decode(row, row.text(2), std::nullopt, context);
  if (!drawing) return drawing.error();
  if (!row.is_null(5)) {
    FormerDrawing former;
    const std::string of_view = " of the view '" + std::string(row.text(2)) + "'";
    if (const Status status = read_former_objects(row, 5, 6, of_view, former); !status)
      return status;
    if (former.model.objects.size() != count_of(row, 3))
      return database.damaged("the objects" + of_view + " are not as many as its row says");
  }
  if ((**drawing).boxes.size() == count_of(row, 3) &&
      (**drawing).drawing.pieces.size() == count_of(row, 4))
    return {};
  return database.damaged("the drawing of the view '" + std::string(row.text(2)) +
                          "' is of another size than its row says");
}

}  // namespace

Result<std::vector<DamagedView>> check_views(Database& database, const parallel::Context& context) {
  auto statement = database.prepare(
      "SELECT d.lines, d.made_from, v.name, d.objects, d.pieces, o.names, o.far FROM drawing d "
      "JOIN view v ON v.id = d.view LEFT JOIN drawing_objects o ON o.view = d.view "
      "ORDER BY v.name");
  if (!statement) return statement.error();
  std::vector<DamagedView> damaged;
  for (;;) {
    const Result<bool> there = statement->step();
    if (!there) return there.error();
    if (!*there) return damaged;
    const Status status = check_drawing(database, *statement, context);
    if (status) continue;
    // A run that was ended says nothing of the drawing.
    if (status.error().code != ErrorCode::input) return status.error();
    damaged.push_back({std::string(statement->text(2)), status.error()});
  }
}

}  // namespace strake::project
