// SPDX-License-Identifier: Apache-2.0
#include "strake/project/listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "project/database/database.hpp"
#include "strake/model/model.hpp"

namespace strake::project {
namespace {

/// How a column is read.
struct ListColumn {
  std::string_view name;
  char type = 't';  ///< i: integer, r: real, t: text
};

constexpr std::array kFileColumns{ListColumn{"label"},        ListColumn{"format"},
                                  ListColumn{"unit"},         ListColumn{"up_axis"},
                                  ListColumn{"objects", 'i'}, ListColumn{"bodies", 'i'},
                                  ListColumn{"bytes", 'i'},   ListColumn{"path"}};
constexpr std::array kRevisionColumns{ListColumn{"id", 'i'},       ListColumn{"at"},
                                      ListColumn{"what"},          ListColumn{"added", 'i'},
                                      ListColumn{"removed", 'i'},  ListColumn{"moved", 'i'},
                                      ListColumn{"reshaped", 'i'}, ListColumn{"reattributed", 'i'},
                                      ListColumn{"renamed", 'i'},  ListColumn{"unchanged", 'i'}};
constexpr std::array kTestColumns{ListColumn{"name"},
                                  ListColumn{"last_run", 'i'},
                                  ListColumn{"started"},
                                  ListColumn{"objects", 'i'},
                                  ListColumn{"hit", 'i'},
                                  ListColumn{"contact", 'i'},
                                  ListColumn{"clearance_violation", 'i'}};
constexpr std::array kRunColumns{ListColumn{"run", 'i'},
                                 ListColumn{"started"},
                                 ListColumn{"who"},
                                 ListColumn{"test"},
                                 ListColumn{"how"},
                                 ListColumn{"tested_pairs", 'i'},
                                 ListColumn{"hit", 'i'},
                                 ListColumn{"contact", 'i'},
                                 ListColumn{"clearance_violation", 'i'},
                                 ListColumn{"new", 'i'},
                                 ListColumn{"active", 'i'},
                                 ListColumn{"reviewed", 'i'},
                                 ListColumn{"approved", 'i'},
                                 ListColumn{"resolved", 'i'},
                                 ListColumn{"seconds", 'r'}};
constexpr std::array kClashColumns{
    ListColumn{"key"},       ListColumn{"test"},   ListColumn{"status"}, ListColumn{"class"},
    ListColumn{"d_mm", 'r'}, ListColumn{"a_file"}, ListColumn{"a_id"},   ListColumn{"b_file"},
    ListColumn{"b_id"},      ListColumn{"comment"}};
constexpr std::array kViewColumns{ListColumn{"name"},       ListColumn{"changed"},
                                  ListColumn{"drawn"},      ListColumn{"objects", 'i'},
                                  ListColumn{"edges", 'i'}, ListColumn{"seconds", 'r'}};

/// What a list is read by: the columns of the query are those of the list.
struct ListSource {
  std::span<const ListColumn> columns;
  std::string_view select, from;
};

ListSource source_of(ListKind kind) {
  switch (kind) {
    case ListKind::files:
      return {kFileColumns, "label, format, unit, up_axis, objects, bodies, bytes, path",
              "FROM file ORDER BY label"};
    case ListKind::revisions:
      return {kRevisionColumns,
              "id, at, what, added, removed, moved, reshaped, reattributed, renamed, unchanged",
              "FROM revision ORDER BY id DESC"};
    case ListKind::tests:
      return {kTestColumns,
              "test.name, test.run, run.started, test.objects, run_test.hit, run_test.contact, "
              "run_test.clearance_violation",
              "FROM test JOIN run ON run.id = test.run LEFT JOIN run_test ON run_test.run = "
              "test.run AND run_test.test = test.id ORDER BY test.name"};
    case ListKind::runs:
      return {kRunColumns,
              "run.id, run.started, run.who, test.name, how, tested_pairs, hit, contact, "
              "clearance_violation, new, active, reviewed, approved, resolved, run.seconds",
              "FROM run_test JOIN run ON run.id = run_test.run JOIN test ON test.id = "
              "run_test.test ORDER BY run.id DESC, test.name"};
    case ListKind::clashes:
      return {kClashColumns,
              "key, test_name, status, class, d_mm, a_file, a_id, b_file, b_id, comment",
              "FROM clashes ORDER BY d_mm, key"};
    case ListKind::views:
    case ListKind::shapes:
      break;
  }
  return {kViewColumns, "view.name, view.changed, drawn, objects, edges, seconds",
          "FROM view LEFT JOIN drawing ON drawing.view = view.id ORDER BY view.name"};
}

Cell cell_of(const Statement& row, int column, char type) {
  if (row.is_null(column)) return {};
  if (type == 'i') return row.integer(column);
  if (type == 'r') return row.real(column);
  return std::string(row.text(column));
}

Result<Listing> list_rows(Database& database, const ListSource& source, std::uint64_t limit) {
  Listing list;
  for (const ListColumn& column : source.columns) list.columns.emplace_back(column.name);
  Result<Statement> rows =
      database.prepare(fmt::format("SELECT {} {}", source.select, source.from));
  if (!rows) return rows.error();
  for (;;) {
    const Result<bool> more = rows->step();
    if (!more) return more.error();
    if (!*more) return list;
    ++list.all;
    if (limit > 0 && list.all > limit) continue;
    std::vector<Cell>& cells = list.rows.emplace_back();
    for (std::size_t c = 0; c < source.columns.size(); ++c)
      cells.push_back(cell_of(*rows, static_cast<int>(c), source.columns[c].type));
  }
}

/// How often a shape is placed, and by whom first.
struct ShapeUse {
  std::uint32_t shape = 0, first_object = 0;
  std::uint64_t uses = 0;
};

std::int64_t triangles_of(const model::Shape& shape) {
  const auto* const mesh = std::get_if<geometry::TriangleMesh>(&shape);
  return mesh == nullptr ? 0 : static_cast<std::int64_t>(mesh->triangles.size());
}

Listing list_shapes(const model::Model& model, std::uint64_t limit) {
  std::vector<ShapeUse> uses(model.shapes.size());
  for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
    const model::Object& object = model.objects[o];
    for (std::uint32_t b = 0; b < object.body_count; ++b) {
      const std::uint32_t shape = model::index(model.bodies[object.first_body + b].shape);
      if (uses[shape].uses++ == 0) uses[shape] = {shape, o, 1};
    }
  }
  std::erase_if(uses, [](const ShapeUse& use) { return use.uses == 0; });
  // Of equal ones that comes first whose first object does.
  std::ranges::sort(uses, [](const ShapeUse& x, const ShapeUse& y) {
    return std::tuple(y.uses, x.first_object, x.shape) <
           std::tuple(x.uses, y.first_object, y.shape);
  });
  Listing list{{"kind", "bodies", "triangles", "file", "first_object"}, {}, uses.size()};
  if (limit > 0 && uses.size() > limit) uses.resize(limit);
  for (const ShapeUse& use : uses) {
    const model::Object& object = model.objects[use.first_object];
    list.rows.push_back({std::string(model::kind_name(model.shapes[use.shape])),
                         static_cast<std::int64_t>(use.uses), triangles_of(model.shapes[use.shape]),
                         model.files[object.file].label, object.id});
  }
  return list;
}

}  // namespace

Result<Listing> list(Project& project, ListKind kind, std::uint64_t limit,
                     const parallel::Context& context) {
  if (kind != ListKind::shapes) return list_rows(project.database(), source_of(kind), limit);
  const Result<model::Model> model = project.model(context);
  if (!model) return model.error();
  return list_shapes(*model, limit);
}

}  // namespace strake::project
