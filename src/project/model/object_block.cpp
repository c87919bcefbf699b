// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>
#include <utility>

#include "project/codec/blob.hpp"
#include "project/model/blocks.hpp"
#include "project/model/columns.hpp"

namespace strake::project {
namespace {

constexpr std::uint8_t kIncomplete = 1, kPositional = 2;

/// Returns how many first bytes two ids share, as far as that is stored.
std::uint8_t shared_bytes(std::string_view a, std::string_view b) {
  const std::size_t largest = std::min({a.size(), b.size(), kLongestShared});
  const auto differ =
      std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(largest), b.begin());
  return static_cast<std::uint8_t>(differ.first - a.begin());
}

/// Ids in ascending order, each by what it does not share with the one before it.
void write_ids(BlobWriter& out, std::span<const model::Object> objects) {
  std::vector<std::uint8_t> shared;
  TextColumn rests;
  std::string_view previous;
  for (const model::Object& object : objects) {
    shared.push_back(shared_bytes(previous, object.id));
    rests.add(std::string_view(object.id).substr(shared.back()));
    previous = object.id;
  }
  out.column<std::uint8_t>(shared);
  rests.write(out);
}

void read_ids(BlobReader& in, std::span<model::Object> objects) {
  const std::vector<std::uint8_t> shared = in.column<std::uint8_t>();
  TextSource rests(in);
  if (shared.size() != objects.size() || rests.size() != objects.size()) in.refuse("ids lack");
  if (in.failed()) return;
  std::string_view previous;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string_view rest = rests.next();
    if (shared[i] > previous.size()) return in.refuse("an id lacks its beginning");
    std::string& id = objects[i].id;
    id.reserve(shared[i] + rest.size());
    id = previous.substr(0, shared[i]);
    id += rest;
    if (i > 0 && !(previous < id)) return in.refuse("ids are not in order");
    previous = id;
  }
}

/// Names, most of which are the last part of the id.
void write_names(BlobWriter& out, std::span<const model::Object> objects) {
  std::vector<std::uint32_t> endings;
  TextColumn others;
  for (const model::Object& object : objects) {
    const bool ending = object.id.ends_with(object.name);
    endings.push_back(ending ? static_cast<std::uint32_t>(object.name.size()) + 1 : 0);
    if (!ending) others.add(object.name);
  }
  out.planes(endings);
  others.write(out);
}

void read_names(BlobReader& in, std::span<model::Object> objects) {
  const std::vector<std::uint32_t> endings = read_planes(in, objects.size());
  TextSource others(in);
  const auto own = static_cast<std::size_t>(std::ranges::count(endings, 0U));
  if (own != others.size()) in.refuse("names lack");
  if (in.failed()) return;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    model::Object& object = objects[i];
    if (endings[i] == 0) {
      object.name = others.next();
      continue;
    }
    const std::size_t length = endings[i] - 1;
    if (length > object.id.size()) return in.refuse("a name is longer than its id");
    object.name = std::string_view(object.id).substr(object.id.size() - length);
  }
}

/// Returns one member of each.
template <class Get>
std::vector<std::uint32_t> member(std::span<const model::Object> objects, Get&& get) {
  std::vector<std::uint32_t> values;
  values.reserve(objects.size());
  for (const model::Object& object : objects) values.push_back(get(object));
  return values;
}

/// Takes the numbers of objects; returns which bodies theirs are.
BodyRange read_numbers(BlobReader& in, const FilePlace& place, std::span<model::Object> objects) {
  const std::vector<std::uint32_t> parents = read_steps(in, objects.size());
  const std::vector<std::uint32_t> counts = read_planes(in, objects.size());
  const std::vector<std::uint32_t> places = read_steps(in, objects.size());
  const std::vector<std::uint8_t> flags = in.column<std::uint8_t>();
  if (flags.size() != objects.size()) in.refuse("flags lack");
  BodyRange bodies;
  bodies.first = bodies.last = in.number();
  if (bodies.first > place.bodies) in.refuse("objects have bodies that are not there");
  if (in.failed()) return {};
  for (std::size_t i = 0; i < objects.size(); ++i) {
    model::Object& object = objects[i];
    object.file = place.file;
    const bool child = parents[i] != model::index(model::GroupId::none);
    if ((child && parents[i] >= place.groups) || places[i] >= place.objects ||
        counts[i] > place.bodies - bodies.last || flags[i] > (kIncomplete | kPositional)) {
      in.refuse("an object refers to what is not there");
      return {};
    }
    if (child) object.parent = model::GroupId{place.first_group + parents[i]};
    object.place = place.first_place + places[i];
    object.first_body = place.first_body + static_cast<std::uint32_t>(bodies.last);
    object.body_count = counts[i];
    object.incomplete = (flags[i] & kIncomplete) != 0;
    object.positional_id = (flags[i] & kPositional) != 0;
    bodies.last += counts[i];
  }
  return bodies;
}

}  // namespace

Result<Blob> pack_objects(std::span<const model::Object> objects) {
  BlobWriter out;
  write_ids(out, objects);
  write_names(out, objects);
  write_steps(out, member(objects, [](const auto& o) { return model::index(o.parent); }));
  out.planes(member(objects, [](const auto& o) { return o.body_count; }));
  write_steps(out, member(objects, [](const auto& o) { return o.place; }));
  std::vector<std::uint8_t> flags;
  std::vector<const model::Attributes*> attributes;
  for (const model::Object& object : objects) {
    flags.push_back(static_cast<std::uint8_t>((object.incomplete ? kIncomplete : 0) |
                                              (object.positional_id ? kPositional : 0)));
    attributes.push_back(&object.attributes);
  }
  out.column<std::uint8_t>(flags);
  out.number(objects.empty() ? 0 : objects.front().first_body);
  write_attributes(out, attributes);
  return out.finish();
}

Result<BodyRange> unpack_objects(std::span<const std::byte> blob, std::string what,
                                 const FilePlace& place, std::span<model::Object> objects) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  read_ids(*in, objects);
  read_names(*in, objects);
  const BodyRange bodies = read_numbers(*in, place, objects);
  std::vector<model::Attributes*> attributes;
  attributes.reserve(objects.size());
  for (model::Object& object : objects) attributes.push_back(&object.attributes);
  read_attributes(*in, attributes);
  if (const Status status = in->finish(); !status) return status.error();
  return bodies;
}

}  // namespace strake::project
