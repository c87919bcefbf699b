// SPDX-License-Identifier: Apache-2.0
#include "model/selection/query.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/glob.hpp"
#include "model/attributes.hpp"

namespace strake::model::selection {
namespace {

/// Two numbers, both in millimetres where either has a unit: a number without one is in millimetres
/// then.
struct Comparable {
  double left = 0, right = 0;
};

/// Whether two numbers differ by rounding: 6in and 152.4mm are one length, though their products
/// are not the same double.
bool differ_by_rounding(double x, double y) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  return std::fabs(x - y) <= kRounding * std::max(std::fabs(x), std::fabs(y));
}

std::optional<Comparable> comparable(const Quantity& left, const Quantity& right) {
  if (left.unit == right.unit) return Comparable{left.number, right.number};
  const auto l = unit_of_value_mm(left.unit), r = unit_of_value_mm(right.unit);
  if (!l || !r) return std::nullopt;
  Comparable both{left.number * *l, right.number * *r};
  if (differ_by_rounding(both.left, both.right)) both.left = both.right;
  return both;
}

bool holds(Operator op, const Comparable& c) {
  switch (op) {
    case Operator::equal:
      return c.left == c.right;
    case Operator::less:
      return c.left < c.right;
    case Operator::less_equal:
      return c.left <= c.right;
    case Operator::more:
      return c.left > c.right;
    case Operator::more_equal:
      return c.left >= c.right;
    case Operator::exists:
    case Operator::match:
      break;
  }
  return false;
}

bool text_passes(const PropertyTest& test, std::string_view text) {
  switch (test.op) {
    case Operator::exists:
      return !text.empty();
    case Operator::equal:
      return glob_match(test.text, text);
    case Operator::match:
      return RE2::PartialMatch(re2::StringPiece(text.data(), text.size()), *test.regex);
    default:
      return false;
  }
}

/// Whether a text is a number with blanks round it: 7 or 7.0, but not 007, a part number, nor 1e2
/// or what has more digits than a double.
bool is_plain_number(std::string_view text) {
  constexpr std::size_t kDigits = 15;
  constexpr std::string_view kUnitBlanks = " \t";
  text = text.substr(text.find_first_not_of(kUnitBlanks));
  text = text.substr(0, text.find_first_of(kUnitBlanks));
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text.size() <= kDigits && text.find_first_not_of("0123456789.") == text.npos &&
         !(text.size() > 1 && text[0] == '0' && text[1] != '.');
}

bool quantity_passes(const PropertyTest& test, std::string_view text) {
  if (!test.quantity || test.op == Operator::match || test.op == Operator::exists) return false;
  const auto value = parse_quantity(text);
  if (!value) return false;
  // Numbers without units are equal as numbers where both are written as such.
  if (test.op == Operator::equal && test.quantity->unit.empty() && value->unit.empty() &&
      !(is_plain_number(text) && is_plain_number(test.text)))
    return false;
  const auto both = comparable(*value, *test.quantity);
  return both && holds(test.op, *both);
}

}  // namespace

/// Evaluates one query for one object.
class QueryEvaluator {
 public:
  QueryEvaluator(const SelectionQuery& query, SelectionContext& context)
      : query_(query),
        context_(context),
        scene_(context.scene_),
        model_(*scene_.model),
        object_(model_.object(context.id_)) {}

  [[nodiscard]] bool evaluate(std::uint32_t index) const {
    const QueryNode& node = query_.nodes[index];
    const auto operands = [&] {
      return std::span(query_.operands).subspan(node.first, node.count);
    };
    switch (node.kind) {
      case QueryNodeKind::test:
        return passes(query_.tests[node.first]);
      case QueryNodeKind::box:
        return stands(query_.boxes[node.first]);
      case QueryNodeKind::set:
        return context_.picks_set(*query_.sets[node.first]);
      case QueryNodeKind::negation:
        return !evaluate(operands().front());
      case QueryNodeKind::conjunction:
        for (const std::uint32_t operand : operands())
          if (!evaluate(operand)) return false;
        return true;
      case QueryNodeKind::disjunction:
        for (const std::uint32_t operand : operands())
          if (evaluate(operand)) return true;
        return false;
    }
    return false;
  }

