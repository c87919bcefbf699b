// SPDX-License-Identifier: Apache-2.0
#include "page/page_head.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "report/clash/clash_json_members.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"
#include "strake/core/version.hpp"

namespace strake::page {
namespace {

void member(std::string& out, std::string_view name) {
  out += ",\n";
  report::append_key(out, name);
}

void text_member(std::string& out, std::string_view name, std::string_view text) {
  member(out, name);
  report::append_json(out, text);
}

void text_list(std::string& out, std::string_view name, const std::vector<std::string>& texts) {
  out += ",\n";
  report::append_list(out, name, texts,
                      [&](const std::string& text) { report::append_json(out, text); });
}

void trend(std::string& out, const std::vector<TrendPoint>& points) {
  out += ",\n";
  report::append_list(
      out, "trend", points,
      [&](const TrendPoint& p) {
        out += "{\"run\": " + std::to_string(p.run) + ", \"started\": ";
        report::append_json(out, p.started);
        out += ", \"test\": ";
        report::append_json(out, p.test);
        const std::array<std::pair<std::string_view, std::uint64_t>, 12> counts{
            {{"hit", p.hit},
             {"contact", p.contact},
             {"clearance_violation", p.clearance_violation},
             {"allowed", p.allowed},
             {"appeared", p.appeared},
             {"gone", p.gone},
             {"new", p.statuses[0]},
             {"active", p.statuses[1]},
             {"reviewed", p.statuses[2]},
             {"approved", p.statuses[3]},
             {"resolved", p.statuses[4]},
             {"cannot_tell", p.cannot_tell}}};
        for (const auto& [name, count] : counts) {
          out += ", ";
          report::append_key(out, name);
          out += std::to_string(count);
        }
        out += '}';
      },
      "\n  ");
}

/// Why there is no model, where the contents do not say.
WithoutModel reason_of(const PageContents& contents) {
  if (!contents.without_model.why.empty()) return contents.without_model;
  return {"This page was written without the model.",
          "To have it, write the page again without '--page-geometry none'."};
}

void no_model(std::string& out, const WithoutModel& reason) {
  member(out, "no_model");
  out += "{\"why\": ";
  report::append_json(out, reason.why);
  if (!reason.remedy.empty()) {
    out += ", \"remedy\": ";
    report::append_json(out, reason.remedy);
  }
  out += '}';
}

}  // namespace

Result<std::string> page_head(const PageContents& contents, const HeadFacts& facts,
                              const parallel::Context& context) {
  std::string out = "{\"format\": \"strake-page\", \"version\": 1";
  text_member(out, "title", contents.title);
  text_member(out, "program", "Strake " + std::string(version()));
  member(out, "counts");
  out += "{\"results\": " + std::to_string(facts.results) +
         ", \"groups\": " + std::to_string(facts.groups) +
         ", \"objects\": " + std::to_string(facts.objects) + "}";
  out += ",\n";
  report::append_list(out, "blocks", facts.blocks, [&](const Block& block) {
    out += "{\"id\": \"" + block.id + "\", \"bytes\": " + std::to_string(block.bytes()) + "}";
  });
  if (contents.clash != nullptr) {
    member(out, "clash");
    const Status status = report::write_clash_head(
        *contents.clash, [&](std::string_view text) { out += text; }, context);
    if (!status) return status.error();
  }
  out += ",\n";
  report::append_list(out, "files", contents.model.files,
                      [&](const model::SourceFile& file) { report::append_json(out, file.label); });
  text_list(out, "disciplines", facts.names.disciplines);
  text_list(out, "rules", facts.names.rules);
  text_list(out, "columns",
            contents.clash != nullptr ? contents.clash->columns : std::vector<std::string>());
  if (!contents.trend.empty()) trend(out, contents.trend);
  if (!facts.scene.empty()) {
    member(out, "scene");
    out += facts.scene;
  } else {
    no_model(out, reason_of(contents));
  }
  out += ",\n";
  report::append_list(out, "drawings", contents.drawings, [&](const PageDrawing& drawing) {
    out += "{\"title\": ";
    report::append_json(out, drawing.title);
    out += ", \"objects\": " + std::to_string(drawing.objects) + "}";
  });
  if (contents.served) {
    member(out, "served");
    out += "{\"run\": " + std::to_string(contents.served->run) +
           ", \"event\": " + std::to_string(contents.served->event) + ", \"by\": ";
    report::append_json(out, contents.served->by);
    out += '}';
  }
  out += "\n}\n";
  return out;
}

std::string_view policy_in(std::string_view head) {
  constexpr std::string_view kBefore = "http-equiv=\"Content-Security-Policy\" content=\"";
  const std::size_t at = head.find(kBefore);
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + kBefore.size();
  return head.substr(from, head.find('"', from) - from);
}

std::string with_served_policy(std::string_view head) {
  const std::string_view policy = policy_in(head);
  if (policy.empty()) return std::string(head);
  const auto end = static_cast<std::size_t>(policy.data() + policy.size() - head.data());
  std::string served(head.substr(0, end));
  served += "; connect-src 'self'";
  served += head.substr(end);
  return served;
}

}  // namespace strake::page
