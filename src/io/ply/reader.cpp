// SPDX-License-Identifier: Apache-2.0
#include "strake/io/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh/mesh_building.hpp"
#include "io/ply/header.hpp"
#include "io/ply/values.hpp"
#include "io/source/input_file.hpp"
#include "io/source/precision.hpp"
#include "io/source/reader_support.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;
using ply::ElementHead;
using ply::NumberType;
using ply::PropertyHead;

constexpr FrameDefault kPlyFrame{1.0, UpAxis::z, false};

/// What a file holds, in its own frame.
struct PlyContent {
  std::vector<Vec3d> points;
  std::vector<bool> bad;  ///< per point, if any is: it is not finite
  DigitStatistics digits;
  NumberType coordinate_type = NumberType::f32;
  std::vector<std::uint32_t> corners;  ///< of all faces
  std::vector<std::size_t> ends;       ///< per face: where its corners end
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::uint64_t bad_faces = 0, bad_edges = 0;
  std::string first_bad;
};

class PlyParser {
 public:
  PlyParser(const FileBytes& file, const ply::Header& header, const parallel::Context& context)
      : file_(file),
        header_(header),
        context_(context),
        values_(as_text(file.bytes).substr(header.size), header.encoding) {}

  Result<PlyContent> parse(model::Model& model);

 private:
  Status element(const ElementHead& head, model::Model& model);
  /// Reads the elements of a kind; `visit` is given the numbers of each: those of plain properties,
  /// and of lists those of `list` only.
  template <class Visit>
  Status each(const ElementHead& head, const PropertyHead* list, Visit&& visit);
  Status vertices(const ElementHead& head);
  Status faces(const ElementHead& head, const PropertyHead& list);
  Status edges(const ElementHead& head);
  bool value(NumberType type, double& out) { return values_.read(type, out, ignored_); }
  [[nodiscard]] bool is_point(double number) const {
    return number >= 0 && number < static_cast<double>(content_.points.size()) &&
           number == std::floor(number) &&
           (content_.bad.empty() || !content_.bad[static_cast<std::size_t>(number)]);
  }
  [[nodiscard]] Error ends_early(const ElementHead& head, std::uint64_t read) const {
    return {ErrorCode::input,
            fmt::format("ends, or holds something that is no number, after {} of the {} elements "
                        "'{}' that it announces",
                        read, head.count, head.name),
            fmt::format("{}, byte {}", file_.path.string(), header_.size + values_.offset()),
            "copy or export the file again"};
  }

  const FileBytes& file_;
  const ply::Header& header_;
  const parallel::Context& context_;
  ply::ValueReader values_;
  DigitStatistics ignored_;
  std::vector<double> row_, listed_;
  PlyContent content_;
};

template <class Visit>
Status PlyParser::each(const ElementHead& head, const PropertyHead* list, Visit&& visit) {
  constexpr std::uint64_t kBetweenStops = 1U << 14U;
  for (std::uint64_t i = 0; i < head.count; ++i) {
    if (i % kBetweenStops == 0 && context_.stop.stop_requested()) return cancelled(file_);
    row_.clear();
    listed_.clear();
    for (const PropertyHead& property : head.properties) {
      double number = 0;
      if (!property.count_type) {
        // How coordinates are written is distinguished from all else.
        const bool coordinate =
            property.name == "x" || property.name == "y" || property.name == "z";
        if (!values_.read(property.type, number, coordinate ? content_.digits : ignored_))
          return ends_early(head, i);
        row_.push_back(number);
        continue;
      }
      double count = 0;
      if (!value(*property.count_type, count)) return ends_early(head, i);
      if (!(count >= 0 && count <= static_cast<double>(values_.left())) ||
          count != std::floor(count))
        return ends_early(head, i);
      for (double k = 0; k < count; ++k) {
        if (!value(property.type, number)) return ends_early(head, i);
        if (&property == list) listed_.push_back(number);
      }
    }
    visit();
  }
  return {};
}

/// Returns the place of a plain property among those.
std::optional<std::size_t> place_of(const ElementHead& head, std::string_view name) {
  std::size_t place = 0;
  for (const PropertyHead& property : head.properties) {
    if (property.count_type) continue;
    if (property.name == name) return place;
    ++place;
  }
  return std::nullopt;
}

