// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "project/database/database.hpp"
#include "project/snapshot/snapshot.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

/// Drawings in rows of the database: one of the table `drawing`, and one of `drawing_part` for the
/// lines of each few objects and for what they were solved from, so that a drawing in which little
/// changed is stored by writing little. Decision 0117 says why.
namespace strake::project {

/// Hashes of what is in a part before it is compressed.
struct DrawingPartHashes {
  Hash128 lines, made_from;
  friend bool operator==(const DrawingPartHashes&, const DrawingPartHashes&) = default;
};

/// What is stored of a drawing in parts. Versions of the tables before 5 had none.
struct DrawingParts {
  Hash128 seal;  ///< over what the drawing was solved from; another one is another drawing
  std::vector<DrawingPartHashes> hashes;
};

/// A drawing and what it was solved from.
struct StoredDrawing {
  hlr::Drawing drawing;
  Snapshot made_from;
  std::vector<geometry::Box3l> boxes;  ///< hlr::Signatures::boxes then
  DrawingParts parts = {};
};

/// Which drawing of a view is requested: one that was solved under the signature `whole`, and by
/// this version of the program; what is not given may be any.
struct WantedDrawing {
  std::optional<Hash128> whole = {};
  std::optional<std::string_view> program = {};
};

/// Returns the drawing that is stored of a view; nothing where there is none, or another than is
/// wanted. `of_view` names the view for errors. Errors: input where it is damaged, cancelled.
[[nodiscard]] Result<std::optional<StoredDrawing>> read_drawing_rows(
    Database& database, std::int64_t view, const WantedDrawing& wanted, const std::string& of_view,
    const parallel::Context& context);

/// A drawing to be stored, and what is known of the one that it follows.
struct DrawingToStore {
  const hlr::Drawing& drawing;
  const Snapshot& made_from;
  const std::vector<geometry::Box3l>& boxes;
  /// What is stored of the view as read_drawing_rows() had it, but for the lines, which may have
  /// been taken; null: not known.
  const StoredDrawing* stored = nullptr;
  /// The objects, by number, whose lines may be others than those stored; null or empty: any.
  const std::vector<bool>* touched = nullptr;
};

/// A part as bytes; without any where it is stored.
struct EncodedDrawingPart {
  DrawingPartHashes hashes;
  std::vector<std::byte> lines, made_from;
};

/// A drawing as the bytes of its rows.
struct EncodedDrawing {
  std::vector<std::byte> lines, made_from;
  std::vector<EncodedDrawingPart> parts;
};

/// Returns what is to be written of a drawing. Errors: internal where it and what it was solved
/// from are not of the same objects; cancelled, out of memory.
[[nodiscard]] Result<EncodedDrawing> encode_drawing(const DrawingToStore& drawing,
                                                    const parallel::Context& context);

/// Whether the rows of a view are still those that `stored` was read from.
[[nodiscard]] Result<bool> is_still_stored(Database& database, std::int64_t view,
                                           const StoredDrawing& stored);

/// Writes the parts of a drawing that have bytes, and takes out those that it no longer has.
[[nodiscard]] Status write_drawing_parts(Database& database, std::int64_t view,
                                         std::span<const EncodedDrawingPart> parts);

/// Gives the objects of all drawings the identities of today, within a transaction of the caller.
/// What is damaged stays as it is: it serves nobody.
[[nodiscard]] Status rename_objects_of_drawings(Database& database, const NewIdentities& renamed);

}  // namespace strake::project
