// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::io {

struct WriteOptions {
  /// GLB is written in millimetres with z up instead of the standard's metres with y up;
  /// asset.extras says so (unit_mm, up_axis), where our reader finds it. Whole millimetres are then
  /// exact.
  bool millimetres_z_up = false;
  /// GLB is written so that our reader makes the same model of it, to the last bit: primitives,
  /// doubles that float32 would round, faces, categories and precisions stand beside what viewers
  /// show (docs/formats/gltf.md); it is in metres with y up. Other formats take no notice.
  bool keep_all = false;
  /// The largest distance of the triangles written for an analytic primitive from its surface, mm.
  double sag_mm = 0.5;
};

/// Writes a model as binary glTF 2.0: an object is a node with a mesh, a name and extras
/// {id, path, attributes}; groups are parent nodes with their attributes; bodies of equal shape and
/// colour share a mesh; colours are materials; polylines are LINES.
///
/// 1. The file appears whole or not at all; the same model gives the same bytes.
/// 2. Coordinates are float32 in the shape's own frame, node matrices are doubles.
/// 3. Bodies of one object that stand apart are written in the frame of its first body, so that
///    a node with a mesh is always one whole object.
/// 4. A mesh of which all triangles say how far they lie from the true surface
///    (geometry::TriangleMesh::sag_mm) says so in its extras (sag_mm), where our reader finds it;
///    one with analytic primitives says nothing.
///
/// Source polygons of triangles, body categories and analytic primitives as such are not kept,
/// but with WriteOptions::keep_all, where 2. and 3. do not hold: each body is a node. The objects
/// of each of several files are in a group of its name then, and ids that two files have begin with
/// it.
///
/// Errors: output (cannot write, more than 4 GiB, a coordinate that is not finite), cancelled.
[[nodiscard]] Status write_glb(const model::Model& model, const std::filesystem::path& path,
                               const WriteOptions& options, const parallel::Context& context);

/// Takes bytes piece by piece; pieces end anywhere.
using ByteSink = parallel::FunctionRef<void(std::string_view)>;

/// Hands the same bytes to a sink. Errors: those of write_glb(); then what went to the sink is no
/// GLB.
[[nodiscard]] Status put_glb(const model::Model& model, ByteSink sink, const WriteOptions& options,
                             const parallel::Context& context);

/// Writes a model as Wavefront OBJ in world millimetres with z up: one `o` per object, named by its
/// id, triangles as `f`, polylines as `l`; numbers are written so that they read back exactly.
/// Guarantee 1 holds; hierarchy, attributes, colours and sharing are not kept.
[[nodiscard]] Status write_obj(const model::Model& model, const std::filesystem::path& path,
                               const WriteOptions& options, const parallel::Context& context);

}  // namespace strake::io
