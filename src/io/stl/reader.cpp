// SPDX-License-Identifier: Apache-2.0
#include "strake/io/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "io/source/input_file.hpp"
#include "io/source/precision.hpp"
#include "io/source/reader_support.hpp"
#include "io/stl/ascii.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie");

constexpr FrameDefault kStlFrame{1.0, UpAxis::z, false};
constexpr std::uint64_t kHeaderBytes = 84, kFacetBytes = 50;

std::uint64_t stated_facets(std::span<const std::byte> bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

enum class StlKind { none, binary, binary_longer, binary_truncated, ascii };

/// Returns the kind of a file; binary files are known by their size, because many begin with
/// "solid" like the text variant.
StlKind kind_of(std::span<const std::byte> bytes) {
  const bool text = stl::is_like_ascii(without_byte_order_mark(as_text(bytes)));
  if (bytes.size() < kHeaderBytes) return text ? StlKind::ascii : StlKind::none;
  const std::uint64_t facets = stated_facets(bytes);
  const std::uint64_t expected = kHeaderBytes + kFacetBytes * facets;
  if (bytes.size() == expected) return StlKind::binary;
  if (text) return StlKind::ascii;
  return bytes.size() > expected ? StlKind::binary_longer : StlKind::binary_truncated;
}

/// Returns an object without bodies.
model::Object new_object(const model::Model& model, std::string name) {
  model::Object object;
  object.id = name;
  object.name = std::move(name);
  object.first_body = static_cast<std::uint32_t>(model.bodies.size());
  return object;
}

void add_object(model::Model& model, std::string name, geometry::TriangleMesh mesh,
                double half_spacing_mm, const LeftOut& lacks) {
  model::Object object = new_object(model, std::move(name));
  note_left_out(model, object, lacks);
  add_body(model, object, std::move(mesh), {.half_spacing_mm = half_spacing_mm});
  model.objects.push_back(std::move(object));
}

/// Returns the three corners of facet i, as float32 in the file's frame.
std::array<std::array<float, 3>, 3> facet_corners(std::span<const std::byte> bytes,
                                                  std::uint64_t facet) {
  std::array<std::array<float, 3>, 3> corners{};
  constexpr std::size_t kNormalBytes = 12;
  std::memcpy(&corners, bytes.data() + kHeaderBytes + kFacetBytes * facet + kNormalBytes,
              sizeof corners);
  return corners;
}

/// Removes the facets of which a corner is not finite.
LeftOut leave_out_bad_facets(const FileBytes& file, geometry::TriangleMesh& mesh) {
  LeftOut lacks;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    const std::span corners = std::span(mesh.vertices).subspan(i, 3);
    const auto bad =
        std::ranges::find_if_not(corners, [](const Vec3d& p) { return geometry::is_finite(p); });
    if (bad == corners.end()) {
      if (kept != i) std::ranges::copy(corners, mesh.vertices.data() + kept);
      kept += 3;
      continue;
    }
    const auto k = static_cast<std::size_t>(bad - corners.begin());
    if (++lacks.faces != 1) continue;
    lacks.why = fmt::format("corner {} of facet {} is not finite", k + 1, i / 3 + 1);
    lacks.where = fmt::format("{}, byte {}", file.path.string(),
                              kHeaderBytes + kFacetBytes * (i / 3) + 12 + 12 * k);
  }
  mesh.vertices.resize(kept);
  mesh.triangles.resize(kept / 3);
  return lacks;
}

Result<model::Model> read_binary(const FileBytes& file, const ReadOptions& options,
                                 const parallel::Context& context) {
  model::Model model = start_model(file, "STL binary", options, kStlFrame);
  const SourceFrame frame = choose_frame(options, kStlFrame);
  const std::uint64_t facets = stated_facets(file.bytes);
  constexpr std::uint64_t kMaxFacets = 0xffffffffU / 3;
  if (facets > kMaxFacets)
    return Error{ErrorCode::input, "has more than 1 431 655 765 facets", file.path.string(),
                 "split the file"};
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(3 * facets);
  mesh.triangles.resize(facets);
  const Status read = parallel::for_each(
      context, {.name = "read STL", .n = facets, .grain = 1U << 14U}, [&](std::size_t i) {
        const auto corners = facet_corners(file.bytes, i);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto [x, y, z] = corners[k];
          mesh.vertices[3 * i + k] = frame.point({x, y, z});
        }
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles[i] = {first, first + 1, first + 2};
      });
  if (!read) return read.error();
  const LeftOut lacks = leave_out_bad_facets(file, mesh);
  if (mesh.triangles.empty() && lacks.any())
    return Error{ErrorCode::input, lacks.why, lacks.where, "mend the model and export it again"};
  const double largest = largest_coordinate(mesh.vertices) / frame.unit_mm;
  if (facets != 0)
    add_object(model, file.path.stem().string(), std::move(mesh),
               frame.unit_mm * float32_half_spacing(largest), lacks);
  return end_model(file, std::move(model), context);
}

