// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

/// Blocks of a file's objects, bodies and groups. What they refer to, they number within the file.
namespace strake::project {

/// The numbers that things of a file have in a model: in the whole one when a file is put into it,
/// and how many there are of each.
struct FilePlace {
  std::uint32_t file = 0;
  std::uint32_t first_group = 0, groups = 0;
  std::uint32_t first_attributes = 0, attributes = 0;  ///< of groups
  std::uint32_t first_shape = 0, shapes = 0;
  std::uint32_t first_body = 0, bodies = 0;
  std::uint32_t first_object = 0, objects = 0;
  std::uint32_t first_place = 0;  ///< objects before it in the order in which files are read
};

/// Bodies [first, last) of a file, which are those of a block of objects.
struct BodyRange {
  std::uint64_t first = 0, last = 0;
};

/// What a value takes of a block at least, in bytes.
inline constexpr std::uint64_t kMinOfObject = 26, kMinOfBody = 41, kMinOfGroup = 12,
                               kMinOfAttributes = 4, kMinOfShape = 1;

using Blob = std::vector<std::byte>;

/// `objects` are those of one file that is alone in its model, ordered by id; `first_body` is how
/// many bodies come before theirs. Errors: memory.
[[nodiscard]] Result<Blob> pack_objects(std::span<const model::Object> objects);
[[nodiscard]] Result<BodyRange> unpack_objects(std::span<const std::byte> blob, std::string what,
                                               const FilePlace& place,
                                               std::span<model::Object> objects);

[[nodiscard]] Result<Blob> pack_bodies(std::span<const model::Body> bodies);
[[nodiscard]] Status unpack_bodies(std::span<const std::byte> blob, std::string what,
                                   const FilePlace& place, std::span<model::Body> bodies);

[[nodiscard]] Result<Blob> pack_groups(std::span<const model::Group> groups);
[[nodiscard]] Status unpack_groups(std::span<const std::byte> blob, std::string what,
                                   const FilePlace& place, std::span<model::Group> groups);

[[nodiscard]] Result<Blob> pack_attributes(std::span<const model::Attributes> attributes);
[[nodiscard]] Status unpack_attributes(std::span<const std::byte> blob, std::string what,
                                       std::span<model::Attributes> attributes);

}  // namespace strake::project
