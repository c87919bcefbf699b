// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "project/codec/blob.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

/// The objects that a result was computed from, by their names: so that it can be known although
/// the model is another one by now.
namespace strake::project {

/// Returns the names of the objects and of the files of a model as the values of a row: whether
/// they are those that are stored shows before they are compressed.
[[nodiscard]] BlobWriter names_of(const model::Model& model);

/// Returns them as bytes of a row. Errors: memory.
[[nodiscard]] Result<std::vector<std::byte>> encode_names(const model::Model& model);

/// Returns a model that has files with labels and objects with ids, names and whether these ids are
/// positions, and nothing else. Errors: input for bytes that are no names; `what` is what errors
/// call them.
[[nodiscard]] Result<model::Model> decode_names(std::span<const std::byte> bytes,
                                                const std::string& what);

}  // namespace strake::project
