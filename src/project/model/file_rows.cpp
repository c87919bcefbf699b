// SPDX-License-Identifier: Apache-2.0
#include "project/model/file_rows.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "model/file_labels.hpp"
#include "project/database/map_places.hpp"

namespace strake::project {
namespace {

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

/// Takes the values of a row one after the other.
class RowReader {
 public:
  explicit RowReader(const Statement& row) : row_(row) {}
  std::string text() { return std::string(row_.text(column_++)); }
  std::int64_t integer() { return row_.integer(column_++); }
  double real() { return row_.real(column_++); }
  /// Takes how many there are of something; more than can be numbered is a fault.
  std::uint64_t count() {
    const std::int64_t value = integer();
    sound_ = sound_ && value >= 0 && value < std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint64_t>(value);
  }
  std::optional<Hash128> hash() { return row_.hash(column_++); }
  template <class T, class Take>
  std::optional<T> optional(Take&& take) {
    if (!row_.is_null(column_)) return take();
    ++column_;
    return std::nullopt;
  }
  void refuse() { sound_ = false; }
  [[nodiscard]] bool sound() const { return sound_; }

 private:
  const Statement& row_;
  int column_ = 0;
  bool sound_ = true;
};

std::optional<io::UpAxis> axis_of(std::string_view name) {
  for (std::size_t k = 0; k < kAxes.size(); ++k)
    if (kAxes[k] == name) return static_cast<io::UpAxis>(k);
  return std::nullopt;
}

constexpr std::string_view kColumns =
    "position, path, given, name, label, format, unit, up_axis, bytes, precision_mm, folders, "
    "ends_early, option_unit_mm, option_up_axis, option_encoding, content, objects, bodies, "
    "shapes, groups, group_attributes, blocks";
constexpr int kColumnCount = 22;

/// Returns nothing where a value cannot be.
std::optional<FileRow> row_of(const Statement& statement) {
  RowReader in(statement);
  FileRow row;
  row.file.id = in.integer();
  row.position = in.integer();
  row.file.path = in.text();
  row.file.given = in.text();
  row.name = in.text();
  model::SourceFile& source = row.file.source;
  source.label = in.text();
  source.format = in.text();
  source.unit = in.text();
  source.up_axis = in.text();
  source.bytes = static_cast<std::uint64_t>(in.integer());
  source.precision_mm = in.real();
  source.folders = in.text();
  source.ends_early = in.integer() != 0;
  io::ReadOptions& options = row.file.options;
  options.unit_mm = in.optional<double>([&] { return in.real(); });
  if (const auto axis = in.optional<std::string>([&] { return in.text(); })) {
    options.up_axis = axis_of(*axis);
    if (!options.up_axis) in.refuse();
  }
  options.encoding = in.optional<std::string>([&] { return in.text(); });
  const auto content = in.hash();
  if (!content || row.file.id <= 0) in.refuse();
  row.file.content = content.value_or(Hash128());
  row.file.objects = in.count();
  row.file.bodies = in.count();
  row.shapes = in.count();
  row.groups = in.count();
  row.group_attributes = in.count();
  const auto blocks = in.hash();
  if (!blocks) in.refuse();
  row.blocks = blocks.value_or(Hash128());
  if (!statement.is_null(kColumnCount + 1)) {
    row.map = map_place_of(statement.text(kColumnCount + 1), statement.bytes(kColumnCount + 2));
    if (!row.map) in.refuse();
  }
  if (!in.sound()) return std::nullopt;
  return row;
}

/// Binds the values of a row to parameters 1, 2, … `path` must last until the statement has run.
void bind_row(Statement& out, const FileRow& row, std::string_view path) {
  int at = 0;
  const auto integer = [&](auto value) { out.bind(++at, static_cast<std::int64_t>(value)); };
  const auto text = [&](std::string_view value) { out.bind(++at, value); };
  const model::SourceFile& source = row.file.source;
  const io::ReadOptions& options = row.file.options;
  integer(row.position);
  text(path);
  text(row.file.given);
  text(row.name);
  text(source.label);
  text(source.format);
  text(source.unit);
  text(source.up_axis);
  integer(source.bytes);
  out.bind(++at, source.precision_mm);
  text(source.folders);
  integer(source.ends_early ? 1 : 0);
  // What is not bound is NULL.
  ++at;
  if (options.unit_mm) out.bind(at, *options.unit_mm);
  ++at;
  if (options.up_axis) out.bind(at, kAxes[static_cast<std::size_t>(*options.up_axis)]);
  ++at;
  if (options.encoding) out.bind(at, std::string_view(*options.encoding));
  out.bind(++at, row.file.content);
  integer(row.file.objects);
  integer(row.file.bodies);
  integer(row.shapes);
  integer(row.groups);
  integer(row.group_attributes);
  out.bind(++at, row.blocks);
}

/// Returns the hash of all that the rows say.
Hash128 seal_of(const std::vector<FileRow>& rows) {
  if (rows.empty()) return {};
  Hasher hasher;
  for (const FileRow& row : rows) {
    const model::SourceFile& source = row.file.source;
    const io::ReadOptions& options = row.file.options;
    hasher.add(row.file.id).add(row.position).add(row.file.path.string()).add(row.file.given);
    for (const std::string* const text :
         {&row.name, &source.label, &source.format, &source.unit, &source.up_axis, &source.folders})
      hasher.add(*text);
    hasher.add(source.bytes).add(source.precision_mm).add(std::uint64_t{source.ends_early});
    hasher.add(std::uint64_t{options.unit_mm.has_value()}).add(options.unit_mm.value_or(0));
    hasher.add(options.up_axis ? static_cast<std::int64_t>(*options.up_axis) : std::int64_t{-1});
    hasher.add(std::uint64_t{options.encoding.has_value()}).add(options.encoding.value_or(""));
    for (const Hash128& hash : {row.file.content, row.blocks}) hasher.add(hash.high).add(hash.low);
    for (const std::uint64_t count :
         {row.file.objects, row.file.bodies, row.shapes, row.groups, row.group_attributes})
      hasher.add(count);
    // Versions of the tables before 5 knew of no places: their seals hold.
    if (row.map) add_to(hasher, *row.map);
  }
  return hasher.value();
}

}  // namespace

Result<std::vector<FileRow>> read_rows(Database& database) {
  Result<Statement> statement =
      database.prepare(fmt::format("SELECT id, {}, crs, to_map FROM file LEFT JOIN map_place ON "
                                   "map_place.file = id ORDER BY position",
                                   kColumns));
  if (!statement) return statement.error();
  std::vector<FileRow> rows;
  for (;;) {
    const Result<bool> more = statement->step();
    if (!more) return more.error();
    if (!*more) return rows;
    std::optional<FileRow> row = row_of(*statement);
    if (!row || (!rows.empty() && row->position <= rows.back().position))
      return database.damaged("a row of the table 'file' cannot be");
    rows.push_back(std::move(*row));
  }
}

Result<Hash128> model_seal(Database& database) {
  Result<Statement> select = database.prepare("SELECT files FROM model_seal");
  if (!select) return select.error();
  const Result<bool> found = select->step();
  if (!found) return found.error();
  const std::optional<Hash128> seal = *found ? select->hash(0) : std::nullopt;
  if (!seal) return database.damaged("nothing says which files it has");
  return *seal;
}

Result<std::vector<FileRow>> read_sealed_rows(Database& database) {
  Result<std::vector<FileRow>> rows = read_rows(database);
  if (!rows) return rows;
  const Result<Hash128> seal = model_seal(database);
  if (!seal) return seal.error();
  if (*seal != seal_of(*rows))
    return database.damaged("the rows of 'file' are not those that were stored");
  return rows;
}

Status write_row(Database& database, FileRow& row) {
  const bool is_new = row.file.id == 0;
  std::string marks = "?1";
  for (int k = 2; k <= kColumnCount; ++k) marks += fmt::format(", ?{}", k);
  Result<Statement> statement =
      database.prepare(is_new ? fmt::format("INSERT INTO file ({}) VALUES ({})", kColumns, marks)
                              : fmt::format("UPDATE file SET ({}) = ({}) WHERE id = ?{}", kColumns,
                                            marks, kColumnCount + 1));
  if (!statement) return statement.error();
  const std::string path = row.file.path.string();
  bind_row(*statement, row, path);
  if (!is_new) statement->bind(kColumnCount + 1, row.file.id);
  if (const Status status = statement->run(); !status) return status;
  if (is_new) row.file.id = database.last_insert_id();
  return write_map_place(database, row.file.id, row.map);
}

LabelledFiles labelled(const std::vector<FileRow>& rows) {
  model::Model model;
  for (const FileRow& row : rows) {
    model.files.push_back(row.file.source);
    model.files.back().label = row.name;
  }
  LabelledFiles labelled;
  labelled.number = model::label_and_sort_files(model);
  labelled.files = std::move(model.files);
  return labelled;
}

Status write_labels(Database& database) {
  const Result<std::vector<FileRow>> rows = read_rows(database);
  if (!rows) return rows.error();
  const LabelledFiles files = labelled(*rows);
  // Labels are unique at any moment, also where two change places.
  if (const Status status = database.execute("UPDATE file SET label = '//' || id"); !status)
    return status;
  Result<Statement> statement = database.prepare("UPDATE file SET label = ?1 WHERE id = ?2");
  if (!statement) return statement.error();
  for (std::size_t i = 0; i < rows->size(); ++i) {
    statement->bind(1, std::string_view(files.files[files.number[i]].label));
    statement->bind(2, (*rows)[i].file.id);
    if (const Status status = statement->run(); !status) return status;
  }
  const Result<std::vector<FileRow>> written = read_rows(database);
  if (!written) return written.error();
  Result<Statement> seal = database.prepare("UPDATE model_seal SET files = ?1");
  if (!seal) return seal.error();
  return seal->bind(1, seal_of(*written)).run();
}

}  // namespace strake::project
