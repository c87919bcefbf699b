// SPDX-License-Identifier: Apache-2.0
#include "report/report_writers.hpp"

#include <array>

namespace strake::report {
namespace {

constexpr std::array kClashWriters{
    ClashWriter{{".json", " as {}"}, write_clash_json, true},
    ClashWriter{{".csv", " or {}"}, write_clash_csv, true},
    ClashWriter{{".joints.csv", ", the joints of pipes as {}"}, write_joints_csv, true},
    ClashWriter{{".xml", ", for Navisworks and others as {}"}, write_clash_xml, true},
    ClashWriter{{".ifcclash.json", ", as ifcclash has them as {}"}, write_ifcclash_json},
};

constexpr std::array kClashDiffWriters{
    ClashDiffWriter{{".json", " as {}"}, write_clash_diff_json},
};

constexpr std::array kViewDiffWriters{
    ViewDiffWriter{{".json", " as {}"}, write_view_diff_json},
    ViewDiffWriter{{".svg", ", or a picture of it as {}"}, write_view_diff_svg},
};

}  // namespace

std::span<const ClashWriter> clash_writers() { return kClashWriters; }

std::span<const ClashDiffWriter> clash_diff_writers() { return kClashDiffWriters; }

std::span<const ViewDiffWriter> view_diff_writers() { return kViewDiffWriters; }

}  // namespace strake::report
