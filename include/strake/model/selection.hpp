// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::model {

namespace selection {
struct SelectionQuery;
}

/// A query that picks objects, as a user writes it:
///
///     type = cylinder and @DN >= 150mm and not path = "/HULL/*"
///
/// The language is defined in docs/selection.md. A selection is immutable and may be evaluated by
/// several threads at once.
class Selection {
 public:
  /// Parses a selection. Errors: usage, with the column where the text stops making sense and what
  /// could stand there.
  [[nodiscard]] static Result<Selection> parse(std::string_view text);

  /// A function that returns what set(NAME) stands for; an error without a position gets that of
  /// the name.
  using SetLookup = parallel::FunctionRef<Result<Selection>(std::string_view name)>;
  /// Parses a selection where named sets are known.
  [[nodiscard]] static Result<Selection> parse(std::string_view text, SetLookup set);

  /// Returns the text that was parsed.
  [[nodiscard]] const std::string& text() const;

  /// Whether it asks, itself or by a set that it names, for an attribute, and for a name, id or
  /// path without saying which.
  [[nodiscard]] bool tests_attributes() const;
  [[nodiscard]] bool has_bare_pattern() const;

  /// Whether the object is picked. The box of an object is that of its placed bodies; an object
  /// without bodies is in no box.
  [[nodiscard]] bool picks(const Scene& scene, ObjectId object) const;

 private:
  friend Result<std::vector<std::vector<bool>>> pick(std::span<const Selection> selections,
                                                     const Scene& scene,
                                                     const parallel::Context& context);
  friend std::string picks_nothing(const Selection& selection, const Model& model);
  explicit Selection(std::shared_ptr<const selection::SelectionQuery> query)
      : query_(std::move(query)) {}
  std::shared_ptr<const selection::SelectionQuery> query_;
};

/// Returns whether each object of the scene is picked: the form in which hlr::draw() takes what to
/// draw, and clash::detect() its sets. Errors: cancelled.
[[nodiscard]] Result<std::vector<bool>> pick(const Selection& selection, const Scene& scene,
                                             const parallel::Context& context);

/// Evaluates several selections in one pass: what they share, such as an object's path and the sets
/// they name, is worked out once per object.
[[nodiscard]] Result<std::vector<std::vector<bool>>> pick(std::span<const Selection> selections,
                                                          const Scene& scene,
                                                          const parallel::Context& context);

/// Says that a selection picks no object; where it requests an attribute that no object and no
/// group has, this too, with the names of those there are, the commonest first.
[[nodiscard]] std::string picks_nothing(const Selection& selection, const Model& model);

}  // namespace strake::model
