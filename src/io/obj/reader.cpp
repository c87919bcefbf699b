// SPDX-License-Identifier: Apache-2.0
#include "strake/io/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/text_encoding.hpp"
#include "io/mesh/transparent_shells.hpp"
#include "io/obj/chunk.hpp"
#include "io/obj/material.hpp"
#include "io/obj/object_builder.hpp"
#include "io/source/input_file.hpp"
#include "io/source/reader_support.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;

/// Large enough that the work per chunk dwarfs its bookkeeping, small enough for any team. Between
/// 256 KiB and 4 MiB no difference can be seen (decision 0073).
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr FrameDefault kObjFrame{1.0, UpAxis::z, false};

struct FaultText {
  const char* code;
  const char* message;
};

FaultText fault_text(obj::LineFault fault) {
  switch (fault) {
    case obj::LineFault::bad_vertex:
      return {"obj-bad-vertex",
              "a vertex needs three finite numbers; faces and lines that use it are left out"};
    case obj::LineFault::bad_face:
      return {"obj-bad-face", "a face corner is no vertex index; the face is left out"};
    case obj::LineFault::short_face:
      return {"obj-short-face", "a face with fewer than three corners has no area and is left out"};
    case obj::LineFault::bad_polyline:
      return {"obj-bad-line", "a line point is no vertex index; the line is left out"};
    case obj::LineFault::short_polyline:
      return {"obj-short-line", "a line with fewer than two points is left out"};
    case obj::LineFault::curve_or_surface:
      return {"obj-free-form", "a free-form curve or surface is not read: export polygons"};
  }
  return {"obj-fault", "the line is not understood"};
}

class ObjReading {
 public:
  ObjReading(const FileBytes& file, const ReadOptions& options, const parallel::Context& context)
      : file_(file),
        context_(context),
        frame_(choose_frame(options, kObjFrame)),
        model_(start_model(file, "OBJ", options, kObjFrame)) {}

  Result<model::Model> read();

 private:
  Status parse();
  void report_problems();
  void note_cut_off();
  Status gather_vertices();
  [[nodiscard]] std::vector<model::Color> material_colors();
  Status build(std::vector<obj::BuiltObject>& built, std::span<const model::Color> colors);
  void add(const obj::ObjElement& entry, obj::BuiltObject&& built);
  model::GroupId group(const obj::ObjElement& entry);

  const FileBytes& file_;
  const parallel::Context& context_;
  SourceFrame frame_;
  std::vector<obj::ObjChunk> chunks_;
  obj::ObjAssembly assembly_;
  std::vector<Vec3d> vertices_;
  std::vector<DigitStatistics> digits_;  ///< per vertex
  model::Model model_;
  std::uint32_t last_object_ = 0;  ///< ordinal of the `o` that the last group was made for
};

Status ObjReading::parse() {
  const std::vector<std::string_view> pieces =
      obj::cut_chunks(without_byte_order_mark(as_text(file_.bytes)), kChunkBytes);
  for (const std::string_view piece : pieces)
    if (piece.size() > std::numeric_limits<std::uint32_t>::max())
      return Error{ErrorCode::input, "has a line of more than 4 GiB", file_.path.string(),
                   "export the model again"};
  chunks_.resize(pieces.size());
  const Status parsed =
      parallel::for_each(context_, {.name = "parse OBJ", .n = pieces.size()},
                         [&](std::size_t i) { chunks_[i] = obj::parse_chunk(pieces[i]); });
  if (!parsed) return parsed;
  assembly_ = obj::assemble(chunks_);
  if (assembly_.vertex_base.back() > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::input, "has more than 4 294 967 295 vertices", file_.path.string(),
                 "split the file"};
  return {};
}

void ObjReading::report_problems() {
  for (std::size_t i = 0; i < chunks_.size(); ++i)
    for (const obj::Problem& problem : chunks_[i].problems) {
      const FaultText text = fault_text(problem.fault);
      const bool skipped = problem.fault == obj::LineFault::curve_or_surface;
      model_.diagnostics.add(
          skipped ? Severity::skipped : Severity::warning, text.code, text.message,
          fmt::format("{}:{}", file_.path.string(), assembly_.line_base[i] + problem.line + 1));
    }
}

/// Notes a file that is cut off: an OBJ does not say where it ends, but a line that stops in the
/// middle does.
void ObjReading::note_cut_off() {
  if (chunks_.empty() || !chunks_.back().cut_off) return;
  model_.files.front().ends_early = true;
  model_.diagnostics.add(
      Severity::skipped, "obj-truncated",
      "the file ends within a line; what came before it is kept, the rest is unknown",
      fmt::format("{}:{}", file_.path.string(), assembly_.line_base.back()));
}

Status ObjReading::gather_vertices() {
  vertices_.resize(assembly_.vertex_base.back());
  digits_.resize(vertices_.size());
  return parallel::for_each(
      context_, {.name = "place OBJ vertices", .n = chunks_.size()}, [&](std::size_t i) {
        const auto first = static_cast<std::ptrdiff_t>(assembly_.vertex_base[i]);
        auto out = vertices_.begin() + first;
        for (const Vec3d& vertex : chunks_[i].vertices) *out++ = frame_.point(vertex);
        std::ranges::copy(chunks_[i].digits, digits_.begin() + first);
        chunks_[i].vertices = {};
        chunks_[i].digits = {};
      });
}

