// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/columns.hpp"

namespace strake::project {

Result<Blob> pack_groups(std::span<const model::Group> groups) {
  TextColumn names;
  std::vector<std::uint32_t> parents, attributes;
  for (const model::Group& group : groups) {
    names.add(group.name);
    parents.push_back(model::index(group.parent));
    attributes.push_back(group.attributes);
  }
  BlobWriter out;
  names.write(out);
  write_steps(out, parents);
  write_steps(out, attributes);
  return out.finish();
}

Status unpack_groups(std::span<const std::byte> blob, std::string what, const FilePlace& place,
                     std::span<model::Group> groups) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  TextSource names(*in);
  if (names.size() != groups.size()) in->refuse("names lack");
  const std::vector<std::uint32_t> parents = read_steps(*in, groups.size());
  const std::vector<std::uint32_t> attributes = read_steps(*in, groups.size());
  if (const Status status = in->finish(); !status) return status;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    model::Group& group = groups[i];
    group.name = names.next();
    const bool child = parents[i] != model::index(model::GroupId::none);
    const bool states = attributes[i] != model::Group::kNoAttributes;
    if ((child && parents[i] >= place.groups) || (states && attributes[i] >= place.attributes)) {
      in->refuse("a group refers to what is not there");
      return in->finish();
    }
    if (child) group.parent = model::GroupId{place.first_group + parents[i]};
    if (states) group.attributes = place.first_attributes + attributes[i];
  }
  return {};
}

Result<Blob> pack_attributes(std::span<const model::Attributes> attributes) {
  std::vector<const model::Attributes*> owners;
  owners.reserve(attributes.size());
  for (const model::Attributes& one : attributes) owners.push_back(&one);
  BlobWriter out;
  write_attributes(out, owners);
  return out.finish();
}

Status unpack_attributes(std::span<const std::byte> blob, std::string what,
                         std::span<model::Attributes> attributes) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  std::vector<model::Attributes*> owners;
  owners.reserve(attributes.size());
  for (model::Attributes& one : attributes) owners.push_back(&one);
  read_attributes(*in, owners);
  return in->finish();
}

}  // namespace strake::project
