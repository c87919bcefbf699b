// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "report/exchange/clash_row.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

enum class JointKind : std::uint8_t {
  end_to_end,    ///< an end of the one on an end of the other, axes in line to within 30 degrees
  end_on_side,   ///< an end of the one on the other, as a branch
  side_by_side,  ///< the two touch elsewhere
};

/// A place where two pipes touch.
struct PipeJoint {
  clash::ResultRef result;
  JointKind kind = JointKind::side_by_side;
  geometry::Vec3d at_mm;  ///< the middle of the two ends, the end, or the point of the result
  /// The diameters of the two there, where an end is that of an exact primitive.
  std::optional<double> a_diameter_mm, b_diameter_mm;
};

[[nodiscard]] std::string_view name(JointKind kind);

/// Returns the joints of pipes among the contacts of the findings, whether a rule allows them or
/// not, in their order; of two that meet end to end at several places each of these. A pipe is an
/// object that has round ends: those of cylinders, snouts, bent tubes and dishes, and where the
/// model on the grid is there the round ends of meshes. Errors: cancelled, out of memory.
[[nodiscard]] Result<std::vector<PipeJoint>> pipe_joints(const ClashContents& contents,
                                                         const parallel::Context& context);

inline constexpr std::array kJointColumns{
    "test",   "key",  "kind", "a_id", "a_name",        "a_file",        "b_id", "b_name",
    "b_file", "x_mm", "y_mm", "z_mm", "a_diameter_mm", "b_diameter_mm", "d_mm", "allowed_by"};

/// Appends the cells of a joint, then the attributes of both.
template <class Row>
void append_joint_cells(Row& row, const ClashContents& contents, const PipeJoint& joint) {
  const clash::Report& test = contents.findings.tests[joint.result.test];
  const clash::Pair& p = test.pairs[joint.result.pair];
  row.text(test.name).word(clash::pair_key(test.name, contents.model, p.a, p.b));
  row.word(name(joint.kind));
  append_identity(row, contents.model, p.a);
  append_identity(row, contents.model, p.b);
  append_point(row, joint.at_mm);
  for (const std::optional<double>& diameter : {joint.a_diameter_mm, joint.b_diameter_mm}) {
    if (diameter)
      row.number(*diameter, append_mm);
    else
      row.blank();
  }
  row.number(p.d_mm, append_mm);
  row.text(p.allowed < 0 ? std::string_view()
                         : test.allowed[static_cast<std::size_t>(p.allowed)].rule);
  append_attributes(row, contents, p.a, p.b);
}

}  // namespace strake::report
