// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/clash/contents.hpp"
#include "report/text/formatting.hpp"
#include "report/text/ordered_lines.hpp"
#include "report/text/uuid.hpp"
#include "strake/drawing/write.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

using clash::Pair;
using clash::Report;
using drawing::xml_escaped;
using StatusCounts = std::array<std::uint64_t, kDecisionStatuses.size()>;

/// What a line of a test's results is about.
struct ReviewLine {
  enum class Kind : std::uint8_t { result, group_begin, group_end } kind = Kind::result;
  std::uint32_t number = 0;  ///< of the result in its test, or of the group
};

/// The results of a test in the order in which they are written, with what they count.
struct ReviewTest {
  std::vector<ReviewLine> lines;
  StatusCounts counts{};
};

void xml_element(std::string& out, std::string_view name, std::string_view text) {
  out.append("<").append(name).append(">").append(xml_escaped(text));
  out.append("</").append(name).append(">");
}

/// Appends an element with what people wrote, which may have several lines.
void xml_lines(std::string& out, std::string_view name, std::string_view text) {
  out.append("<").append(name).append(">");
  for (;;) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    out.append(xml_escaped(line));
    if (end == std::string_view::npos) break;
    out += '\n';
    text.remove_prefix(end + 1);
  }
  out.append("</").append(name).append(">");
}

void xml_attribute(std::string& out, std::string_view name, std::string_view value) {
  out.append(" ").append(name).append("=\"").append(xml_escaped(value)).append("\"");
}

void number_attribute(std::string& out, std::string_view name, double mm) {
  out.append(" ").append(name).append("=\"");
  append_mm(out, mm);
  out += '"';
}

