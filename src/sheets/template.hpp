// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sheets/placeholders.hpp"
#include "strake/core/result.hpp"

namespace strake::sheets {

/// Frame and title block as a user draws them: the elements of an SVG, written anew, with the
/// fields that texts name as {{field}}.
///
/// What is not drawing has no place in it and is an error: scripts, handlers of events, what is
/// fetched from elsewhere, HTML, animation. Metadata and elements of other namespaces, as editors
/// leave them, are passed over.
struct Template {
  double width_mm = 0, height_mm = 0;
  std::string view_box;       ///< four numbers
  std::vector<Piece> pieces;  ///< XML text, and fields in between

  /// Each once, in the order of the template.
  [[nodiscard]] std::vector<std::string> fields() const;
};

/// Errors: input, with "line 7" as their place.
[[nodiscard]] Result<Template> parse_template(std::string_view svg);

}  // namespace strake::sheets