 private:
  [[nodiscard]] bool passes(const PropertyTest& test) const {
    switch (test.field) {
      case PropertyField::any:
        return text_passes(test, object_.name) || text_passes(test, object_.id) ||
               path_passes(test);
      case PropertyField::name:
        return text_passes(test, object_.name);
      case PropertyField::id:
        return text_passes(test, object_.id);
      case PropertyField::path:
        return path_passes(test);
      case PropertyField::file:
        return text_passes(test, model_.files[object_.file].label);
      case PropertyField::attribute:
        return attribute_passes(test);
      case PropertyField::type:
      case PropertyField::category:
      case PropertyField::color:
        return body_passes(test);
    }
    return false;
  }

  /// Whether the path passes in either form: "/SITE/ZONE", or "/SITE//ZONE" as the plain joining of
  /// the names has it.
  [[nodiscard]] bool path_passes(const PropertyTest& test) const {
    const SelectionContext::Path& path = context_.whole_path();
    return text_passes(test, path.joined) ||
           (!path.slashed.empty() && text_passes(test, path.slashed));
  }

  /// Whether an attribute passes. A name may occur several times; one that passes is enough.
  [[nodiscard]] bool attribute_passes(const PropertyTest& test) const {
    const Attributes* const stated = model_.stated(object_, test.attribute).attributes;
    if (stated == nullptr) return false;
    for (const auto& [name, value] : *stated)
      if (name == test.attribute &&
          (test.op == Operator::exists || text_passes(test, value) || quantity_passes(test, value)))
        return true;
    return false;
  }

  [[nodiscard]] bool body_passes(const PropertyTest& test) const {
    for (std::uint32_t b = 0; b < object_.body_count; ++b) {
      const Body& body = model_.bodies[object_.first_body + b];
      const bool passes = test.field == PropertyField::type
                              ? text_passes(test, kind_name(model_.shapes[index(body.shape)]))
                          : test.field == PropertyField::category
                              ? text_passes(test, name(body.category))
                              : text_passes(test, color_text(body.color));
      if (passes) return true;
    }
    return false;
  }

  [[nodiscard]] bool stands(const BoxTest& test) const {
    geometry::Box3l box = geometry::empty_box<std::int64_t>();
    for (const GridBody& body : scene_.bodies_of(context_.id_)) {
      const GridShape& shape = scene_.shapes[body.grid_shape];
      if (!shape.box.empty()) box.include(body.box(shape));
    }
    if (box.empty()) return false;
    return test.whole ? test.box.contains(box) : test.box.meets(box);
  }

  const SelectionQuery& query_;
  SelectionContext& context_;
  const Scene& scene_;
  const Model& model_;
  const Object& object_;
};

bool SelectionContext::picks(const SelectionQuery& query) {
  return QueryEvaluator(query, *this).evaluate(query.root);
}

bool SelectionContext::picks_set(const SelectionQuery& query) {
  for (const auto& [set, picked] : known_)
    if (set == &query) return picked;
  const bool picked = picks(query);
  known_.emplace_back(&query, picked);
  return picked;
}

const SelectionContext::Path& SelectionContext::whole_path() {
  if (path_) return *path_;
  const Object& object = scene_.model->object(id_);
  std::vector<std::string_view> names = scene_.model->group_names(object);
  names.emplace_back(object.name);
  path_.emplace(Path{joined_path(names), {}});
  if (std::any_of(names.begin() + 1, names.end(),
                  [](std::string_view name) { return name.starts_with('/'); }))
    path_->slashed = fmt::format("{}", fmt::join(names, "/"));
  return *path_;
}

}  // namespace strake::model::selection
