// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

/// Writes the members of a clash document.
namespace strake::report {

// These functions append the items of the clash document's lists; `test` is the number of their
// test.

/// Appends a result, with the number of its group if there are groups.
void append_result(std::string& out, const ClashContents& contents, std::size_t test,
                   const clash::Pair& pair, std::optional<std::uint32_t> group);

/// Appends the members `by`, `date` and `comment` of a decision, as far as it has them.
void append_decided(std::string& out, const Decision& decision);

void append_group(std::string& out, const clash::Group& group);

void append_exempted_pair(std::string& out, const ClashContents& contents, std::size_t test,
                          const clash::ExemptedPair& pair);

void append_not_compared(std::string& out, const ClashContents& contents, std::size_t test,
                         const clash::NotCompared& what);

/// Appends the member `tests` without what of it names objects by their places in `elements`.
[[nodiscard]] Status append_test_list(std::string& out, const clash::Findings& findings);

/// Appends the members `elements` and `tests` of the clash document: what was checked, by which
/// rules and tolerances, and how much was found. Errors: cancelled, out of memory.
[[nodiscard]] Status append_tests(std::string& out, const clash::Findings& findings,
                                  const model::Model& model, const parallel::Context& context);

/// Writes the document of write_clash_json() without its long lists: without `results`, the list of
/// `groups`, and what is only there to compare runs (`elements`, `sheets`, `positional_ids` and
/// `tested` of the tests). It is for writers that have results in another form. Errors: cancelled,
/// out of memory.
[[nodiscard]] Status write_clash_head(const ClashContents& contents, Sink sink,
                                      const parallel::Context& context);

}  // namespace strake::report
