// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "project/model/blocks.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"

namespace strake::tiles {

using project::Blob;

/// What a view asks of a tile.
struct ViewTask {
  hlr::View view;
  hlr::Options options;  ///< what is by object is so of the tile's
  geometry::Box3l box = geometry::empty_box<std::int64_t>();  ///< as hlr::WholeView has it
  double longest_side = 0;
  std::vector<hlr::Hatch> hatches;
  bool made_for_view = false;  ///< hlr::WholeView::tessellation, by body of the tile's model
  std::vector<bool> finer;
  std::vector<bool> to_solve;  ///< by object
  /// Objects that reports of a view may name, and their names.
  std::vector<std::uint32_t> named;
  std::vector<std::string> names;
};

[[nodiscard]] Result<Blob> encode_task(const ViewTask& task);

/// Decodes what a view asks of a tile with this model. Errors: input, by the name `what`.
[[nodiscard]] Result<ViewTask> decode_task(const Blob& blob, const model::Model& model,
                                           const std::string& what);

}  // namespace strake::tiles
