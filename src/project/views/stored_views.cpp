// SPDX-License-Identifier: Apache-2.0
#include "project/views/stored_views.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/snapshot/object_names.hpp"
#include "strake/core/version.hpp"

namespace strake::project {

namespace {

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

std::string of_view(std::string_view name) { return " of the view '" + std::string(name) + "'"; }

constexpr std::string_view kSaveSettings =
    "INSERT INTO view (name, settings, created, changed) VALUES (?1, ?2, "
    "strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), strftime('%Y-%m-%dT%H:%M:%SZ', 'now')) "
    "ON CONFLICT (name) DO UPDATE SET settings = excluded.settings, changed = excluded.changed "
    "WHERE settings <> excluded.settings";

constexpr std::string_view kSaveDrawing =
    "INSERT OR REPLACE INTO drawing (view, program, drawn, objects, pieces, edges, edges_solved, "
    "seconds, lines, made_from) VALUES (?1, ?2, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), ?3, ?4, ?5, "
    "?6, ?7, ?8, ?9)";

Status save_settings(Database& database, const ViewToStore& view) {
  auto statement = database.prepare(kSaveSettings);
  if (!statement) return statement.error();
  return statement->bind(1, view.name).bind(2, *view.settings).run();
}

/// Returns the number of a view; nothing where there is none.
Result<std::optional<std::int64_t>> number_of(Database& database, std::string_view name) {
  auto statement = database.prepare("SELECT id FROM view WHERE name = ?1");
  if (!statement) return statement.error();
  const Result<bool> there = statement->bind(1, name).step();
  if (!there) return there.error();
  return *there ? std::optional(statement->integer(0)) : std::nullopt;
}

Status save_drawing(Database& database, std::int64_t id, const ViewToStore& view,
                    const EncodedDrawing& encoded) {
  auto statement = database.prepare(kSaveDrawing);
  if (!statement) return statement.error();
  const auto whole = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  statement->bind(1, id)
      .bind(2, version())
      .bind(3, whole(view.drawing->account.fates.size()))
      .bind(4, whole(view.drawing->pieces.size()))
      .bind(5, whole(view.drawing->counters.feature_edges))
      .bind(6, whole(view.edges_solved))
      .bind(7, view.seconds)
      .bind(8, std::span<const std::byte>(encoded.lines))
      .bind(9, std::span<const std::byte>(encoded.made_from));
  if (const Status status = statement->run(); !status) return status;
  return write_drawing_parts(database, id, encoded.parts);
}

/// Writes the names of objects and which lie far from all others, unless that is stored. Names that
/// are known to be those stored are not looked at.
Status save_objects(Database& database, std::int64_t id, const ViewToStore& view, bool are_known) {
  BlobWriter far;
  far.column(view.far_objects);
  const auto far_objects = far.finish();
  if (!far_objects) return far_objects.error();
  auto select = database.prepare("SELECT names, far FROM drawing_objects WHERE view = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, id).step();
  if (!there) return there.error();
  const bool same_far = *there && std::ranges::equal(select->bytes(1), *far_objects);
  if (*there && are_known && same_far) return {};
  BlobWriter values = names_of(*view.model);
  if (same_far && BlobReader::raw_hash(select->bytes(0)) == values.raw_hash()) return {};
  select->reset();
  const auto names = values.finish();
  if (!names) return names.error();
  auto put = database.prepare(
      "INSERT OR REPLACE INTO drawing_objects (view, names, far) VALUES (?1, ?2, ?3)");
  if (!put) return put.error();
  return put->bind(1, id)
      .bind(2, std::span<const std::byte>(*names))
      .bind(3, std::span<const std::byte>(*far_objects))
      .run();
}

/// Stores a drawing, of which `encoded` has what is not stored if `view.stored` is. Where another
/// process has stored one meanwhile, all of it is written.
Status save(Database& database, const ViewToStore& view, const EncodedDrawing& encoded,
            const parallel::Context& context) {
  const Result<std::optional<std::int64_t>> id = number_of(database, view.name);
  if (!id) return id.error();
  // Somebody took it out of the project.
  if (!*id) return {};
  Result<bool> follows = false;
  if (view.stored != nullptr) follows = is_still_stored(database, **id, *view.stored);
  if (!follows) return follows.error();
  if (view.stored == nullptr || *follows) {
    if (const Status status = save_drawing(database, **id, view, encoded); !status) return status;
  } else {
    const Result<EncodedDrawing> all =
        encode_drawing({*view.drawing, *view.made_from, *view.boxes}, context);
    if (!all) return all.error();
    if (const Status status = save_drawing(database, **id, view, *all); !status) return status;
  }
  const bool are_known =
      *follows && is_same_known(view.stored->made_from.names, view.made_from->names);
  return save_objects(database, **id, view, are_known);
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
  const Result<std::optional<std::int64_t>> id = number_of(database, name);
  if (!id) return id.error();
  if (!*id) return std::optional<StoredDrawing>();
  // One without the names of its objects was stored by an earlier version.
  auto named = database.prepare("SELECT 1 FROM drawing_objects WHERE view = ?1");
  if (!named) return named.error();
  const Result<bool> there = named->bind(1, **id).step();
  if (!there) return there.error();
  if (!*there) return std::optional<StoredDrawing>();
  return read_drawing_rows(database, **id, {whole, version()}, of_view(name), context);
}

namespace {

/// Reads the objects of a drawing from the columns `names` and `far` of a row.
Status read_former_objects(const Statement& row, int names, int far, const std::string& view,
                           FormerDrawing& former) {
  Result<model::Model> model = decode_names(row.bytes(names), "the objects" + view);
  if (!model) return model.error();
  former.model = std::move(*model);
  Result<BlobReader> in = BlobReader::open(row.bytes(far), "the far objects" + view);
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
      "SELECT v.id, o.names, o.far FROM view v JOIN drawing d ON d.view = v.id "
      "JOIN drawing_objects o ON o.view = v.id WHERE v.name = ?1");
  if (!statement) return statement.error();
  const Result<bool> there = statement->bind(1, name).step();
  if (!there) return there.error();
  if (!*there)
    return Error{ErrorCode::usage,
                 "there is no drawing" + of_view(name) + " with the names of its objects",
                 {},
                 "'strake draw -p FILE --stored NAME' stores one"};
  Result<std::optional<StoredDrawing>> stored =
      read_drawing_rows(database, statement->integer(0), {}, of_view(name), context);
  if (!stored) return stored.error();
  FormerDrawing former;
  if (*stored) former.drawing = std::move((**stored).drawing);
  if (const Status status = read_former_objects(*statement, 1, 2, of_view(name), former); !status)
    return status.error();
  if (former.model.objects.size() != former.drawing.account.fates.size())
    return database.damaged("the drawing" + of_view(name) +
                            " is of another number of objects than are named");
  return former;
}

Status store_view(Database& database, const ViewToStore& view, const parallel::Context& context) {
  EncodedDrawing encoded;
  if (view.drawing != nullptr) {
    auto bytes = encode_drawing(
        {*view.drawing, *view.made_from, *view.boxes, view.stored, view.touched}, context);
    if (!bytes) return bytes.error();
    encoded = std::move(*bytes);
  }
  Result<Transaction> transaction = Transaction::begin(database);
  if (!transaction) return transaction.error();
  if (view.settings)
    if (Status status = save_settings(database, view); !status) return status;
  if (view.drawing != nullptr)
    if (Status status = save(database, view, encoded, context); !status) return status;
  return transaction->commit();
}

namespace {

/// Reads the drawing that a row of check_views() stands at.
Status check_drawing(Database& database, const Statement& row, const parallel::Context& context) {
  const std::string view = of_view(row.text(1));
  const auto stored = read_drawing_rows(database, row.integer(0), {}, view, context);
  if (!stored) return stored.error();
  if (!row.is_null(4)) {
    FormerDrawing former;
    if (const Status status = read_former_objects(row, 4, 5, view, former); !status) return status;
    if (former.model.objects.size() != count_of(row, 2))
      return database.damaged("the objects" + view + " are not as many as its row says");
  }
  if (*stored && (**stored).boxes.size() == count_of(row, 2) &&
      (**stored).drawing.pieces.size() == count_of(row, 3))
    return {};
  return database.damaged("the drawing" + view + " is of another size than its row says");
}

}  // namespace

Result<std::vector<DamagedView>> check_views(Database& database, const parallel::Context& context) {
  auto statement = database.prepare(
      "SELECT v.id, v.name, d.objects, d.pieces, o.names, o.far FROM drawing d "
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
    damaged.push_back({std::string(statement->text(1)), status.error()});
  }
}

}  // namespace strake::project
