// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pictures/clash_picture.hpp"
#include "pictures/scenery/clash_place.hpp"

namespace strake::pictures {

/// The height of the caption, mm.
inline constexpr double kCaptionMm = 21;

/// Returns one line that says what is found about a subject: "HIT, 12.3 mm deep", and how many
/// results there are besides.
[[nodiscard]] std::string title_of(const report::ClashContents& contents, const Subject& subject);

/// Returns how an object is called: its name or, without one, its id; and of several files which.
[[nodiscard]] std::string name_of(const model::Model& model, model::ObjectId id);

/// Writes what is seen under the view: title, the two in their colours, a scale bar, and what was
/// cut away.
void add_caption(ClashPicture& picture, const model::Model& model, const Roles& roles,
                 bool cut_open);

}  // namespace strake::pictures
