// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/studies.hpp"

#include <array>

#include "cli/evaluate/studies/study_runs.hpp"

namespace strake::cli {

namespace {

constexpr std::array<StudyCase, 4> kStudies{{
    {"bucketing", "Buckets for the faces of a part",
     "The thesis expects few buckets to suit objects that overlap and many to suit scattered ones, "
     "and proposes to choose their number from the data. 'auto' does.",
     study_bucketing},
    {"push-gather", "Push against gather",
     "The thesis lets each object hide lines of all that lies under it (push), with a lock on "
     "each; "
     "here each edge gathers what hides it and stops when nothing of it is left.",
     study_push_and_gather},
    {"gap", "Two large bodies that are near but apart",
     "The thesis names them as its weak spot, of dozens of seconds: sphere subdivision has to go "
     "as "
     "deep as the gap is narrow.",
     study_gap},
    {"imported", "Imported objects with far too much detail",
     "The thesis names single objects that dominate a view. With no buckets each edge is tested "
     "against each face of the part.",
     study_imported},
}};

}  // namespace

std::span<const StudyCase> study_cases() { return kStudies; }

}  // namespace strake::cli
