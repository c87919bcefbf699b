// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Shape.hxx>
#include <filesystem>
#include <string>

namespace strake::import_step {

/// Writes STEP and IGES files of small models into a folder, by Open CASCADE:
///
/// - rig.step: an assembly of a plate, four bolts and two brackets with two bolts each; in mm.
///   rig_inch.step and rig_metre.step are the same in other units.
/// - curved.step: solids with seams and poles; two_solids.step: a product that has two.
/// - open.step: a box without its lid.
/// - faces.igs: a box and a cylinder as surfaces, nothing said of how they hang together;
///   solid.igs: a solid.
///
/// Returns whether all were written.
[[nodiscard]] bool write_step_files(const std::filesystem::path& folder);

/// The solids of curved.step, one beside the other.
[[nodiscard]] TopoDS_Shape curved_solids();

}  // namespace strake::import_step
