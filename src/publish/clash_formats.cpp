// SPDX-License-Identifier: Apache-2.0
#include "publish/clash_formats.hpp"

#include <span>

<<<<<<< HEAD
#include "bcf/bcf_writers.hpp"
=======
#include "pictures/whole_run.hpp"
>>>>>>> wip-pictures

namespace strake::publish {
namespace {

std::vector<report::ClashWriter> clash_writers() {
  const std::span<const report::ClashWriter> texts = report::clash_writers();
<<<<<<< HEAD
  std::vector<report::ClashWriter> writers{texts.begin(), texts.end()};
  const std::span<const report::ClashWriter> topics = bcf::clash_writers();
  writers.insert(writers.end(), topics.begin(), topics.end());
  return writers;
=======
  const std::span<const report::ClashWriter> pictures = pictures::picture_writers();
  std::vector<report::ClashWriter> all(texts.begin(), texts.end());
  all.insert(all.end(), pictures.begin(), pictures.end());
  return all;
>>>>>>> wip-pictures
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