Status PlyParser::vertices(const ElementHead& head) {
  if (!content_.points.empty())
    return Error{ErrorCode::input, "has vertices twice", file_.path.string(),
                 "export the model again"};
  const auto x = place_of(head, "x"), y = place_of(head, "y"), z = place_of(head, "z");
  if (!x || !y || !z)
    return Error{ErrorCode::input, "its vertices have no x, y and z", file_.path.string(),
                 "export the model again"};
  for (const PropertyHead& property : head.properties)
    if (property.name == "x") content_.coordinate_type = property.type;
  content_.points.reserve(head.count);
  return each(head, nullptr, [&] {
    const Vec3d point{row_[*x], row_[*y], row_[*z]};
    const bool good = is_coordinate(point.x) && is_coordinate(point.y) && is_coordinate(point.z);
    if (!good) {
      content_.bad.resize(head.count);
      content_.bad[content_.points.size()] = true;
    }
    content_.points.push_back(good ? point : Vec3d{});
  });
}

Status PlyParser::faces(const ElementHead& head, const PropertyHead& list) {
  return each(head, &list, [&] {
    const auto bad = std::ranges::find_if_not(listed_, [&](double n) { return is_point(n); });
    if (listed_.size() < 3 || bad != listed_.end()) {
      if (content_.bad_faces++ == 0)
        content_.first_bad = listed_.size() < 3
                                 ? fmt::format("a face has {} corners", listed_.size())
                                 : fmt::format("vertex {} does not exist or is not finite", *bad);
      return;
    }
    for (const double corner : listed_)
      content_.corners.push_back(static_cast<std::uint32_t>(corner));
    content_.ends.push_back(content_.corners.size());
  });
}

Status PlyParser::edges(const ElementHead& head) {
  const auto from = place_of(head, "vertex1"), to = place_of(head, "vertex2");
  return each(head, nullptr, [&] {
    if (!from || !to) return;
    if (!is_point(row_[*from]) || !is_point(row_[*to])) {
      if (content_.bad_edges++ == 0)
        content_.first_bad = "an edge has a vertex that does not exist";
      return;
    }
    content_.edges.emplace_back(static_cast<std::uint32_t>(row_[*from]),
                                static_cast<std::uint32_t>(row_[*to]));
  });
}

Status PlyParser::element(const ElementHead& head, model::Model& model) {
  const std::uint64_t least = head.min_bytes(header_.encoding);
  // The last number of a text needs nothing behind it.
  if (head.count > 0 && least > 0 && head.count > (values_.left() + 1) / least)
    return ends_early(head, (values_.left() + 1) / least);
  if (head.count > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::input, "has more elements than can be numbered", file_.path.string(),
                 "split the file"};
  if (head.name == "vertex") return vertices(head);
  // Elements without properties have no bytes that would bound their count.
  const bool bodiless = head.properties.empty();
  const auto list = std::ranges::find_if(head.properties, [](const PropertyHead& property) {
    return property.count_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  });
  if (head.name == "face" && list != head.properties.end()) return faces(head, *list);
  if (head.name == "edge" && !bodiless) return edges(head);
  if (head.count > 0 && (list != head.properties.end() || head.name == "face"))
    model.diagnostics.add(Severity::skipped, "ply-element",
                          fmt::format("the elements '{}' are not read; export polygons", head.name),
                          file_.path.string());
  return bodiless ? Status{} : each(head, nullptr, [] {});
}

Result<PlyContent> PlyParser::parse(model::Model& model) {
  for (const ElementHead& head : header_.elements)
    if (const Status read = element(head, model); !read) return read.error();
  return std::move(content_);
}

/// Makes the shapes of the one object of a file.
class PlyObject {
 public:
  PlyObject(const FileBytes& file, PlyContent&& content, const SourceFrame& frame)
      : file_(file), content_(std::move(content)), frame_(frame) {}
  void add_to(model::Model& model);

 private:
  [[nodiscard]] double half_spacing_mm() const;
  geometry::TriangleMesh mesh();
  geometry::Polylines lines() const;

  const FileBytes& file_;
  PlyContent content_;
  SourceFrame frame_;
  std::uint64_t crossing_ = 0;
};

