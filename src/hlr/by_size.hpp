// SPDX-License-Identifier: Apache-2.0
// Loops over the elements of one shape: by the whole team where it is big, so that one imported
// mesh does not keep a worker busy while the others wait, and with no region to open where it is
// small, as most are.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::hlr {

/// What is worth a team: so many triangles, edges or vertices.
inline constexpr std::size_t kBigShape = std::size_t{1} << 15U;
/// Elements that a worker takes at a time.
inline constexpr std::size_t kElements = 2048;

/// body(i) for each i < n; in any order.
template <class Body>
[[nodiscard]] Status for_elements(const parallel::Context& context, std::string_view name,
                                  std::size_t n, Body&& body) {
  if (n >= kBigShape)
    return parallel::for_each(context, {.name = name, .n = n, .grain = kElements}, body);
  for (std::size_t i = 0; i < n; ++i) body(i);
  return {};
}

/// All elements folded into one value: add(value, i) for each i < n, then combine(into, value) for
/// runs of them, in their order. The same runs for any team.
template <class T, class Add, class Combine>
[[nodiscard]] Result<T> fold_elements(const parallel::Context& context, std::string_view name,
                                      std::size_t n, T value, Add&& add, Combine&& combine) {
  if (n >= kBigShape)
    return parallel::reduce(context, {.name = name, .n = n, .grain = kElements}, value, add,
                            combine);
  for (std::size_t i = 0; i < n; ++i) add(value, i);
  return value;
}

/// What body(i, out) appends for each i < n, in their order.
template <class T, class Body>
[[nodiscard]] Result<std::vector<T>> collect_elements(const parallel::Context& context,
                                                      std::string_view name, std::size_t n,
                                                      Body&& body) {
  if (n >= kBigShape)
    return parallel::collect<T>(context, {.name = name, .n = n, .grain = kElements}, body);
  std::vector<T> out;
  for (std::size_t i = 0; i < n; ++i) body(i, out);
  return out;
}

}  // namespace strake::hlr
