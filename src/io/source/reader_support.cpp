// SPDX-License-Identifier: Apache-2.0
#include "io/source/reader_support.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/text_encoding.hpp"
#include "io/source/precision.hpp"

namespace strake::io {

namespace {

/// Returns the folders from the root to a file, a '/' behind each.
std::string folders_of(const std::filesystem::path& path) {
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(path, failed).lexically_normal();
  const std::string folders = whole.parent_path().relative_path().generic_string();
  return failed || folders.empty() ? std::string() : folders + '/';
}

std::string counted(std::uint64_t n, const char* one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

}  // namespace

model::Model start_model(const FileBytes& file, std::string format, const ReadOptions& options,
                         const FrameDefault& fallback) {
  model::SourceFile source;
  source.label = file.path.filename().string();
  source.format = std::move(format);
  source.unit = unit_text(options, fallback);
  source.up_axis = up_axis_text(options.up_axis.value_or(fallback.up));
  source.bytes = file.bytes.size();
  source.folders = folders_of(file.path);
  model::Model model;
  model.files.push_back(std::move(source));
  return model;
}

Result<model::Model> end_model(const FileBytes& file, model::Model&& model,
                               const parallel::Context& context) {
  if (!model.bodies.empty()) {
    if (const Status settled = settle_precision(file, model, context); !settled)
      return settled.error().code == ErrorCode::cancelled ? cancelled(file) : settled.error();
    return std::move(model);
  }
  const auto& kept = model.diagnostics.kept();
  const auto reason = std::find_if(kept.begin(), kept.end(), [](const Diagnostic& d) {
    return d.severity == Severity::skipped;
  });
  if (reason != kept.end())
    return Error{ErrorCode::input, "nothing usable is left of the file: " + reason->message,
                 reason->where, "mend the model and export it again"};
  return Error{ErrorCode::input, "holds no faces and no lines", file.path.string(),
               "export the model with its geometry"};
}

Error cancelled(const FileBytes& file) {
  return {ErrorCode::cancelled, "reading was cancelled", file.path.string(), ""};
}

std::string lower_extension(const std::filesystem::path& path) {
  return lowered(path.extension().string());
}

void note_left_out(model::Model& model, model::Object& object, const LeftOut& lacks) {
  if (!lacks.any()) return;
  object.incomplete = true;
  std::string what;
  if (lacks.faces != 0) what = counted(lacks.faces, "face");
  if (lacks.lines != 0) what += (what.empty() ? "" : " and ") + counted(lacks.lines, "line");
  model.diagnostics.add(
      Severity::skipped, "mesh-face-left-out",
      fmt::format("object '{}' is kept without {}: {}", object.name, what, lacks.why), lacks.where);
}

void add_body(model::Model& model, model::Object& object, model::Shape shape,
              const BodyAttributes& attributes) {
  model::Body body;
  body.shape = static_cast<model::ShapeId>(model.shapes.size());
  body.precision_um = precision_um(attributes.half_spacing_mm);
  body.color = attributes.color;
  model.shapes.push_back(std::move(shape));
  model.bodies.push_back(body);
  ++object.body_count;
}

}  // namespace strake::io
