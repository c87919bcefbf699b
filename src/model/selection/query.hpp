// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <re2/re2.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "strake/core/units.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::model::selection {

enum class Field : std::uint8_t {
  any,  ///< a bare pattern: name, id or path
  name,
  id,
  path,
  file,
  type,
  category,
  color,
  attribute,
};

enum class Operator : std::uint8_t { exists, equal, match, less, less_equal, more, more_equal };

/// One question about one property of an object.
struct Test {
  Field field = Field::any;
  Operator op = Operator::equal;
  std::string attribute;             ///< its name, for Field::attribute
  std::string text;                  ///< the value as written: a glob for `equal`
  std::optional<Quantity> quantity;  ///< the value as a number with its unit, when it is one
  std::shared_ptr<const RE2> regex;  ///< for `match`
};

/// Where an object's box stands to a box of the model, grid units.
struct BoxTest {
  geometry::Box3l box;
  bool whole = false;  ///< the object lies inside, rather than touching
};

enum class NodeKind : std::uint8_t { test, box, set, negation, conjunction, disjunction };

/// A leaf's `first` is the index of its test, box or set; an inner node's operands are
/// Query::operands[first, first + count).
struct Node {
  NodeKind kind = NodeKind::test;
  std::uint32_t first = 0, count = 0;
};

struct Query {
  std::string text;
  std::vector<Test> tests;
  std::vector<BoxTest> boxes;
  std::vector<std::shared_ptr<const Query>> sets;  ///< that set(NAME) stands for
  std::vector<Node> nodes;
  std::vector<std::uint32_t> operands;
  std::uint32_t root = 0;
  /// Nodes that asking may visit, those of its sets included.
  std::uint64_t weight = 0;
};

}  // namespace strake::model::selection
