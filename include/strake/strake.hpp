// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0058 says what is public.

/// The common path: read models, select objects, find clashes, draw views, write results.
/// docs/library.md has the steps; `find_package(strake)` defines strake::strake.
// IWYU pragma: begin_exports
#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/core/version.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/view.hpp"
#include "strake/drawing/write.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/io/reader.hpp"
#include "strake/io/writer.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/selection.hpp"
#include "strake/parallel/team.hpp"
#include "strake/project/project.hpp"
#include "strake/publish/publish.hpp"
#include "strake/report/clash.hpp"
#include "strake/rules/rules.hpp"
#include "strake/sheets/sheet_file.hpp"
#include "strake/sheets/write.hpp"
// IWYU pragma: end_exports
