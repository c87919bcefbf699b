// SPDX-License-Identifier: Apache-2.0
// Tables on a sheet: lists of parts, revisions.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

struct NoteTable {
  std::string title;  ///< above the headings; empty: none
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
  std::size_t left_out = 0;  ///< rows that it would have with more room

  /// Leaves out the last rows that make it higher than this.
  void fit(double height_mm);
};

/// The paper that a table takes, with its upper left corner at the origin.
[[nodiscard]] PaperBox extent_of(const NoteTable& table);

/// Appends a table: a frame, lines between rows and columns, columns as wide as their longest text,
/// but no wider than 90 mm, where texts become smaller.
void draw_table(const NoteTable& table, const PaperPoint& upper_left, Marks& marks);

/// A list of objects: the table, and which objects each of its rows stands for, in the order of the
/// model.
struct PartsList {
  NoteTable table;
  std::vector<std::vector<model::ObjectId>> objects;
};

/// Returns the list of the objects that are picked: a row for each set of texts with its number, in
/// the order of the texts, numbered from 1.
[[nodiscard]] PartsList parts_list(const PartsListSpec& spec, const std::vector<bool>& picked,
                                   const model::Model& model);

/// Returns the table of revisions, the newest on top.
[[nodiscard]] NoteTable revision_table(const std::vector<RevisionSpec>& revisions);

}  // namespace strake::sheets