double PlyObject::half_spacing_mm() const {
  const double largest = largest_coordinate(content_.points);
  double half = 0;
  if (content_.coordinate_type == NumberType::f32) half = float32_half_spacing(largest);
  if (content_.coordinate_type < NumberType::f32) half = 0.5;
  // Doubles of a program that keeps its points in single precision have no more than that.
  const bool floats = content_.coordinate_type == NumberType::f64 &&
                      std::ranges::any_of(content_.points, came_through_float32);
  if (floats) half = float32_half_spacing(largest);
  const bool text = content_.digits.max_significant_digits > 0;
  return frame_.unit_mm * (text ? text_half_spacing(content_.digits, largest) : half);
}

geometry::TriangleMesh PlyObject::mesh() {
  geometry::TriangleMesh mesh;
  std::vector<std::uint32_t>& corners = content_.corners;
  for (const std::uint32_t point : renumber_indices(corners))
    mesh.vertices.push_back(frame_.point(content_.points[point]));
  const bool polygons = corners.size() != 3 * content_.ends.size();
  std::size_t begin = 0;
  for (std::size_t face = 0; face < content_.ends.size(); ++face) {
    const std::size_t end = content_.ends[face];
    if (!append_polygon(mesh, std::span(corners).subspan(begin, end - begin))) ++crossing_;
    if (polygons) mesh.faces.resize(mesh.triangles.size(), static_cast<std::uint32_t>(face));
    begin = end;
  }
  return mesh;
}

geometry::Polylines PlyObject::lines() const {
  geometry::Polylines lines;
  for (const auto& [from, to] : content_.edges) {
    lines.points.push_back(frame_.point(content_.points[from]));
    lines.points.push_back(frame_.point(content_.points[to]));
    lines.first.push_back(static_cast<std::uint32_t>(lines.points.size()));
  }
  return lines;
}

void PlyObject::add_to(model::Model& model) {
  model::Object object;
  object.id = object.name = file_.path.stem().string();
  const BodyAttributes attributes{.half_spacing_mm = half_spacing_mm()};
  geometry::TriangleMesh faces = mesh();
  if (!faces.triangles.empty()) add_body(model, object, std::move(faces), attributes);
  if (!content_.edges.empty()) add_body(model, object, lines(), attributes);
  note_left_out(model, object,
                {content_.bad_faces, content_.bad_edges, content_.first_bad, file_.path.string()});
  if (crossing_ > 0)
    model.diagnostics.add(Severity::warning, "ply-crossing-face",
                          fmt::format("{} polygons cross themselves or enclose nothing; they are "
                                      "cut as fans",
                                      crossing_),
                          file_.path.string());
  if (object.body_count > 0) model.objects.push_back(std::move(object));
}

class PlyReader final : public Reader {
 public:
  [[nodiscard]] std::string_view format() const override { return "PLY"; }

  [[nodiscard]] int recognise(const FileBytes& file) const override {
    if (ply::is_ply(as_text(file.bytes))) return 100;
    return lower_extension(file.path) == ".ply" ? 10 : 0;
  }

  [[nodiscard]] Result<model::Model> read(const FileBytes& file, const ReadOptions& options,
                                          const parallel::Context& context) const override {
    if (!ply::is_ply(as_text(file.bytes)))
      return Error{ErrorCode::input, "is no PLY: its first line is not 'ply'", file.path.string(),
                   "export the model again"};
    const Result<ply::Header> header = ply::parse_header(as_text(file.bytes));
    if (!header) {
      Error error = header.error();
      error.where = fmt::format("{}:{}", file.path.string(), error.where);
      return error;
    }
    const bool text = header->encoding == ply::Encoding::text;
    model::Model model = start_model(file, text ? "PLY text" : "PLY binary", options, kPlyFrame);
    Result<PlyContent> content = PlyParser(file, *header, context).parse(model);
    if (!content) return content.error();
    PlyObject(file, std::move(*content), choose_frame(options, kPlyFrame)).add_to(model);
    return end_model(file, std::move(model), context);
  }
};

}  // namespace

std::unique_ptr<Reader> make_ply_reader() { return std::make_unique<PlyReader>(); }

}  // namespace strake::io
