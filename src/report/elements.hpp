// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "strake/model/model.hpp"

namespace strake::report {

/// The objects of a model as a document lists them, so that a later run can be compared with it:
/// 64-bit hashes in ascending order.
class Elements {
 public:
  explicit Elements(const model::Model& model);

  /// The hashes, little endian, as base64.
  void append_list(std::string& out) const;
  /// A bit for each of them in that order, the lowest of a byte first, as base64.
  void append_members(std::string& out, const std::vector<bool>& member) const;
  /// A byte for each of them in that order, as base64; 0 beyond the end of `of_object`.
  void append_bytes(std::string& out, const std::vector<std::uint8_t>& of_object) const;

 private:
  struct Element {
    std::uint64_t hash = 0;
    std::uint32_t object = 0;
  };
  std::vector<Element> elements_;
};

}  // namespace strake::report