std::vector<model::Color> ObjReading::material_colors() {
  obj::Materials materials;
  for (const std::string& names : assembly_.libraries)
    obj::load_materials(names, file_.path, materials, model_.diagnostics);
  std::vector<model::Color> colors;
  for (const std::string& name : assembly_.material_names) {
    const auto found = materials.find(name);
    colors.push_back(found == materials.end() ? model::Color{} : found->second);
  }
  return colors;
}

Status ObjReading::build(std::vector<obj::BuiltObject>& built,
                         std::span<const model::Color> colors) {
  const obj::BuildInput input{chunks_, &assembly_, vertices_, digits_, colors};
  built.resize(assembly_.entries.size());
  return parallel::for_each(
      context_, {.name = "build OBJ objects", .n = built.size(), .grain = 4},
      [&](std::size_t i) { built[i] = obj::build_object(input, assembly_.entries[i]); });
}

model::GroupId ObjReading::group(const obj::ObjElement& entry) {
  if (entry.object == 0 || entry.object_name.empty() || entry.group_name.empty())
    return model::GroupId::none;
  if (last_object_ != entry.object) {
    last_object_ = entry.object;
    model_.groups.push_back({entry.object_name, model::GroupId::none});
  }
  return static_cast<model::GroupId>(model_.groups.size() - 1);
}

void ObjReading::add(const obj::ObjElement& entry, obj::BuiltObject&& built) {
  model::Object object;
  object.name = !entry.group_name.empty()    ? entry.group_name
                : !entry.object_name.empty() ? entry.object_name
                                             : file_.path.stem().string();
  object.parent = group(entry);
  object.id =
      object.parent == model::GroupId::none ? object.name : entry.object_name + "/" + object.name;
  object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
  object.incomplete = entry.incomplete;
  if (built.damage && built.empty()) {
    model_.diagnostics.add(Severity::skipped, "obj-damaged-object",
                           fmt::format("object '{}' is skipped: its face or line {}", object.name,
                                       built.damage->message),
                           fmt::format("{}:{}", file_.path.string(), built.damage->line));
    object.incomplete = true;
    model_.objects.push_back(std::move(object));
    return;
  }
  if (built.damage)
    note_left_out(model_, object,
                  {built.bad_faces, built.bad_lines, "one " + built.damage->message,
                   fmt::format("{}:{}", file_.path.string(), built.damage->line)});
  if (built.crossing_faces != 0)
    model_.diagnostics.add(
        Severity::warning, "obj-crossing-face",
        fmt::format(
            "{} faces of object '{}' cross themselves or have no area; they are cut as fans",
            built.crossing_faces, object.name),
        file_.path.string());
  if (built.part_transparent)
    note_merged_shell(model_, fmt::format("{}: {}", file_.path.string(), object.name));
  const double half_spacing_mm =
      frame_.unit_mm * text_half_spacing(built.digits, built.largest_mm / frame_.unit_mm);
  if (!built.opaque.triangles.empty())
    add_body(model_, object, std::move(built.opaque), {built.opaque_color, half_spacing_mm});
  if (!built.transparent.triangles.empty())
    add_body(model_, object, std::move(built.transparent),
             {built.transparent_color, half_spacing_mm});
  if (!built.lines.points.empty())
    add_body(model_, object, std::move(built.lines), {built.line_color, half_spacing_mm});
  model_.objects.push_back(std::move(object));
}

Result<model::Model> ObjReading::read() {
  if (const Status parsed = parse(); !parsed) return parsed.error();
  report_problems();
  note_cut_off();
  if (const Status gathered = gather_vertices(); !gathered) return gathered.error();
  const std::vector<model::Color> colors = material_colors();
  std::vector<obj::BuiltObject> built;
  if (const Status done = build(built, colors); !done) return done.error();
  for (std::size_t i = 0; i < built.size(); ++i) add(assembly_.entries[i], std::move(built[i]));
  return end_model(file_, std::move(model_), context_);
}

/// Returns the share of a text's lines that OBJ could hold, estimated from its start.
int obj_likeness(std::string_view text) {
  constexpr std::array<std::string_view, 12> kWords{"v", "vt", "vn",     "f",      "l",  "o",
                                                    "g", "s",  "usemtl", "mtllib", "vp", "p"};
  int known = 0, other = 0;
  bool geometry = false;
  text = text.substr(0, 4096);
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, length), kBlanks);
    text.remove_prefix(std::min(length + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::string_view word = line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
    const bool match = std::find(kWords.begin(), kWords.end(), word) != kWords.end();
    geometry = geometry || (match && (word == "v" || word == "f"));
    ++(match ? known : other);
  }
  if (known == 0) return 0;
  const int share = 90 * known / (known + other);
  return geometry ? share : share / 2;
}

class ObjReader final : public Reader {
 public:
  [[nodiscard]] std::string_view format() const override { return "OBJ"; }

  [[nodiscard]] std::vector<std::filesystem::path> companions(
      const FileBytes& file, const parallel::Context& /*context*/) const override {
    return obj::named_libraries(as_text(file.bytes), file.path);
  }

  [[nodiscard]] int recognise(const FileBytes& file) const override {
    const std::string_view text = without_byte_order_mark(as_text(file.bytes));
    if (text.substr(0, 4096).find('\0') != std::string_view::npos) return 0;
    const int likeness = obj_likeness(text);
    return lower_extension(file.path) == ".obj" ? std::max(likeness + 5, 30) : likeness;
  }

  [[nodiscard]] Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                          const parallel::Context& context) const override {
    return ObjReading(file, options, context).read();
  }
};

}  // namespace

std::unique_ptr<Reader> make_obj_reader() { return std::make_unique<ObjReader>(); }

}  // namespace strake::io
