// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/drawing_writers.hpp"
#include "page/results/page_facts.hpp"
#include "sheets/output/sheet_writers.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

/// The page: one HTML file with results, the model round them and drawings, which opens in a
/// browser without a network. docs/formats/page.md has its form; viewer/ has the program in it.
namespace strake::page {

/// A run of a test of a project, for the trend of the page.
struct TrendPoint {
  std::int64_t run = 0;
  std::string started, test;
  std::uint64_t hit = 0, contact = 0, clearance_violation = 0, allowed = 0;
  std::uint64_t appeared = 0, gone = 0;
  /// Clashes of each status, in the order of report::kDecisionStatuses.
  std::array<std::uint64_t, 5> statuses{};
  std::uint64_t cannot_tell = 0;
};

/// A drawing of the page.
struct PageDrawing {
  std::string title;
  std::uint64_t objects = 0;  ///< that are in it
  std::string svg;            ///< as drawing::write_svg() writes it
};

/// Why a page has no model, and what whoever reads it can do about that: whole sentences. Decision
/// 0104 says why a page is written all the same.
struct WithoutModel {
  std::string why, remedy;
};

/// What a page that is served shows of a project, and who decides in it.
struct ServedFacts {
  std::int64_t run = 0, event = 0;  ///< the last ones that it knows of
  std::string by;
};

/// What a page has; what is null or empty it has not.
struct PageContents {
  std::string title;
  const model::Model& model;
  const report::ClashContents* clash = nullptr;  ///< of the same model
  /// Who is to see to a result; null: nobody knows.
  std::function<std::string_view(const PageRow&)> assignee = {};
  const model::Scene* scene = nullptr;  ///< of the same model
  report::ModelShown shown = report::ModelShown::automatic;
  /// Told where the model would be if there is no scene. Empty: that it was not requested.
  WithoutModel without_model = {};
  /// The objects that drawings show: in a page without results these alone are of the model.
  /// Empty: all.
  std::vector<bool> drawn = {};
  std::vector<PageDrawing> drawings = {};
  std::vector<TrendPoint> trend = {};
  /// The facts of a page that 'strake view' serves: it may then ask its server, and nobody else.
  std::optional<ServedFacts> served = {};
};

/// Returns the policy (Content-Security-Policy) that a page is served with.
[[nodiscard]] std::string served_policy();

/// Writes a page. Its bytes depend on the contents alone. Nothing of a model stands in markup: all
/// is base64. Errors: cancelled, out of memory.
[[nodiscard]] Status write_page(const PageContents& contents, report::Sink sink,
                                const parallel::Context& context);

/// Writes the page of clash results, with the model in it if the contents have it.
[[nodiscard]] Status write_clash_page(const report::ClashContents& contents, report::Sink sink,
                                      const parallel::Context& context);

/// Returns a drawing as a page has it.
[[nodiscard]] PageDrawing page_drawing(const drawing::NeutralDrawing& drawing,
                                       const drawing::Ink& ink, const model::Model& model);

/// Writes the page of sheets, with what is drawn of the model if the contents have it.
[[nodiscard]] Status write_sheet_page(const sheets::SheetContents& contents, drawing::Sink sink,
                                      const parallel::Context& context);

/// Writes the page of a drawing, with what is drawn of the model if the contents have it.
[[nodiscard]] Status write_drawing_page(const drawing::DrawingContents& contents,
                                        drawing::Sink sink, const parallel::Context& context);

}  // namespace strake::page