/// Returns the name of a status with a capital, as people read it.
std::string titled(DecisionStatus status) {
  std::string text(name(status));
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string_view review_description(clash::Class cls) {
  if (cls == clash::Class::hit) return "Hard";
  return cls == clash::Class::contact ? "Contact" : "Clearance";
}

void clash_point(std::string& out, const geometry::Vec3d& mm) {
  out += "<clashpoint><pos3f";
  for (int k = 0; k < 3; ++k)
    number_attribute(out, std::string_view("xyz").substr(static_cast<std::size_t>(k), 1), mm[k]);
  out += "/></clashpoint>";
}

std::string_view without_zero(std::string_view number) {
  return number.starts_with('0') ? number.substr(1) : number;
}

/// Appends a day, which decisions have as 2026-01-31, in an element of another name.
void xml_date(std::string& out, std::string_view name, std::string_view day) {
  if (day.size() != 10) return;
  out.append("<").append(name).append("><date");
  xml_attribute(out, "year", day.substr(0, 4));
  xml_attribute(out, "month", without_zero(day.substr(5, 2)));
  xml_attribute(out, "day", without_zero(day.substr(8, 2)));
  out.append(" hour=\"0\" minute=\"0\" second=\"0\"/></").append(name).append(">");
}

void review_decision(std::string& out, const DecidedResult* decided) {
  if (decided == nullptr) return;
  const Decision& decision = *decided->decision;
  if (current_status(decided) == DecisionStatus::approved) {
    if (!decision.by.empty()) xml_element(out, "approvedby", decision.by);
    xml_date(out, "approveddate", decision.date);
  }
  std::string comment = decision.comment;
  if (decided->reopened != Reopened::no) {
    comment.append(comment.empty() ? "" : "\n");
    // A project states what holds in place of what was decided.
    if (decision.status >= DecisionStatus::approved)
      comment.append(name(decision.status)).append(", and back: ");
    comment.append(name(decided->reopened));
  }
  if (comment.empty()) return;
  out += "<comments><comment id=\"1\">";
  xml_element(out, "user", decision.by);
  xml_lines(out, "body", comment);
  xml_date(out, "createddate", decision.date);
  out += "</comment></comments>";
}

void smart_tag(std::string& out, std::string_view name, std::string_view value) {
  out += "<smarttag>";
  xml_element(out, "name", name);
  xml_element(out, "value", value);
  out += "</smarttag>";
}

void clash_object(std::string& out, const ClashContents& contents, model::ObjectId id) {
  const model::Object& object = contents.model.object(id);
  const std::vector<std::string_view> groups = contents.model.group_names(object);
  const std::string& file = contents.model.files[object.file].label;
  out += "<clashobject><objectattribute><name>Element ID</name>";
  xml_element(out, "value", object.id);
  out += "</objectattribute>";
  xml_element(out, "layer", groups.empty() ? std::string_view() : groups.front());
  out += "<pathlink><node>File</node>";
  xml_element(out, "node", file);
  for (const std::string_view group : groups) xml_element(out, "node", group);
  xml_element(out, "node", object.name);
  out += "</pathlink><smarttags>";
  smart_tag(out, "Item Name", object.name);
  smart_tag(out, "Item Source File", file);
  for (const std::string& column : contents.columns)
    if (const auto value = stated_text(contents.model, id, column)) smart_tag(out, column, *value);
  out += "</smarttags></clashobject>";
}

/// Appends what results and groups begin with: name, GUID, status and distance.
void begin_element(std::string& out, std::string_view tag, std::string_view name,
                   const std::string& guid, DecisionStatus status, double d_mm) {
  out.append("\n<").append(tag);
  xml_attribute(out, "name", name);
  xml_attribute(out, "guid", guid);
  xml_attribute(out, "status", report::name(status));
  number_attribute(out, "distance", d_mm);
  out += '>';
}

void clash_result(std::string& out, const ClashContents& contents, std::size_t t, std::uint32_t p) {
  const Report& test = contents.findings.tests[t];
  const Pair& pair = test.pairs[p];
  const DecidedResult* const decided = decision_about(contents, t, pair);
  const DecisionStatus status = current_status(decided);
  begin_element(
      out, "clashresult", "Clash" + std::to_string(p + 1),
      uuid_from_key(kClashNamespace, clash::pair_key(test.name, contents.model, pair.a, pair.b)),
      status, pair.d_mm);
  xml_element(out, "description", review_description(pair.cls));
  xml_element(out, "resultstatus", titled(status));
  clash_point(out, pair.point_mm);
  review_decision(out, decided);
  out += "<clashobjects>";
  clash_object(out, contents, pair.a);
  clash_object(out, contents, pair.b);
  out += "</clashobjects></clashresult>";
}

/// Returns the status of a group: that of the results that are least far.
DecisionStatus group_status(const ClashContents& contents, std::size_t t,
                            const clash::Group& group) {
  DecisionStatus least = DecisionStatus::resolved;
  for (const clash::ResultRef& r : group.results)
    if (r.test == t) least = std::min(least, current_status(decision_about(contents, r)));
  return least;
}

void group_begin(std::string& out, const ClashContents& contents, std::size_t t,
                 std::uint32_t number) {
  const clash::Group& group = contents.grouping->groups[number];
  const DecisionStatus status = group_status(contents, t, group);
  // A group may have results in several tests; of each it is another element.
  const std::string key = "group " + group.id + " " + contents.findings.tests[t].name;
  begin_element(out, "clashgroup", group.name, uuid_from_key(kClashNamespace, key), status,
                group.d_mm);
  xml_element(out, "description", review_description(group.worst));
  xml_element(out, "resultstatus", titled(status));
  clash_point(out, (group.box_mm.lo + group.box_mm.hi) * 0.5);
  out += "<clashresults>";
}

/// Returns what is written of a test: its groups with their results, then what is in none.
ReviewTest review_test(const ClashContents& contents, std::size_t t) {
  ReviewTest review;
  const std::vector<Pair>& pairs = contents.findings.tests[t].pairs;
  std::vector<bool> written(pairs.size(), false);
  const auto add = [&](std::uint32_t p) {
    written[p] = true;
    review.lines.push_back({ReviewLine::Kind::result, p});
    ++review
          .counts[static_cast<std::size_t>(current_status(decision_about(contents, t, pairs[p])))];
  };
  const std::size_t groups = contents.grouping == nullptr ? 0 : contents.grouping->groups.size();
  for (std::uint32_t g = 0; g < groups; ++g) {
    const std::size_t first = review.lines.size();
    for (const clash::ResultRef& r : contents.grouping->groups[g].results)
      if (r.test == t && pairs[r.pair].allowed < 0) add(r.pair);
    if (review.lines.size() == first) continue;
    review.lines.insert(review.lines.begin() + static_cast<std::ptrdiff_t>(first),
                        {ReviewLine::Kind::group_begin, g});
    review.lines.push_back({ReviewLine::Kind::group_end, g});
  }
  for (std::uint32_t p = 0; p < pairs.size(); ++p)
    if (!written[p] && pairs[p].allowed < 0) add(p);
  return review;
}

void clash_selection(std::string& out, std::string_view side, const std::string& set, bool itself) {
  out.append("<").append(side).append("><clashselection");
  xml_attribute(out, "selfintersect", itself ? "1" : "0");
  out += " primtypes=\"1\">";
  xml_element(out, "locator", set);
  out.append("</clashselection></").append(side).append(">");
}

void begin_test(std::string& out, const Report& test, const StatusCounts& counts) {
  const clash::Tolerances& tolerances = test.options.tolerances;
  const bool clearance = tolerances.clearance_mm > 0;
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts) total += count;
  out += "\n<clashtest";
  xml_attribute(out, "name", test.name.empty() ? "Strake" : test.name);
  xml_attribute(out, "test_type", clearance ? "clearance" : "hard");
  out += " status=\"ok\"";
  number_attribute(out, "tolerance",
                   clearance ? tolerances.clearance_mm : tolerances.touch_overlap_mm);
  out += " merge_composites=\"0\"><linkage mode=\"none\"/>";
  const bool itself = test.in_a == test.in_b;
  clash_selection(out, "left", test.set_a, itself);
  clash_selection(out, "right", test.set_b, itself);
  out += "<rules/><summary";
  xml_attribute(out, "total", std::to_string(total));
  for (std::size_t s = 0; s < counts.size(); ++s)
    xml_attribute(out, name(kDecisionStatuses[s]), std::to_string(counts[s]));
  out += "><testtype>";
  out += clearance ? "Clearance" : "Hard";
  out += "</testtype><teststatus>OK</teststatus></summary><clashresults>";
}

