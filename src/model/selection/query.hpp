// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <re2/re2.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"

/// A parsed selection, and its evaluation for an object.
namespace strake::model::selection {

enum class PropertyField : std::uint8_t {
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

/// A test of one property of an object.
struct PropertyTest {
  PropertyField field = PropertyField::any;
  Operator op = Operator::equal;
  std::string attribute;             ///< its name, for PropertyField::attribute
  std::string text;                  ///< the value as written: a glob for `equal`
  std::optional<Quantity> quantity;  ///< the value as a number with its unit, when it is one
  std::shared_ptr<const RE2> regex;  ///< for `match`
};

/// A test of how an object's box lies to a box of the model, grid units.
struct BoxTest {
  geometry::Box3l box;
  bool whole = false;  ///< the object lies inside, rather than touching
};

enum class QueryNodeKind : std::uint8_t { test, box, set, negation, conjunction, disjunction };

/// A node of the tree of a query. A leaf's `first` is the index of its test, box or set; an inner
/// node's operands are SelectionQuery::operands[first, first + count).
struct QueryNode {
  QueryNodeKind kind = QueryNodeKind::test;
  std::uint32_t first = 0, count = 0;
};

struct SelectionQuery {
  std::string text;
  std::vector<PropertyTest> tests;
  std::vector<BoxTest> boxes;
  std::vector<std::shared_ptr<const SelectionQuery>>
      sets;  ///< the queries that set(NAME) stands for
  std::vector<QueryNode> nodes;
  std::vector<std::uint32_t> operands;
  std::uint32_t root = 0;
  /// The number of nodes that an evaluation may visit, those of its sets included.
  std::uint64_t weight = 0;
};

/// An object for which several queries are evaluated: what is costly to find out is kept.
class SelectionContext {
 public:
  SelectionContext(const Scene& scene, ObjectId id) : scene_(scene), id_(id) {}

  /// Whether the query picks the object.
  [[nodiscard]] bool picks(const SelectionQuery& query);

 private:
  friend class QueryEvaluator;
  /// Whether a set picks the object; the answer is kept, as many queries name the same set.
  [[nodiscard]] bool picks_set(const SelectionQuery& query);
  /// The path of its groups and its own name. `slashed` has a '/' for the level besides the one
  /// that a name begins with, where there are such names; else it is empty.
  struct Path {
    std::string joined, slashed;
  };
  [[nodiscard]] const Path& whole_path();

  const Scene& scene_;
  ObjectId id_;
  std::optional<Path> path_;
  std::vector<std::pair<const SelectionQuery*, bool>> known_;
};

}  // namespace strake::model::selection