/// Reports a solid that does not end; returns true when it is not known what else it held.
bool note_cut_off(const FileBytes& file, const stl::Solid& solid, const std::string& name,
                  model::Model& model) {
  if (!solid.cut_off) return false;
  model.diagnostics.add(
      Severity::skipped, "stl-truncated",
      fmt::format("solid '{}' ends without 'endsolid'; what came before it is kept, the rest "
                  "of it is unknown",
                  name),
      fmt::format("{}:{}", file.path.string(), *solid.cut_off));
  return true;
}

Result<model::Model> read_ascii(const FileBytes& file, const ReadOptions& options,
                                const parallel::Context& context) {
  model::Model model = start_model(file, "STL text", options, kStlFrame);
  const SourceFrame frame = choose_frame(options, kStlFrame);
  const std::optional<std::vector<stl::Solid>> solids =
      stl::parse_ascii(without_byte_order_mark(as_text(file.bytes)), context.stop);
  if (!solids) return Error{ErrorCode::cancelled, "reading was cancelled", file.path.string(), ""};
  for (const stl::Solid& solid : *solids) {
    std::string name = solid.name.empty() ? file.path.stem().string() : solid.name;
    if (solid.damage && solid.corners.empty()) {
      model.diagnostics.add(Severity::skipped, "stl-damaged-solid",
                            fmt::format("solid '{}' is skipped: {}", name, solid.damage->message),
                            fmt::format("{}:{}", file.path.string(), solid.damage->line));
      note_cut_off(file, solid, name, model);
      model.objects.push_back(new_object(model, std::move(name)));
      model.objects.back().incomplete = true;
      continue;
    }
    const bool cut_off = note_cut_off(file, solid, name, model);
    if (solid.corners.empty()) continue;
    LeftOut lacks;
    if (solid.damage)
      lacks = {solid.bad_facets, 0, solid.damage->message,
               fmt::format("{}:{}", file.path.string(), solid.damage->line)};
    geometry::TriangleMesh mesh;
    mesh.vertices.reserve(solid.corners.size());
    for (const Vec3d& corner : solid.corners) mesh.vertices.push_back(frame.point(corner));
    for (std::uint32_t i = 0; i + 2 < solid.corners.size(); i += 3)
      mesh.triangles.push_back({i, i + 1, i + 2});
    add_object(model, std::move(name), std::move(mesh),
               frame.unit_mm * text_half_spacing(solid.digits, largest_coordinate(solid.corners)),
               lacks);
    if (cut_off) model.objects.back().incomplete = true;
  }
  if (!solids->empty() && solids->back().cut_off) model.files.front().ends_early = true;
  return end_model(file, std::move(model), context);
}

Error truncated(const FileBytes& file) {
  const std::uint64_t facets = stated_facets(file.bytes);
  return {ErrorCode::input,
          fmt::format("ends after {} of the {} facets that it announces at byte 80, or is no STL",
                      (file.bytes.size() - kHeaderBytes) / kFacetBytes, facets),
          fmt::format("{}, byte {}", file.path.string(), file.bytes.size()),
          "copy or export the file again"};
}

/// Reports trailing bytes that could be facets, as of a second solid behind the first, as missing.
void note_trailing_bytes(const FileBytes& file, model::Model& model) {
  const std::uint64_t end = kHeaderBytes + kFacetBytes * stated_facets(file.bytes);
  const bool facets = file.bytes.size() - end >= kFacetBytes;
  model.diagnostics.add(facets ? Severity::skipped : Severity::warning, "stl-trailing-bytes",
                        fmt::format("{} bytes behind the last of the {} facets that the file "
                                    "announces are not read",
                                    file.bytes.size() - end, stated_facets(file.bytes)),
                        fmt::format("{}, byte {}", file.path.string(), end));
  if (facets) model.objects.back().incomplete = true;
}

class StlReader final : public Reader {
 public:
  [[nodiscard]] std::string_view format() const override { return "STL"; }

  [[nodiscard]] int recognise(const FileBytes& file) const override {
    const bool named = lower_extension(file.path) == ".stl";
    switch (kind_of(file.bytes)) {
      case StlKind::binary:
        return named ? 100 : 70;
      case StlKind::ascii:
        return named ? 95 : 90;
      case StlKind::binary_longer:
      case StlKind::binary_truncated:
        return named ? 40 : 0;
      case StlKind::none:
        return named ? 10 : 0;
    }
    return 0;
  }

  [[nodiscard]] Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                          const parallel::Context& context) const override {
    switch (kind_of(file.bytes)) {
      case StlKind::ascii:
        return read_ascii(file, options, context);
      case StlKind::binary_truncated:
        return truncated(file);
      case StlKind::none:
        return Error{ErrorCode::input, "is shorter than the 84 bytes that every binary STL has",
                     file.path.string(), "copy or export the file again"};
      case StlKind::binary:
      case StlKind::binary_longer:
        break;
    }
    Result<model::Model> model = read_binary(file, options, context);
    if (model && kind_of(file.bytes) == StlKind::binary_longer) note_trailing_bytes(file, *model);
    return model;
  }
};

}  // namespace

std::unique_ptr<Reader> make_stl_reader() { return std::make_unique<StlReader>(); }

}  // namespace strake::io
