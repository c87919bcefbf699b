// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/bindings/model.hpp"
#include "python/bindings/selection.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

namespace strake::python {

/// What is requested of a clash run.
struct ClashRequest {
  Pick a, b;
  bool within_files = false;
  std::string rules, profile;  ///< a file, a name; empty: none
  std::string clearance;       ///< as the program takes it; empty: none
  std::optional<double> touch_gap_mm, touch_overlap_mm, contact_distance_mm;
  bool thickness_cap = true, volumes = false, curves = false;
  std::string contacts = "list";  ///< "list", "count" or "off"
  std::uint64_t regions = clash::EngineOptions{}.max_regions;
  std::string group_by;  ///< empty: no groups
  std::optional<double> group_distance_mm;
  bool group_contacts = false;
  std::string sort;                  ///< "depth", "volume" or "size"; empty: depth
  std::vector<std::string> classes;  ///< of the results that are kept; empty: all
  std::optional<double> sag_mm, weld_mm;
  bool obstructions = false, insulation = false, list_exempted = false, log_pairs = false;
};

/// How results are written, in the words of the program's options.
struct WrittenForm {
  std::vector<std::string> columns;
  std::string csv, page_geometry, bcf_date, bcf_author;  ///< empty: as by default
  bool bcf_3 = false, bcf_contacts = false;
  std::size_t bcf_most = report::BcfForm{}.max_topics;
};

/// What a clash run found, with what it is written with.
struct ClashRun {
  ModelPointer model;
  clash::Findings findings;
  std::optional<clash::Grouping> grouping;
  std::optional<report::RulesSource> rules;
  report::WrittenClasses classes;
  clash::SortBy sort = clash::SortBy::depth;
  bool logs_pairs = false;
  Diagnostics loading;
  std::shared_ptr<const model::Scene> scene = nullptr;  ///< null where no process has all of it

  [[nodiscard]] report::ClashContents contents() const {
    return {.findings = findings,
            .model = model->model(),
            .grouping = grouping ? &*grouping : nullptr,
            .rules = rules ? &*rules : nullptr,
            .loading = &loading,
            .classes = classes,
            .scene = scene.get()};
  }
};

/// Runs what the program's verb `clash` runs. Errors: usage, input, cancelled, memory.
[[nodiscard]] Result<std::shared_ptr<ClashRun>> find_clashes(const ModelPointer& model,
                                                             const ClashRequest& request,
                                                             const parallel::Context& context);

}  // namespace strake::python
