// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/neutral/primitive_lengths.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "geometry/primitives/lengths.hpp"

namespace strake::io::gltf {
namespace {

template <std::size_t Kind>
void make_if(std::string_view kind, std::span<const double> lengths,
             std::optional<geometry::Primitive>& made) {
  using Made = std::variant_alternative_t<Kind, geometry::Primitive>;
  geometry::Lengths<Made> numbers{};
  if (numbers.size() != lengths.size() || geometry::kind_name(Made{}) != kind) return;
  std::ranges::copy(lengths, numbers.begin());
  made = geometry::from_lengths<Made>(numbers);
}

}  // namespace

std::vector<double> lengths_of(const geometry::Primitive& primitive) {
  return std::visit(
      [](const auto& one) {
        const auto numbers = geometry::lengths_of(one);
        return std::vector<double>(numbers.begin(), numbers.end());
      },
      primitive);
}

std::optional<geometry::Primitive> primitive_of(std::string_view kind,
                                                std::span<const double> lengths) {
  std::optional<geometry::Primitive> made;
  [&]<std::size_t... Kinds>(std::index_sequence<Kinds...> /*all*/) {
    (make_if<Kinds>(kind, lengths, made), ...);
  }(std::make_index_sequence<std::variant_size_v<geometry::Primitive>>());
  return made;
}

}  // namespace strake::io::gltf
