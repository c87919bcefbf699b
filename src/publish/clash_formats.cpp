// SPDX-License-Identifier: Apache-2.0
#include "publish/clash_formats.hpp"

#include <span>

#include "bcf/bcf_writers.hpp"
#include "pictures/whole_run.hpp"

namespace strake::publish {
namespace {

std::vector<report::ClashWriter> clash_writers() {
  const std::span<const report::ClashWriter> texts = report::clash_writers();
  std::vector<report::ClashWriter> all(texts.begin(), texts.end());
  for (const std::span<const report::ClashWriter> more :
       {pictures::picture_writers(), bcf::clash_writers()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

std::vector<OutputFormat> clash_formats() {
  const std::vector<report::ClashWriter> writers = clash_writers();
  return formats_of(std::span(writers));
}

Result<report::ClashWriter> find_clash_writer(const std::string& file) {
  const std::vector<report::ClashWriter> writers = clash_writers();
  return find_writer(std::span(writers), file);
}

}  // namespace strake::publish
