// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

/// Writes clash reports as text: JSON for programs, CSV for spreadsheets, a table for a terminal.
///
///     AtomicFile file = ...;
///     const Status status = report::write_clash_json(
///         {findings, model}, [&](std::string_view s) { file.write(s); }, context);
///
/// Bytes depend on the findings and the model alone: not on the locale, the team or the run. The
/// team formats results while the calling thread hands them on; errors: cancelled, and then what
/// went to the sink is no document.
namespace strake::report {

class DecidedResults;

/// Takes text piece by piece; pieces end anywhere.
using Sink = parallel::FunctionRef<void(std::string_view)>;

/// The rules file that findings were made with.
struct RulesSource {
  std::string file;          ///< its name, without folders
  Hash128 hash;              ///< the hash of its bytes
  std::string profile = {};  ///< the profile that it is, if it is one that the program brings along
};

/// How CSV is written. By default as RFC 4180 has it. A spreadsheet that is opened by a double
/// click goes by its own language: where the comma is the decimal point, cells end with a
/// semicolon.
struct CsvForm {
  char separator = ',';  ///< between cells: ',', ';' or a tab
  char decimal = '.';  ///< the decimal point: '.' or ','; a comma only where it separates no cells
  bool mark = false;   ///< whether the byte order mark comes first, by which Excel knows UTF-8
};

/// The classes of the results that a report has.
struct WrittenClasses {
  bool hit = true, contact = true, clearance_violation = true;

  [[nodiscard]] bool has(clash::Class cls) const {
    return (cls == clash::Class::hit && hit) || (cls == clash::Class::contact && contact) ||
           (cls == clash::Class::clearance_violation && clearance_violation);
  }
  [[nodiscard]] bool all() const { return hit && contact && clearance_violation; }
};

/// Takes the results of all other classes out of the findings, but for those that may turn out to
/// be of one of them (clash::Pair::severest). What the tests count stays as it is.
void leave_out_others(clash::Findings& findings, const WrittenClasses& classes);

/// How BCF is written: a topic for each group, or for each result where there are no groups.
struct BcfForm {
  bool version_3 = false;        ///< 3.0; otherwise 2.1, which most programs read
  std::size_t max_topics = 200;  ///< topics: the first of the groups, or the worst of the results
  bool contacts = false;  ///< also results that are contacts; groups have those that they have
  /// When topics were made, as 2026-01-31T23:59:59Z; empty: when the newest model file says that it
  /// was written, or where none does 1970-01-01.
  std::string date = {};
  std::string author = "strake";  ///< who made them
};

/// How much of the model a report shows that shows it.
enum class ModelShown : std::uint8_t {
  automatic,  ///< all of it, or where that is too much what is near clashes, and boxes for the rest
  all,
  near,   ///< what clashes and what is near, as far as there is room; boxes for the rest
  boxes,  ///< the box of each object
  nothing,
};

/// What a report is written from.
struct ClashContents {
  const clash::Findings& findings;
  const model::Model& model;
  const clash::Grouping* grouping = nullptr;  ///< the grouping of these findings, if requested
  const RulesSource* rules = nullptr;         ///< the rules, if there were any
  /// What reading and placing the model noticed (model::Model::diagnostics, then
  /// model::Scene::diagnostics). Without it the result does not say what is missing.
  const Diagnostics* loading = nullptr;
  /// Attributes that JSON and CSV have of both objects, in this order: of an object those that it
  /// states, or inherits from the nearest group above that does.
  std::vector<std::string> columns = {};
  CsvForm csv = {};
  /// What leave_out_others() was called with: JSON says so, lest a comparison take what is not
  /// there for mended.
  WrittenClasses classes = {};
  /// The decisions about these findings, if there are any. The table leaves out what they settle.
  const DecidedResults* decided = nullptr;
  /// The model on the grid, as it was tested: for what shows it, as pictures do.
  const model::Scene* scene = nullptr;
  /// Makes the picture of a result as the bytes of a PNG, for formats that have some of the worst
  /// results; empty: they have none. Nothing comes of a result without a picture: an empty text.
  std::function<Result<std::string>(const clash::ResultRef&, const parallel::Context&)> picture_of =
      {};
  BcfForm bcf = {};
  ModelShown shown = ModelShown::automatic;  ///< how much of `scene` is shown
};

/// Writes the document of schemas/clash.schema.json, one result a line, streamed: memory does not
/// grow with the number of results. Lengths are rounded to a nanometre, brackets outward. Bytes of
/// a name that are not UTF-8 become U+FFFD.
[[nodiscard]] Status write_clash_json(const ClashContents& contents, Sink sink,
                                      const parallel::Context& context = {});

/// Writes one header line and one line per pair (RFC 4180 but for what contents.csv says), lines
/// ended by CRLF.
[[nodiscard]] Status write_clash_csv(const ClashContents& contents, Sink sink,
                                     const parallel::Context& context = {});

/// Writes what programs for clash review exchange: the XML that Navisworks writes of its clash
/// tests
/// (`exchange`, schema nw-exchange-12.0), in millimetres, depths as negative distances, with GUIDs
/// that stay from run to run and the groups of the grouping. Results that a rule allows are left
/// out; statuses are those of current_status(). Control characters in names become U+FFFD.
[[nodiscard]] Status write_clash_xml(const ClashContents& contents, Sink sink,
                                     const parallel::Context& context = {});

/// Writes results as ifcclash of IfcOpenShell has them: a list of sets, each with its clashes under
/// "GUID-GUID", in metres. A test becomes a set of its HITs (`intersection`), and where it has such
/// results one of its contacts (`collision`) and one of its clearance violations (`clearance`).
/// Distances are without a sign, as there: that of a HIT is its depth. Results that a rule allows
/// are left out.
[[nodiscard]] Status write_ifcclash_json(const ClashContents& contents, Sink sink,
                                         const parallel::Context& context = {});

/// Writes where pipes touch as CSV of the same form, one row per joint: which two, where, whether
/// end to end, an end on a side or side by side, and their diameters there where exact primitives
/// tell them. Pipes are objects with round ends.
[[nodiscard]] Status write_joints_csv(const ClashContents& contents, Sink sink,
                                      const parallel::Context& context = {});

/// Writes every pair of objects that went to the narrow phase as CSV of the same form: whether a
/// rule may allow it, its class (NO_HIT too) and what it cost. Only tests that were requested to
/// log pairs have such pairs.
[[nodiscard]] Status write_pair_log(const ClashContents& contents, Sink sink,
                                    const parallel::Context& context = {});

struct TableOptions {
  std::size_t width = 100;                    ///< columns of the terminal; names are clipped to fit
  std::size_t rows = 20;                      ///< pairs of each test, or groups, shown at most
  clash::SortBy sort = clash::SortBy::depth;  ///< the order of pairs; size is as depth
};

/// Returns the worst pairs of each test: by class, then as sorted, then in durable order. Every
/// class has its share of the rows, and is followed by how many more of it there are. With a
/// grouping the table has the groups in its order, and what each test counts.
[[nodiscard]] std::string clash_table(const ClashContents& contents, const TableOptions& options);

}  // namespace strake::report
