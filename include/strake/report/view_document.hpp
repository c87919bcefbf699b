// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

/// Reads drawings of one view back from their neutral form.
namespace strake::report {

struct ViewObject {
  std::string id, name, file;
};

/// A straight piece of an edge, as drawing::Line.
struct ViewPiece {
  geometry::Vec3l a, b;                       ///< ends in the model, µm
  std::array<float, 2> a_paper{}, b_paper{};  ///< mm, good to a part in ten million
  std::uint32_t object = 0,
                other = 0;  ///< indices into ViewDocument::objects; other: for an intersection
  hlr::EdgeKind kind = hlr::EdgeKind::sharp;
  drawing::LineState state = drawing::LineState::visible;
};

/// What a comparison needs of a document of schemas/view.schema.json.
struct ViewDocument {
  std::string name;  ///< the name of the file, as given
  std::string hash;
  /// What lines depend on, as text by name: "view.direction", "settings.stage" …
  std::map<std::string, std::string> settings;
  double width_mm = 0, height_mm = 0, scale = 1;
  std::vector<ViewObject> objects;
  std::vector<ViewObject> far_objects;  ///< left out because they lie far from all others
  std::vector<ViewPiece> pieces;        ///< as in the document
};

/// Reads a document. Errors: input for a file that cannot be read, is cut off, is no such document,
/// is of another version of the schema, or contradicts itself (has not as many pieces of each state
/// as it counts, lists an object twice); each names the line or the piece.
[[nodiscard]] Result<ViewDocument> read_view_document(const std::filesystem::path& file);

/// Reads a document from a stream, in one pass; `name` is what errors call it.
[[nodiscard]] Result<ViewDocument> parse_view_document(std::istream& in, const std::string& name);

}  // namespace strake::report