void review_line(std::string& out, const ClashContents& contents, std::size_t t,
                 const ReviewLine& what) {
  if (what.kind == ReviewLine::Kind::result)
    clash_result(out, contents, t, what.number);
  else if (what.kind == ReviewLine::Kind::group_begin)
    group_begin(out, contents, t, what.number);
  else
    out += "\n</clashresults></clashgroup>";
}

}  // namespace

Status write_clash_xml(const ClashContents& contents, Sink sink, const parallel::Context& context) {
  BufferedWriter buffer(sink);
  buffer << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<exchange xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
            "xsi:noNamespaceSchemaLocation=\"http://download.autodesk.com/us/navisworks/schemas/"
            "nw-exchange-12.0.xsd\" units=\"mm\" filename=\"\" filepath=\"\">\n"
            "<batchtest name=\"Strake\" internal_name=\"Strake\" units=\"mm\">\n<clashtests>";
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t) {
    const ReviewTest review = review_test(contents, t);
    begin_test(buffer.text(), contents.findings.tests[t], review.counts);
    const Status status = write_lines(
        context, review.lines.size(), buffer,
        [&](std::size_t i, std::string& out) { review_line(out, contents, t, review.lines[i]); });
    if (!status) return status;
    buffer << "\n</clashresults></clashtest>";
  }
  buffer << "\n</clashtests>\n<selectionsets/>\n</batchtest>\n</exchange>\n";
  return {};
}

}  // namespace strake::report
