// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::test {

/// Whether two values without padding are the same to the last bit: two zeros differ, and a number
/// that is none is itself.
template <class T>
[[nodiscard]] bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <class T>
[[nodiscard]] bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

[[nodiscard]] inline bool same_shape(const model::Shape& a, const model::Shape& b) {
  if (a.index() != b.index()) return false;
  if (const auto* const mesh = std::get_if<geometry::TriangleMesh>(&a)) {
    const auto& other = std::get<geometry::TriangleMesh>(b);
    return same_bits(mesh->vertices, other.vertices) &&
           same_bits(mesh->triangles, other.triangles) && same_bits(mesh->faces, other.faces) &&
           same_bits(mesh->sag_mm, other.sag_mm);
  }
  if (const auto* const lines = std::get_if<geometry::Polylines>(&a)) {
    const auto& other = std::get<geometry::Polylines>(b);
    return same_bits(lines->points, other.points) && same_bits(lines->first, other.first);
  }
  const auto& primitive = std::get<geometry::Primitive>(a);
  const auto& other = std::get<geometry::Primitive>(b);
  return primitive.index() == other.index() &&
         std::visit(
             [&](const auto& one) {
               return same_bits(one, std::get<std::decay_t<decltype(one)>>(other));
             },
             primitive);
}

[[nodiscard]] inline bool same_body(const model::Body& a, const model::Body& b) {
  return a.shape == b.shape && same_bits(a.precision_um, b.precision_um) &&
         same_bits(a.placement.linear.row, b.placement.linear.row) &&
         same_bits(a.placement.translation, b.placement.translation) && a.color == b.color &&
         a.category == b.category;
}

[[nodiscard]] inline bool same_object(const model::Object& a, const model::Object& b) {
  return a.id == b.id && a.name == b.name && a.file == b.file && a.parent == b.parent &&
         a.first_body == b.first_body && a.body_count == b.body_count && a.place == b.place &&
         a.attributes == b.attributes && a.incomplete == b.incomplete &&
         a.positional_id == b.positional_id;
}

[[nodiscard]] inline bool same_group(const model::Group& a, const model::Group& b) {
  return a.name == b.name && a.parent == b.parent && a.attributes == b.attributes;
}

[[nodiscard]] inline bool same_file(const model::SourceFile& a, const model::SourceFile& b) {
  return a.label == b.label && a.format == b.format && a.unit == b.unit && a.up_axis == b.up_axis &&
         a.bytes == b.bytes && same_bits(a.precision_mm, b.precision_mm) &&
         a.folders == b.folders && a.ends_early == b.ends_early;
}

[[nodiscard]] inline bool same_diagnostic(const Diagnostic& a, const Diagnostic& b) {
  return a.severity == b.severity && a.code == b.code && a.message == b.message &&
         a.where == b.where;
}

/// What two models differ in first, as "object 17"; empty where they are the same.
[[nodiscard]] inline std::string model_difference(const model::Model& a, const model::Model& b) {
  const auto compare = [](const char* what, const auto& p, const auto& q, auto same) {
    if (p.size() != q.size()) return std::string("number of ") + what;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (!same(p[i], q[i])) return std::string(what) + ' ' + std::to_string(i);
    return std::string();
  };
  const auto equal = [](const auto& p, const auto& q) { return p == q; };
  const auto same_count = [](const Diagnostics::Count& p, const Diagnostics::Count& q) {
    return p.code == q.code && p.severity == q.severity && p.count == q.count;
  };
  for (std::string found :
       {compare("file", a.files, b.files, same_file),
        compare("group", a.groups, b.groups, same_group),
        compare("attributes of group", a.group_attributes, b.group_attributes, equal),
        compare("shape", a.shapes, b.shapes, same_shape),
        compare("object", a.objects, b.objects, same_object),
        compare("body", a.bodies, b.bodies, same_body),
        compare("diagnostic", a.diagnostics.kept(), b.diagnostics.kept(), same_diagnostic),
        compare("count", a.diagnostics.counts(), b.diagnostics.counts(), same_count)})
    if (!found.empty()) return found;
  return {};
}

}  // namespace strake::test
