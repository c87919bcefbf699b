// SPDX-License-Identifier: Apache-2.0
#include "report/csv.hpp"

#include "strake/core/text.hpp"

namespace strake::report {
namespace {

bool looks_like_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
}

}  // namespace

void append_csv(std::string& out, std::string_view raw) {
  std::string text = valid_utf8(raw);
  if (looks_like_formula(text)) text.insert(0, 1, '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

void append_csv_identity(std::string& out, const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  for (const std::string* text : {&o.id, &o.name, &model.files[o.file].label}) {
    append_csv(out, *text);
    out += ',';
  }
}

}  // namespace strake::report
