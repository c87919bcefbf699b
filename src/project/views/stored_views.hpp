// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "project/database/database.hpp"
#include "project/snapshot/snapshot.hpp"
#include "project/views/drawing_rows.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// Views of a project: what was requested, and the drawing that was last solved for it.
namespace strake::project {

/// How a drawing came to be.
struct DrawnView {
  std::string program;  ///< version of the program
  std::string drawn;    ///< when, UTC, as 2026-01-31T08:00:00Z
  std::uint64_t objects = 0, pieces = 0;
  std::uint64_t edges = 0, edges_solved = 0;  ///< all, and those that were found anew
  double seconds = 0;                         ///< that hidden lines took
};

struct StoredView {
  std::string name;
  std::string settings;          ///< as written, a JSON object
  std::string created, changed;  ///< UTC
  std::optional<DrawnView> last;
};

/// Returns the views by name.
[[nodiscard]] Result<std::vector<StoredView>> list_views(Database& database);

/// Returns one view. Errors: usage where there is none of that name; it lists those that are there.
[[nodiscard]] Result<StoredView> find_view(Database& database, std::string_view name);

/// Returns the drawing of a view that was solved under the signature `whole` by this version of the
/// program; nothing where there is none. Errors: input where it is damaged, cancelled.
[[nodiscard]] Result<std::optional<StoredDrawing>> load_drawing(Database& database,
                                                                std::string_view name,
                                                                const Hash128& whole,
                                                                const parallel::Context& context);

/// A drawing as it was stored last, whatever its view is now.
struct FormerDrawing {
  hlr::Drawing drawing;
  model::Model model;                        ///< its objects and files, as decode_names() has them
  std::vector<model::ObjectId> far_objects;  ///< left out because they lie far from all others
};

/// Returns the drawing of a view that is stored. Errors: usage where there is none of that name or
/// none was stored by a version of the program that keeps the names of its objects; input where it
/// is damaged; cancelled.
[[nodiscard]] Result<FormerDrawing> former_drawing(Database& database, std::string_view name,
                                                   const parallel::Context& context);

/// What is to be remembered of a run.
struct ViewToStore {
  std::string_view name;
  std::optional<std::string_view> settings;  ///< none: as they are
  const hlr::Drawing* drawing = nullptr;  ///< null: as it is; otherwise all that follows is there
  const Snapshot* made_from = nullptr;
  const std::vector<geometry::Box3l>* boxes = nullptr;
  const model::Model* model = nullptr;
  std::span<const model::ObjectId> far_objects = {};
  std::uint64_t edges_solved = 0;
  double seconds = 0;
  /// DrawingToStore::stored and DrawingToStore::touched: only what may be another is looked at
  /// then.
  const StoredDrawing* stored = nullptr;
  const std::vector<bool>* touched = nullptr;
};

/// Stores a view, its drawing or both, wholly or not at all. Errors: those of Transaction::begin().
[[nodiscard]] Status store_view(Database& database, const ViewToStore& view,
                                const parallel::Context& context);

/// A drawing that cannot be right.
struct DamagedView {
  std::string view;  ///< its name
  Error error;
};

/// Reads every drawing, and holds it to what its row says of its size. Returns those that are
/// damaged, by name. Errors: input where the table itself cannot be read, cancelled, memory.
[[nodiscard]] Result<std::vector<DamagedView>> check_views(Database& database,
                                                           const parallel::Context& context);

}  // namespace strake::project
