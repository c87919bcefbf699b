// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/studies.hpp"

#include <array>

#include "cli/evaluate/studies/study_runs.hpp"

namespace strake::cli {

namespace {

constexpr std::array<StudyCase, 11> kStudies{{
    {"bucketing", "Buckets for the faces of a part",
     "The thesis expects few buckets to suit objects that overlap and many to suit scattered ones, "
     "and proposes to choose their number from the data. 'auto' does.",
     study_bucketing},
    {"push-gather", "Push against gather",
     "The thesis lets each object hide lines of all that lies under it (push), with a lock on "
     "each; here each edge gathers what hides it and stops when nothing of it is left.",
     study_push_and_gather},
    {"gap", "Two large bodies that are near but apart",
     "The thesis names them as its weak spot, of dozens of seconds: sphere subdivision has to go "
     "as deep as the gap is narrow.",
     study_gap},
    {"imported", "Imported objects with far too much detail",
     "The thesis names single objects that dominate a view. With no buckets each edge is tested "
     "against each face of the part.",
     study_imported},
    {"distribution", "Equal index ranges against competitive distribution",
     "The thesis deals stage 1 of clash detection out in equal ranges and all else competitively, "
     "and shows 7 workers on one example: 0.23 to 19.26 s with equal ranges, 6.78 to 8.94 s "
     "competitively. Here all loops of a run go one way or the other, on a deck with a group of "
     "imported objects. Busy seconds are CPU time of 7 workers, whatever the cores; wall seconds "
     "tell them apart only where there are as many cores.",
     study_distribution},
    {"longest-first", "Longest first, and as it comes",
     "What is started last decides when a team ends. Visiting orders by estimated cost against "
     "items as they are numbered, competitively both. Bound: the balance that the longest block "
     "allows, whatever the schedule.",
     study_longest_first},
    {"granularity", "Units of work",
     "The thesis weighs segment, plane and line as units of local hidden lines, over-segment, "
     "over-plane and under-edge as those of global ones, pairs of objects and of their parts as "
     "those of clash detection. Rows say what the regions of a unit took with 7 workers, or "
     "which dependency is in the way.",
     study_granularity},
    {"memory", "Memory by number of threads",
     "The thesis tells of memory that grows with the threads, without figures. The rule here: at "
     "most the sequential peak, 5 % and 16 MiB a thread. Mebibytes of the process; model and scene "
     "are among them.",
     study_memory},
    {"stage-one", "Loops over pairs of boxes",
     "The thesis runs stage 1 over the flattened pairs in equal ranges, or over the larger of the "
     "two loops competitively. Tests of boxes alone, of objects of the dense ship, 7 workers.",
     study_stage_one},
    {"octree", "Boxes in a loose octree and in a hierarchy",
     "The thesis describes octrees as another way to find near boxes. Both trees answer the same "
     "query for each object of the four ships, on one thread; the join of the hierarchy with "
     "itself, which the engine uses, stands beside.",
     study_octree},
    {"existing-view", "Existing view against new view",
     "The thesis removes hidden lines of a new view locally and globally. Of an existing one the "
     "local results lie in the view, so that it does the global step only, and all again where "
     "objects were added. Here an existing view costs what changed reaches. Seconds of a view "
     "that changed are those of signatures, their comparison and lines; the thesis's way is that "
     "much of our new view. Bytes are compared with those of a drawing made anew.",
     study_existing_view},
}};

}  // namespace

std::span<const StudyCase> study_cases() { return kStudies; }

}  // namespace strake::cli
