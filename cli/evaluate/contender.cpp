// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/contender.hpp"

#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "cli/evaluate/record.hpp"
#include "core/checksum.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/report/clash.hpp"

namespace strake::cli {

namespace {

Hasher& add(Hasher& hasher, const geometry::Vec3l& point) {
  return hasher.add(point.x).add(point.y).add(point.z);
}

std::string hash_of(const hlr::Drawing& drawing) {
  Hasher hasher;
  for (const hlr::EdgePiece& piece : drawing.pieces) {
    hasher.add(model::index(piece.object)).add(piece.edge).add(model::index(piece.other));
    hasher.add(static_cast<std::uint32_t>(piece.kind)).add(static_cast<std::uint32_t>(piece.state));
    add(add(hasher, piece.a), piece.b);
  }
  return hasher.value().text();
}

/// Makes a sheet with all of the drawing's lines on it, as SVG.
Result<Published> published(const hlr::Drawing& drawing, const model::Model& model,
                            const parallel::Context& context) {
  const Result<drawing::NeutralDrawing> sheet = drawing::lay_out(drawing, model, {}, context);
  if (!sheet) return sheet.error();
  const Result<drawing::Ink> ink =
      drawing::choose_ink(*sheet, {.hidden = true, .clean_up = false}, context);
  if (!ink) return ink.error();
  Checksum hash;
  const Status written = drawing::write_svg(
      *sheet, *ink, model, [&](std::string_view text) { hash.add(text); }, context);
  if (!written) return written.error();
  return Published{hash.value().text(), SheetPixels(*sheet, *ink)};
}

std::map<std::string, std::uint64_t> counters_of(const hlr::Drawing& drawing) {
  const hlr::Counters& work = drawing.counters;
  return {{"feature edges", work.feature_edges},
          {"covered edges", work.covered_edges},
          {"face tests", work.face_tests},
          {"exact fall-backs", work.exact_fallbacks},
          {"intersection pairs", work.crossing_pairs},
          {"intersection tests", work.crossing_tests},
          {"pieces", drawing.pieces.size()}};
}

std::map<std::string, std::uint64_t> counters_of(const clash::Report& report) {
  const clash::Counters& work = report.counters;
  return {
      {"candidate pairs", work.candidate_pairs}, {"part pairs", work.part_pairs},
      {"triangle pairs", work.triangle_pairs},   {"exact fall-backs", work.exact_fallbacks},
      {"depth cells", work.depth_cells},         {"hits", report.count_hit},
      {"contacts", report.count_contact},        {"clearance violations", report.count_clearance}};
}

/// Makes the result as JSON.
Result<Published> published(const clash::Findings& findings, const model::Model& model,
                            const parallel::Context& context) {
  Checksum hash;
  const Status status = report::write_clash_json(
      {findings, model}, [&](std::string_view text) { hash.add(text); }, context);
  if (!status) return status.error();
  return Published{hash.value().text()};
}

}  // namespace

Contender drawing_contender(std::string name, unsigned threads, const model::Scene& scene,
                            const hlr::View& view, const hlr::Options& options) {
  Contender contender;
  contender.name = std::move(name);
  contender.threads = threads;
  contender.compute = [&scene, view,
                       options](const parallel::Context& context) -> Result<Computed> {
    Result<hlr::Drawing> lines = hlr::draw(scene, {}, view, options, context);
    if (!lines) return lines.error();
    const auto drawing = std::make_shared<const hlr::Drawing>(std::move(*lines));
    return Computed{counters_of(*drawing), [drawing] { return hash_of(*drawing); },
                    [drawing, &scene](const parallel::Context& publishing) {
                      return published(*drawing, *scene.model, publishing);
                    }};
  };
  return contender;
}

Contender clash_contender(std::string name, unsigned threads, const model::Scene& scene,
                          const clash::Options& options) {
  Contender contender;
  contender.name = std::move(name);
  contender.threads = threads;
  contender.compute = [&scene, options](const parallel::Context& context) -> Result<Computed> {
    Result<clash::Report> report = clash::detect(scene, clash::one_set(scene), options, context);
    if (!report) return report.error();
    const auto findings = std::make_shared<clash::Findings>();
    findings->tests.push_back(std::move(*report));
    return Computed{counters_of(findings->tests.front()),
                    [findings] { return findings->tests.front().hash; },
                    [findings, &scene](const parallel::Context& publishing) {
                      return published(*findings, *scene.model, publishing);
                    }};
  };
  return contender;
}

std::vector<Contender> drawing_contenders(const model::Scene& scene, const hlr::View& view,
                                          hlr::Stage stage, const std::vector<unsigned>& threads) {
  hlr::Options options;
  options.stage = stage;
  options.clipped = false;  // as for any drawing that lists no lines
  std::vector<Contender> all;
  all.push_back(drawing_contender(kSequential, 1, scene, view, options));
  all.push_back(drawing_contender(kAgain, 1, scene, view, options));
  for (const unsigned n : threads)
    if (n > 1) all.push_back(drawing_contender(kOurs, n, scene, view, options));
  options.solver = hlr::Solver::push;
  for (const unsigned n : std::set<unsigned>{1, threads.back()}) {
    all.push_back(drawing_contender("thesis: push", n, scene, view, options));
    all.back().limited = true;
  }
  return all;
}

std::vector<Contender> clash_contenders(const model::Scene& scene, const clash::Options& options,
                                        const std::vector<unsigned>& threads) {
  std::vector<Contender> all;
  all.push_back(clash_contender(kSequential, 1, scene, options));
  all.push_back(clash_contender(kAgain, 1, scene, options));
  for (const unsigned n : threads)
    if (n > 1) all.push_back(clash_contender(kOurs, n, scene, options));
  const auto limited = [&](std::string name, const clash::Options& how, MustEqual must_equal) {
    all.push_back(clash_contender(std::move(name), threads.back(), scene, how));
    all.back().limited = true;
    all.back().must_equal = must_equal;
  };
  clash::Options how = options;
  how.engine.broad_phase = clash::BroadPhase::all_pairs;
  limited("thesis: all pairs", how, MustEqual::bytes);
  how.engine.narrow_phase = clash::NarrowPhase::sphere_subdivision;
  limited("thesis: all pairs, spheres", how, MustEqual::nothing);
  how.engine.broad_phase = clash::BroadPhase::tree;
  limited("thesis: spheres", how, MustEqual::nothing);
  return all;
}

}  // namespace strake::cli
