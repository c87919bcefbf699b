// SPDX-License-Identifier: Apache-2.0
#include "mass.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/transform.hpp"

namespace convert::after {

using namespace strake::parallel;

namespace {

Sums sums_of(const Part& part, const Piece& piece) {
  Sums sums;
  for (std::size_t t = piece.first; t < piece.last; ++t) {
    const auto& [a, b, c] = part.triangles[t];
    sums.add(part.points[a], part.points[b], part.points[c]);
  }
  return sums;
}

void add_part(std::uint32_t part, Masses& result) {
  const Sums& sums = result.of_part[part];
  if (sums.is_closed())
    result.total.add(sums);
  else
    result.open.push_back(part);
}

}  // namespace

strake::Result<Masses> masses(const Model& model, const Context& context) {
  const auto triangles = [&](std::size_t part) { return model[part].triangles.size(); };
  const auto work = pieces(model.size(), triangles, 2048);
  if (!work) return work.error();
  const auto sums = transform(context, {.name = "sums", .n = work->size()}, [&](std::size_t k) {
    return sums_of(model[(*work)[k].item], (*work)[k]);
  });
  if (!sums) return sums.error();
  Masses result;
  result.of_part.resize(model.size());
  for (std::size_t k = 0; k < work->size(); ++k) result.of_part[(*work)[k].item].add((*sums)[k]);
  for (std::uint32_t part = 0; part < model.size(); ++part) add_part(part, result);
  return result;
}

}  // namespace convert::after
