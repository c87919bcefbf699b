// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

namespace strake::project {

/// A file whose label is another one now.
struct RenamedFile {
  std::string before, after;
};

/// Gives clashes, decisions, stored results and drawings of files the labels of today: keys and
/// identities are made of them. `before` is the model that still has the former labels; labels may
/// be exchanged. To be called within the transaction that writes the files under their new labels,
/// whether they were renamed or only need more folders to be distinguished from their namesakes.
[[nodiscard]] Status rename_files(Database& database, const model::Model& before,
                                  std::span<const RenamedFile> renamed);

}  // namespace strake::project
