// SPDX-License-Identifier: Apache-2.0
#include "strake/publish/publish.hpp"

#include <string_view>
#include <utility>

#include "publish/clash_formats.hpp"
#include "publish/drawing_formats.hpp"
#include "strake/core/atomic_file.hpp"

namespace strake::publish {

Status write_clashes(const report::ClashContents& contents, const std::filesystem::path& file,
                     const parallel::Context& context) {
  const Result<report::ClashWriter> writer = find_clash_writer(file.string());
  if (!writer) return writer.error();
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  const auto sink = [&](std::string_view text) { out->write(text); };
  if (const Status status = writer->write(contents, sink, context); !status) return status;
  return out->commit();
}

Result<Diagnostics> write_drawing(const drawing::NeutralDrawing& drawing, const drawing::Ink& ink,
                                  const model::Model& model, const model::Scene* scene,
                                  const std::filesystem::path& file,
                                  const parallel::Context& context) {
  const Result<drawing::DrawingWriter> writer = find_drawing_writer(file.string());
  if (!writer) return writer.error();
  Result<AtomicFile> out = AtomicFile::create(file);
  if (!out) return out.error();
  const auto sink = [&](std::string_view text) { out->write(text); };
  Result<Diagnostics> written = writer->write({drawing, ink, model, scene}, sink, context);
  if (!written) return written;
  if (const Status status = out->commit(); !status) return status.error();
  return written;
}

}  // namespace strake::publish
