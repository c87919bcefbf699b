// SPDX-License-Identifier: Apache-2.0
#include "project/changes/run_files.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "project/changes/fingerprints.hpp"
#include "strake/core/hash.hpp"
#include "strake/project/update.hpp"

namespace strake::project {
namespace {

Hash128 hash_of_place(const Fingerprint& print) {
  const std::array<std::uint64_t, 4> words{print.shapes.high, print.shapes.low, print.places.high,
                                           print.places.low};
  return hash_bytes(std::as_bytes(std::span(words)));
}

/// Returns the labels alone.
report::RunFiles labelled_files(const model::Model& model) {
  report::RunFiles run;
  for (const model::SourceFile& file : model.files) run.files.push_back({file.label, {}, {}});
  return run;
}

bool have_equal_labels(const model::Model& then, const model::Model& now) {
  return std::ranges::equal(then.files, now.files, {}, &model::SourceFile::label,
                            &model::SourceFile::label);
}

}  // namespace

Result<report::RunFiles> run_files(const model::Model& model, const parallel::Context& context) {
  const Result<std::vector<Fingerprint>> prints = fingerprints(model, context);
  if (!prints) return prints.error();
  report::RunFiles run = labelled_files(model);
  for (std::size_t o = 0; o < model.objects.size(); ++o) {
    const model::Object& object = model.objects[o];
    report::FileContents& file = run.files[object.file];
    if (!object.positional_id) file.ids.push_back(object.id);
    if (object.body_count > 0) file.places.push_back(hash_of_place((*prints)[o]));
  }
  for (report::FileContents& file : run.files) {
    std::ranges::sort(file.places);
    const auto rest = std::ranges::unique(file.places);
    file.places.erase(rest.begin(), rest.end());
  }
  return run;
}

Result<report::FileMatches> match_files(const model::Model& then, const model::Model& now,
                                        std::span<const std::string> given_pairs,
                                        const parallel::Context& context) {
  if (given_pairs.empty() && have_equal_labels(then, now))
    return report::match_files(labelled_files(then), labelled_files(now));
  const Result<report::RunFiles> before = run_files(then, context);
  if (!before) return before.error();
  const Result<report::RunFiles> after = run_files(now, context);
  if (!after) return after.error();
  const Result<std::vector<report::FilePair>> pairs =
      report::parse_file_pairs(given_pairs, *before, *after);
  if (!pairs) return pairs.error();
  return report::match_files(*before, *after, *pairs);
}

}  // namespace strake::project
