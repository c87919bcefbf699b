// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/output/stats.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::cli {

/// Returns "900 objects: 400 drawn, 496 hidden, 4 failed; 2 without some of their geometry", whose
/// fates add up. It names files that end early, too.
[[nodiscard]] std::string object_summary_line(const hlr::Account& account,
                                              const model::Model& model);

/// Returns "1:50", of a view in perspective "1:50 in the plane of the target", where alone it
/// holds.
[[nodiscard]] std::string scale_words(const drawing::NeutralDrawing& drawing);

/// Returns a sentence for each of what was requested to be left whole or out: "3 objects are left
/// whole by the sections", "flush seams of 12 edges are left out".
[[nodiscard]] std::vector<std::string> left_alone_lines(const drawing::NeutralDrawing& drawing);

/// Returns how many lines were left out as they are too near to each other on paper.
[[nodiscard]] std::string thinned_line(const drawing::ThinnedLines& thinned);

/// Adds every fate to --stats, each name behind `prefix`.
void count_objects(Stats& stats, const hlr::Account& account, std::string_view prefix);

/// What a run did about the lines of a stored view.
enum class ViewRun : std::uint8_t {
  made,       ///< the view is new: nothing is remembered of it that holds
  unchanged,  ///< it exists, and nothing that it shows changed
  followed,   ///< it exists, and what changed was solved again
  in_full,    ///< all of it was solved, though something may be remembered
};

/// What that took. Seconds are of the clock on the wall.
struct ViewWork {
  ViewRun run = ViewRun::made;
  std::string why = {};  ///< of a view that is new or solved in full
  hlr::Stage stage = hlr::Stage::global;
  std::uint64_t objects = 0, edges = 0;  ///< all
  std::uint64_t objects_changed = 0;     ///< new, gone or other than in the drawing before
  std::uint64_t objects_solved = 0, edges_solved = 0;
  std::uint64_t shared_bodies = 0, shared_shapes = 0;  ///< as of hlr::Counters
  double read_s = 0;                                   ///< reading what is remembered
  double match_s = 0;                                  ///< finding what changed
  double solve_s = 0;  ///< all of the hidden lines, of which these are steps
  double preparation_s = 0, local_s = 0, global_s = 0;

  /// Return how many objects had their local, and their global results found anew.
  [[nodiscard]] std::uint64_t solved_locally() const {
    return stage == hlr::Stage::none ? 0 : objects_solved;
  }
  [[nodiscard]] std::uint64_t solved_globally() const {
    return stage == hlr::Stage::global ? objects_solved : 0;
  }
};

/// Returns what a run did, as "existing view with changes".
[[nodiscard]] std::string_view words(ViewRun run);

/// Return the lines of a run's end on a stored view: what it did, and what that took.
[[nodiscard]] std::string did_line(const std::string& view, const ViewWork& work);
[[nodiscard]] std::string cost_line(const std::string& view, const ViewWork& work);

/// Counts the work for --stats.
void count_view_work(Stats& stats, const ViewWork& work);

}  // namespace strake::cli
