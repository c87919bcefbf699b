// SPDX-License-Identifier: Apache-2.0
#include "strake/report/view_drawing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "drawing/layout/view_title.hpp"
#include "drawing/neutral/neutral_rows.hpp"
#include "hlr/results/defect_codes.hpp"
#include "report/document/document_reader.hpp"
#include "report/view/view_details.hpp"
#include "report/view/view_settings_reader.hpp"

namespace strake::report {

namespace {

constexpr DocumentKind kDrawing{"strake draw -o", "draw the model again"};

/// The model that a document speaks of: the objects with lines first, in their order.
class DocumentModel {
 public:
  explicit DocumentModel(model::Model& model) : model_(model) {}

  /// Files that end early are named first, in the order of the document.
  void add_cut_file(const std::string& label) { model_.files[file(label)].ends_early = true; }

  model::ObjectId add(const ViewObject& object) {
    const std::uint32_t number = file(object.file);
    const auto [at, is_new] = objects_.try_emplace(
        std::pair(number, object.id), static_cast<std::uint32_t>(model_.objects.size()));
    if (is_new) {
      model::Object made;
      made.id = object.id;
      made.name = object.name;
      made.file = number;
      model_.objects.push_back(std::move(made));
    }
    return model::ObjectId{at->second};
  }

 private:
  std::uint32_t file(const std::string& label) {
    const auto [at, is_new] =
        files_.try_emplace(label, static_cast<std::uint32_t>(model_.files.size()));
    if (is_new) {
      model::SourceFile made;
      made.label = label;
      model_.files.push_back(std::move(made));
    }
    return at->second;
  }

  model::Model& model_;
  std::map<std::string, std::uint32_t> files_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> objects_;
};

std::uint64_t digits_of(std::string_view hex) {
  std::uint64_t value = 0;
  for (const char c : hex) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) throw wrong_type("the document", "hash", "hash");
    value = value << 4U | digit;
  }
  return value;
}

Hash128 hash_of_text(const std::string& text) {
  if (text.size() != 32) throw wrong_type("the document", "hash", "hash");
  return {digits_of(std::string_view(text).substr(0, 16)),
          digits_of(std::string_view(text).substr(16))};
}

/// What a document of these counts says of the objects and of the work.
void read_counts(const ViewDetails& details, drawing::NeutralDrawing& drawing) {
  const auto of = [&](const std::string& name) {
    const auto found = details.counts.find(name);
    return found == details.counts.end() ? 0 : found->second;
  };
  hlr::Account& account = drawing.account;
  for (std::size_t f = 1; f < hlr::kFates; ++f) {
    const std::string_view name = drawing::fate_name(static_cast<hlr::Fate>(f));
    account.count.at(f) = of("objects_" + std::string(name));
  }
  account.in_part = of("objects_in_part");
  drawing.counters.feature_edges = of("feature_edges");
  drawing.counters.left_out = of("edges_left_out");
  drawing.counters.specks = of("specks");
  drawing.counters.uncut_objects = of("objects_uncut");
  drawing.counters.seams = of("edges_with_seams");
  for (std::size_t s = 0; s < drawing::kLineStates; ++s)
    drawing.count.at(s) = of(std::string(drawing::state_name(static_cast<drawing::LineState>(s))));
  drawing.count.at(static_cast<std::size_t>(drawing::LineState::clipped)) += of("clipped_left_out");
}

/// Writers spend work and memory by the size of the sheet and of what lies on it: no run wrote a
/// sheet of such a shape, or lines that are drawn and lie beside it.
void check_sheet(const drawing::NeutralDrawing& drawing) {
  constexpr double kMaxSlender = 1e5;
  const double width = drawing.sheet.width_mm, height = drawing.sheet.height_mm;
  const double larger = std::max(width, height);
  if (larger > drawing::kFarthestPaperMm || larger > kMaxSlender * std::min(width, height))
    throw contradiction("sheet", "is of a size that no drawing has");
  const auto lies_near = [&](const drawing::PaperPoint& p) {
    return p.x >= -larger && p.y >= -larger && p.x <= 2 * larger && p.y <= 2 * larger;
  };
  for (std::size_t l = 0; l < drawing.lines.size(); ++l) {
    const drawing::Line& line = drawing.lines[l];
    if (line.state != drawing::LineState::clipped &&
        !(lies_near(line.a_paper) && lies_near(line.b_paper)))
      throw contradiction("line " + std::to_string(l), "lies off the sheet");
  }
}

ViewDrawing assemble(ViewDocument&& document, ViewDetails&& details) {
  ViewDrawing made;
  drawing::NeutralDrawing& drawing = made.drawing;
  read_view_settings(document.settings, drawing);
  drawing.title = details.title.empty() ? drawing::title_of(drawing.view_name, drawing.view)
                                        : std::move(details.title);
  if (details.scale_text.empty()) throw missing_key("sheet", "scale_text");
  drawing.sheet = {document.width_mm, document.height_mm, document.scale,
                   std::move(details.scale_text)};
  drawing.frame = details.frame;
  drawing.hash = hash_of_text(document.hash);
  drawing.lines = std::move(details.lines);
  drawing.curves = std::move(details.curves);
  check_sheet(drawing);
  read_counts(details, drawing);

  DocumentModel model(made.model);
  for (const std::string& label : details.cut_files) model.add_cut_file(label);
  for (const ViewObject& object : document.objects) static_cast<void>(model.add(object));
  for (const ViewObject& object : document.far_objects)
    drawing.far_left_out.push_back(model.add(object));
  std::vector<std::pair<model::ObjectId, hlr::Fate>> fates;
  for (const ViewDefect& defect : details.defects) {
    const model::ObjectId object = model.add(defect.object);
    const auto fate = enum_by_name<hlr::Fate>(defect.fate, drawing::fate_name);
    if (!fate) throw wrong_type("defects", "fate", "fate that this version knows");
    fates.emplace_back(object, *fate);
    for (const std::string& why : defect.why) {
      const std::string_view code = hlr::defect_code(why);
      if (code.empty()) throw wrong_type("defects", "why", "list of reasons that are known");
      drawing.account.defects.push_back({object, code});
    }
  }
  drawing.account.fates.resize(made.model.objects.size(), hlr::Fate::drawn);
  for (const auto& [object, fate] : fates) drawing.account.fates[model::index(object)] = fate;
  return made;
}

}  // namespace

bool is_view_document(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::ifstream in(file, std::ios::binary);
  std::array<char, 4096> buffer{};
  in.read(buffer.data(), buffer.size());
  std::string_view begin(buffer.data(), static_cast<std::size_t>(in.gcount()));
  if (begin.starts_with(drawing::kViewMagic)) return true;
  begin.remove_prefix(std::min(begin.find_first_not_of(" \t\r\n"), begin.size()));
  const auto has = [&](std::string_view key) { return begin.find(key) != std::string_view::npos; };
  return begin.starts_with('{') && has("\"schema_version\"") && has("\"projection\"");
}

Result<ViewDrawing> parse_view_drawing(std::istream& in, const std::string& name) {
  ViewDetails details;
  Result<ViewDocument> document = parse_view_document(in, name, details);
  if (!document) return document.error();
  ViewDrawing made;
  const Status status = read_guarded(
      name, kDrawing, [&] { made = assemble(std::move(*document), std::move(details)); });
  if (!status) return status.error();
  return made;
}

Result<ViewDrawing> read_view_drawing(const std::filesystem::path& file) {
  Result<std::ifstream> in = open_document(file);
  if (!in) return in.error();
  return parse_view_drawing(*in, file.string());
}

}  // namespace strake::report
