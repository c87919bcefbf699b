// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

/// Clash results as BCF (BIM Collaboration Format), for programs in which people look at them.
namespace strake::bcf {

/// Writes BCF 2.1 or 3.0 as contents.bcf has it: a topic for each group or result, with a viewpoint
/// and a picture where contents.scene is given. The GUID of a topic comes from the key of the clash
/// or the id of the group, so that a file written later updates what was there. The bytes are the
/// same for any team. Errors: output for more topics than an archive holds, cancelled, out of
/// memory.
[[nodiscard]] Status write_bcf(const report::ClashContents& contents, report::Sink sink,
                               const parallel::Context& context = {});

/// Whether it is known when topics were made: by BcfForm::date, or since a model file says when it
/// was written. Otherwise their date is 1970-01-01.
[[nodiscard]] bool is_dated(const report::ClashContents& contents);

/// Returns how many dates of decisions and comments about the topics are none: the file has others
/// in their place, or none where it needs none.
[[nodiscard]] std::uint64_t strange_dates_of_bcf(const report::ClashContents& contents);

/// Returns what the file does not have, for people; empty where it has all.
[[nodiscard]] std::string left_out_of_bcf(const report::ClashContents& contents);

}  // namespace strake::bcf
