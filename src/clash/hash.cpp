// SPDX-License-Identifier: Apache-2.0
#include "strake/core/hash.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "clash/reduce.hpp"

namespace strake::clash {

std::string hash_of(const Report& report, const model::Model& model) {
  Hasher hasher;
  const auto add_object = [&](model::ObjectId id) {
    const model::Object& object = model.object(id);
    hasher.add(std::string_view(model.files[object.file].label));
    hasher.add(std::string_view(object.id));
  };
  for (const Pair& pair : report.pairs) {
    add_object(pair.a);
    add_object(pair.b);
    hasher.add(std::uint32_t{static_cast<std::uint8_t>(pair.cls)});
    hasher.add(std::uint32_t{static_cast<std::uint8_t>(pair.relation)});
    hasher.add(pair.d_mm);
    for (const geometry::Vec3d& p : {pair.point_mm, pair.on_a_mm, pair.on_b_mm, pair.away})
      for (int k = 0; k < 3; ++k) hasher.add(p[k]);
    if (pair.allowed >= 0)
      hasher.add(std::string_view(report.allowed[static_cast<std::size_t>(pair.allowed)].rule));
  }
  return hasher.value().text();
}

}  // namespace strake::clash
