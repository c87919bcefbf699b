// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include <Standard_Version.hxx>
#include <algorithm>

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake::import_step {
namespace {

void member(std::string& out, std::string_view name, std::string_view value) {
  out += out.empty() ? "{" : ", ";
  append_json_string(out, name);
  out += ": ";
  append_json_string(out, value);
}

}  // namespace

Report::Report(const std::filesystem::path& file) : file_(file, std::ios::binary) {}

void Report::line(const std::string& text) { file_ << text << '\n' << std::flush; }

void Report::progress(double done) {
  constexpr double kStep = 0.005;
  done = std::clamp(done, 0.0, 1.0);
  if (done < shown_ + kStep) return;
  shown_ = done;
  line("{\"progress\": " + fixed(done, 3) + "}");
}

void Report::add(Severity severity, std::string_view code, std::string_view object,
                 std::string_view message) {
  std::string text;
  member(text, "severity", severity_name(severity));
  member(text, "code", code);
  if (!object.empty()) member(text, "object", object);
  member(text, "message", message);
  line(text + "}");
}

void Report::fail(const Error& error) {
  std::string text;
  member(text, "error", error.message);
  member(text, "mend", error.mend);
  line(text + "}");
}

void Report::end(std::string_view format, std::string_view unit,
                 std::span<const std::string> depends_on) {
  std::string text;
  member(text, "made_by", "Open CASCADE " OCC_VERSION_STRING_EXT);
  member(text, "format", format);
  member(text, "unit", unit);
  text += ", \"depends_on\": [";
  for (const std::string& file : depends_on) {
    if (text.back() != '[') text += ", ";
    append_json_string(text, file);
  }
  line(text + "]}");
}

}  // namespace strake::import_step
