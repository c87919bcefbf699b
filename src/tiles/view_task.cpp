// SPDX-License-Identifier: Apache-2.0
#include "tiles/view_task.hpp"

#include <algorithm>
#include <cmath>

#include "project/codec/blob.hpp"
#include "project/views/view_codec.hpp"

namespace strake::tiles {
namespace {

using project::BlobReader;
using project::BlobWriter;

/// Whether what is said by object or body is said of those of the model.
bool fits(const ViewTask& task, const model::Model& model) {
  const std::size_t objects = model.objects.size();
  const auto by_object = [&](std::size_t size) { return size == 0 || size == objects; };
  return by_object(task.options.hatches.size()) && by_object(task.options.uncut.size()) &&
         by_object(task.hatches.size()) && task.to_solve.size() == objects &&
         (task.finer.empty() || task.finer.size() == model.bodies.size()) &&
         task.named.size() == task.names.size() &&
         std::ranges::all_of(task.named, [&](std::uint32_t o) { return o < objects; }) &&
         std::isfinite(task.longest_side);
}

}  // namespace

Result<Blob> encode_task(const ViewTask& task) {
  BlobWriter out;
  project::write(out, task.view);
  project::write(out, task.options);
  project::write(out, task.box.lo);
  project::write(out, task.box.hi);
  out.real(task.longest_side);
  project::write(out, std::span<const hlr::Hatch>(task.hatches));
  out.number(task.made_for_view ? 1 : 0);
  out.flags(task.finer);
  out.flags(task.to_solve);
  out.column(std::span(task.named));
  out.texts(task.names);
  return out.finish();
}

Result<ViewTask> decode_task(const Blob& blob, const model::Model& model, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(blob, what);
  if (!in) return in.error();
  ViewTask task;
  task.view = project::read_view(*in);
  task.options = project::read_options(*in);
  task.box.lo = project::read_vector(*in);
  task.box.hi = project::read_vector(*in);
  task.longest_side = in->real();
  task.hatches = project::read_hatches(*in);
  task.made_for_view = in->number() != 0;
  task.finer = in->flags();
  task.to_solve = in->flags();
  task.named = in->column<std::uint32_t>();
  task.names = in->texts();
  if (!in->failed() && !fits(task, model)) in->refuse("it does not fit its model");
  if (const Status status = in->finish(); !status) return status.error();
  return task;
}

}  // namespace strake::tiles
