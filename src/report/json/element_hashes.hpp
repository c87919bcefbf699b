// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::report {

/// The objects of a model as a document lists them, so that a later run can be compared with it:
/// 64-bit hashes in ascending order.
class ElementHashes {
 public:
  /// Errors: cancelled, out of memory.
  [[nodiscard]] static Result<ElementHashes> of(const model::Model& model,
                                                const parallel::Context& context);

  // These append base64. Errors: cancelled, out of memory.

  /// Appends the hashes, little endian.
  [[nodiscard]] Status append_list(std::string& out, const parallel::Context& context) const;
  /// Appends a bit for each hash in that order, the lowest of a byte first.
  [[nodiscard]] Status append_members(std::string& out, const std::vector<bool>& member,
                                      const parallel::Context& context) const;
  /// Appends a byte for each hash in that order; 0 beyond the end of `of_object`.
  [[nodiscard]] Status append_bytes(std::string& out, const std::vector<std::uint8_t>& of_object,
                                    const parallel::Context& context) const;

 private:
  struct HashedElement {
    std::uint64_t hash = 0;
    std::uint32_t object = 0;
  };
  /// Returns the eight elements from one on, or those that are left.
  [[nodiscard]] std::span<const HashedElement> eight_from(std::size_t first) const {
    return std::span(elements_).subspan(first, std::min<std::size_t>(8, elements_.size() - first));
  }
  std::vector<HashedElement> elements_;
};

}  // namespace strake::report
