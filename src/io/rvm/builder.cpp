// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/rvm/facet_group.hpp"
#include "io/source/precision.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::io::rvm {

namespace {

std::string_view as_key(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reports what is missing, and what has no area and therefore is not missing.
void report_facets(DiagnosticLog& log, const FacetMesh& facets, std::uint64_t offset) {
  std::string lost, empty;
  const auto add = [](std::string& text, std::uint32_t count, std::string_view what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(lost, facets.nonfinite, "with a corner that is not a finite number");
  add(lost, facets.untriangulated, "with contours that cross");
  add(empty, facets.degenerate, "polygons without three distinct corners");
  add(empty, facets.short_contours, "holes without three distinct corners");
  if (!lost.empty())
    log.skip("rvm-facet-left-out",
             fmt::format("a facet group is kept without some of its {} polygons: {}",
                         facets.polygons, lost),
             offset);
  if (!empty.empty())
    log.warn("rvm-facet-polygon",
             fmt::format("a facet group of {} polygons has {}", facets.polygons, empty), offset);
}

float largest_parameter(const PrimitiveChunk& chunk) {
  float largest = 0;
  BigEndianCursor in(chunk.parameters);
  for (std::size_t k = 0; k < parameter_count(chunk.kind); ++k)
    largest = std::max(largest, std::fabs(in.f32()));
  return largest;
}

}  // namespace

void RvmBuilder::begin_group(std::string name, std::uint32_t material, std::uint8_t transparency,
                             std::uint64_t offset) {
  const std::uint32_t parent = open_.empty() ? kNoGroup : open_.back();
  if (transparency == 0 && parent != kNoGroup) transparency = groups_[parent].transparency;
  open_.push_back(static_cast<std::uint32_t>(groups_.size()));
  groups_.push_back({parent, material, transparency, offset});
  names_.push_back({std::move(name), static_cast<model::GroupId>(parent)});
}

bool RvmBuilder::end_group() {
  if (open_.empty()) return false;
  open_.pop_back();
  return true;
}

void RvmBuilder::add(const PrimitiveChunk& chunk) {
  // Nothing is built from it but the length of some lines, which then is missing and reported.
  if (!std::ranges::all_of(chunk.box, [](float v) { return std::isfinite(v); }))
    log_->warn("rvm-nonfinite-box",
               fmt::format("{} has a stored box with an entry that is not a finite number",
                           kind_with_article(chunk.kind)),
               chunk.offset);
  BodyRecord& record = bodies_.emplace_back();
  record.group = open_.empty() ? kNoGroup : open_.back();
  record.transparency = chunk.transparency;
  record.offset = chunk.offset;
  record.body.category = chunk.category;
  const auto placement = placement_of(chunk.matrix, frame_);
  if (!placement)
    log_->skip("rvm-nonfinite-matrix",
               fmt::format("{} has a matrix with an entry that is not a finite number",
                           kind_with_article(chunk.kind)),
               chunk.offset);
  const auto shape = placement ? shape_of(chunk) : std::nullopt;
  record.dropped = record.incomplete = !shape;
  if (!shape) return;
  record.body.shape = *shape;
  record.body.placement = *placement;
  record.body.precision_um = io::precision_um(origin_half_spacing_mm(chunk));
}

void RvmBuilder::note_loss(std::uint64_t offset) {
  bool& already_lost = open_.empty() ? lost_outside_ : groups_[open_.back()].lost;
  if (already_lost) return;
  already_lost = true;
  BodyRecord& record = bodies_.emplace_back();
  record.group = open_.empty() ? kNoGroup : open_.back();
  record.offset = offset;
  record.dropped = record.incomplete = true;
}

double RvmBuilder::origin_half_spacing_mm(const PrimitiveChunk& chunk) const {
  float largest = 0;
  for (std::size_t k = 9; k < 12; ++k) largest = std::max(largest, std::fabs(chunk.matrix[k]));
  return float32_half_spacing(static_cast<double>(largest)) * frame_.unit_mm;
}

/// Returns the worse of what its origin says, which it has already, and what its shape's numbers
/// say.
float RvmBuilder::precision_um(const model::Body& body) const {
  const auto largest = static_cast<double>(largest_[model::index(body.shape)]);
  return std::max(body.precision_um, io::precision_um(float32_half_spacing(largest) *
                                                      scale_of(body.placement.linear)));
}

std::optional<model::ShapeId> RvmBuilder::shape_of(const PrimitiveChunk& chunk) {
  if (chunk.kind == kFacetKind) return facet_shape(chunk);
  auto& known = known_[chunk.kind];
  // The length of a line may be in its box, which is no part of the key: lines are not shared.
  if (chunk.kind != kLineKind) {
    const auto found = known.find(as_key(chunk.parameters));
    if (found != known.end()) return found->second;
  }
  const DecodedPrimitive decoded = decode_primitive(chunk);
  if (!decoded.primitive) {
    log_->skip("rvm-bad-primitive",
               fmt::format("{} cannot be used: {}", kind_with_article(chunk.kind), decoded.problem),
               chunk.offset);
    return std::nullopt;
  }
  check_stored_box(chunk, *decoded.primitive);
  const auto id = static_cast<model::ShapeId>(shapes_.size());
  shapes_.emplace_back(*decoded.primitive);
  largest_.push_back(largest_parameter(chunk));
  if (chunk.kind != kLineKind) known.emplace(as_key(chunk.parameters), id);
  return id;
}

void RvmBuilder::check_stored_box(const PrimitiveChunk& chunk,
                                  const geometry::Primitive& primitive) {
  const auto* dish = std::get_if<geometry::SphericalDishPrimitive>(&primitive);
  if (dish == nullptr || dish->height > dish->radius) return;
  const double stored = static_cast<double>(chunk.box[3]);
  if (std::fabs(stored - dish->radius) <= 1e-3 * dish->radius + 1e-3) return;
  log_->warn("rvm-dish-radius",
             fmt::format("a spherical dish has radius {} mm, but its stored box reaches {} mm: "
                         "some exporters write the diameter",
                         dish->radius, stored),
             chunk.offset);
}

model::ShapeId RvmBuilder::facet_shape(const PrimitiveChunk& chunk) {
  const auto id = static_cast<model::ShapeId>(shapes_.size());
  const auto [at, added] = known_[kFacetKind].emplace(as_key(chunk.parameters), id);
  if (added) {
    shapes_.emplace_back(geometry::TriangleMesh{});
    largest_.push_back(0);
    facets_.push_back({model::index(id), chunk.parameters, chunk.offset});
  }
  return at->second;
}

Result<std::vector<RvmBuilder::Facets>> RvmBuilder::triangulate(const parallel::Context& context) {
  std::vector<Facets> facets(shapes_.size(), Facets::complete);
  auto meshes = parallel::transform(
      context, {.name = "triangulate RVM facet groups", .n = facets_.size(), .grain = 8},
      [&](std::size_t i) { return triangulate_facets(facets_[i].payload); });
  if (!meshes) return meshes.error();
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    FacetMesh& built = (*meshes)[i];
    const FacetJob& job = facets_[i];
    report_facets(*log_, built, job.offset);
    if (built.nonfinite + built.untriangulated > 0) facets[job.shape] = Facets::incomplete;
    if (built.mesh.triangles.empty()) facets[job.shape] = Facets::empty;
    largest_[job.shape] = built.largest;
    shapes_[job.shape] = std::move(built.mesh);
  }
  return facets;
}

void RvmBuilder::note_facets(const std::vector<Facets>& facets) {
  for (BodyRecord& record : bodies_) {
    if (record.dropped) continue;
    const Facets there = facets[model::index(record.body.shape)];
    record.incomplete = there != Facets::complete;
    if (there != Facets::empty) continue;
    record.dropped = true;
    log_->skip("rvm-empty-facets", "a facet group holds no usable polygon", record.offset);
  }
}

model::Color RvmBuilder::color_of(const BodyRecord& record) {
  const bool grouped = record.group != kNoGroup;
  const std::uint32_t material = grouped ? groups_[record.group].material : 0;
  auto color = palette_.find(material);
  if (!color) {
    color = default_color(0);
    if (reported_materials_.insert(material).second)
      log_->warn(
          "rvm-material",
          fmt::format("material {} has no colour in the palette; grey stands for it", material),
          grouped ? groups_[record.group].offset : record.offset);
  }
  const unsigned percent = record.transparency > 0
                               ? record.transparency
                               : (grouped ? groups_[record.group].transparency : 0U);
  color->alpha = static_cast<std::uint8_t>((100U - std::min(percent, 100U)) * 255U / 100U);
  return *color;
}

void RvmBuilder::emit_objects(RvmModel& built) {
  // The bodies of a group keep the order of the file, before and after child groups alike; those
  // outside any group come first.
  std::sort(bodies_.begin(), bodies_.end(), [](const BodyRecord& a, const BodyRecord& b) {
    return std::pair(a.group + 1, a.offset) < std::pair(b.group + 1, b.offset);
  });
  built.model.bodies.reserve(bodies_.size());
  for (const BodyRecord& record : bodies_) {
    if (built.group_of.empty() || built.group_of.back() != record.group) {
      model::Object object;
      const bool grouped = record.group != kNoGroup;
      object.name = grouped ? names_[record.group].name : root_name_;
      object.parent = grouped ? names_[record.group].parent : model::GroupId::none;
      object.first_body = static_cast<std::uint32_t>(built.model.bodies.size());
      built.model.objects.push_back(std::move(object));
      built.group_of.push_back(record.group);
    }
    if (record.incomplete) built.model.objects.back().incomplete = true;
    if (record.dropped) continue;
    ++built.model.objects.back().body_count;
    built.model.bodies.push_back(record.body);
    built.model.bodies.back().color = color_of(record);
    built.model.bodies.back().precision_um = precision_um(record.body);
  }
}

Result<RvmModel> RvmBuilder::build(const parallel::Context& context) {
  const auto facets = triangulate(context);
  if (!facets) return facets.error();
  note_facets(*facets);
  RvmModel built;
  emit_objects(built);
  built.model.groups = std::move(names_);
  built.model.shapes = std::move(shapes_);
  built.groups = std::move(groups_);
  return built;
}

}  // namespace strake::io::rvm
