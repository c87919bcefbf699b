// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cli/run/session.hpp"
#include "cli/verbs/draw/draw_request.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"

/// The steps of a run of `draw` that all its forms share.
namespace strake::cli {

/// What a request comes to for one scene.
struct PreparedView {
  std::vector<bool> drawn;
  hlr::Options options;
  drawing::LayoutOptions layout;
};

/// Makes lines of the pipes of a scene where they are requested, and says how many. Errors:
/// cancelled.
[[nodiscard]] Status draw_pipes_as_lines(Session& session, const DrawRequest& request,
                                         model::Scene& scene);

/// Works out which objects are drawn, hatched and left whole, and how fine curves are. Errors: a
/// selection that picks nothing, cancelled.
[[nodiscard]] Result<PreparedView> prepare_view(Session& session, const DrawRequest& request,
                                                const model::Scene& scene);

/// Finds all lines anew. Errors: those of hlr::draw().
[[nodiscard]] Result<hlr::Drawing> solve(Session& session, const DrawRequest& request,
                                         const PreparedView& prepared, const model::Scene& scene);

/// Puts the lines on paper, and prints what they noticed.
[[nodiscard]] Result<drawing::NeutralDrawing> put_on_paper(Session& session,
                                                           const hlr::Drawing& lines,
                                                           const model::Model& model,
                                                           const drawing::LayoutOptions& layout);

/// Counts the work for --stats, and prints what was drawn.
void report_drawing(Session& session, const drawing::NeutralDrawing& drawing,
                    const model::Model& model);

/// Writes a drawing to the files of -o, and to standard output under --json. `scene` is what was
/// drawn; null: it is not known.
[[nodiscard]] Status write_drawing(Session& session, const DrawOptions& given,
                                   const drawing::NeutralDrawing& drawing,
                                   const model::Model& model, const model::Scene* scene);

}  // namespace strake::cli
