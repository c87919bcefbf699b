// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"
#include "tiles/kept/file_reader.hpp"
#include "tiles/split.hpp"

/// A model that is too large to be held, file by file.
namespace strake::tiles {

/// What is held of a model besides names and extents.
struct Keep {
  bool places = false;  ///< Outline::scene
  /// Whether the shape of a body with this box, grid units, keeps its triangles there; empty: none.
  std::function<bool(const geometry::Box3l&)> whole = {};
};

/// What is held of a model of which the geometry is not.
struct Outline {
  /// Finished; with Keep::places it has bodies, and of shapes the primitives.
  model::Model model;
  /// With Keep::places: boxes, corners and true surfaces, but few triangles. Its model is to be set
  /// to `model` when that has found its place.
  model::Scene scene;
  std::vector<model::IncompleteObject> lacking;  ///< Scene::lacking
  Diagnostics loading;          ///< of reading the files and putting them on the grid
  std::vector<Extent> extents;  ///< an entry per object
  /// The model's files, in its order.
  struct File {
    std::uint32_t given = 0;  ///< its number among those that were given
    std::uint32_t first = 0, objects = 0;
    Hash128 names;  ///< hash_of_ids(), where there are several files
  };
  std::vector<File> files;
  bool renamed = false;  ///< whether a file has another label than alone, as it has a namesake
};

/// Takes from the scene of one file what is asked of all objects; the file's label is that which it
/// has alone.
using VisitScene = parallel::FunctionRef<Status(const model::Scene& scene, std::size_t given)>;

/// Reads all files, one at a time, has the reader keep each, and returns their outline: it is the
/// model that io::read_models() and model::make_scene() make of all, without geometry. Errors:
/// theirs; those of `visit_scene`.
[[nodiscard]] Result<Outline> outline_of(FileReader& reader, const model::SceneOptions& options,
                                         const Keep& keep, VisitScene visit_scene,
                                         const parallel::Context& context);

/// Returns the hash of the ids of a model's objects, by which one that changed is known.
[[nodiscard]] Hash128 hash_of_ids(const model::Model& model);

}  // namespace strake::tiles
