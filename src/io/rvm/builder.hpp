// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/seeded_hash.hpp"
#include "io/rvm/diagnostic_log.hpp"
#include "io/rvm/palette.hpp"
#include "io/rvm/primitive_chunk.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::io::rvm {

inline constexpr std::uint32_t kNoGroup = 0xffffffffU;

/// A CNTB chunk: a group of the hierarchy as the file has it.
struct GroupRecord {
  std::uint32_t parent = kNoGroup;
  std::uint32_t material = 0;
  std::uint8_t transparency = 0;  ///< percent, own or inherited
  std::uint64_t offset = 0;
  bool lost = false;  ///< something that it holds could not be read, and a message says so
};

/// A model under construction, with what only this format's later steps need.
struct RvmModel {
  model::Model model;  ///< model.groups[i] is group i of the file
  std::vector<GroupRecord> groups;
  std::vector<std::uint32_t> group_of;  ///< one per object; kNoGroup: primitives outside any group
};

/// Collects groups and primitives in file order and makes a model of them.
class RvmBuilder {
 public:
  RvmBuilder(DiagnosticLog& log, SourceFrame frame)
      : log_(&log), frame_(frame), known_(kind_count()) {}

  void begin_group(std::string name, std::uint32_t material, std::uint8_t transparency,
                   std::uint64_t offset);
  /// Ends the innermost group; returns false when no group is open.
  [[nodiscard]] bool end_group();
  void add(const PrimitiveChunk& chunk);
  /// Records that something of the group that is open, or outside any group, cannot be read: an
  /// object of that group is in the model even if nothing else is left of it.
  void note_loss(std::uint64_t offset);
  void redefine_color(std::uint32_t index, model::Color color) { palette_.redefine(index, color); }
  void set_root_name(std::string name) { root_name_ = std::move(name); }

  [[nodiscard]] std::size_t depth() const { return open_.size(); }

  /// Triangulates the facet groups and orders bodies by group. Ids are not yet given.
  [[nodiscard]] Result<RvmModel> build(const parallel::Context& context);

 private:
  struct BodyRecord {
    std::uint32_t group = kNoGroup;
    std::uint8_t transparency = 0;
    model::Body body;
    std::uint64_t offset = 0;
    bool dropped = false;  ///< unusable: its object stays, so that it can be listed, without a body
    bool incomplete = false;  ///< dropped, or lacks some of its polygons
  };
  struct FacetJob {
    std::uint32_t shape = 0;
    Bytes payload;
    std::uint64_t offset = 0;
  };

  [[nodiscard]] std::optional<model::ShapeId> shape_of(const PrimitiveChunk& chunk);
  [[nodiscard]] model::ShapeId facet_shape(const PrimitiveChunk& chunk);
  enum class Facets : std::uint8_t { complete, incomplete, empty };
  /// Returns how much of each shape there is.
  [[nodiscard]] Result<std::vector<Facets>> triangulate(const parallel::Context& context);
  void note_facets(const std::vector<Facets>& facets);
  void check_stored_box(const PrimitiveChunk& chunk, const geometry::Primitive& primitive);
  void emit_objects(RvmModel& built);
  [[nodiscard]] model::Color color_of(const BodyRecord& record);
  [[nodiscard]] double origin_half_spacing_mm(const PrimitiveChunk& chunk) const;
  [[nodiscard]] float precision_um(const model::Body& body) const;

  DiagnosticLog* log_;
  SourceFrame frame_;
  Palette palette_;
  std::string root_name_;
  std::vector<GroupRecord> groups_;
  std::vector<model::Group> names_;
  std::vector<std::uint32_t> open_;
  bool lost_outside_ = false;  ///< as GroupRecord::lost, outside any group
  std::vector<BodyRecord> bodies_;
  std::vector<model::Shape> shapes_;
  std::vector<float> largest_;  ///< per shape: its largest number, local units
  std::vector<FacetJob> facets_;
  /// By kind: equal parameters are one shape; keys are views of the file.
  std::vector<std::unordered_map<std::string_view, model::ShapeId, SeededHash>> known_;
  std::set<std::uint32_t> reported_materials_;
};

}  // namespace strake::io::rvm
