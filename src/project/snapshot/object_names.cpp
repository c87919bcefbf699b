// SPDX-License-Identifier: Apache-2.0
#include "project/snapshot/object_names.hpp"

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace strake::project {
namespace {

/// Texts behind each other, which compress as such.
void write_texts(BlobWriter& out, const model::Model& model, std::string model::Object::* text) {
  std::vector<std::uint32_t> lengths(model.objects.size());
  for (std::size_t o = 0; o < lengths.size(); ++o)
    lengths[o] = static_cast<std::uint32_t>((model.objects[o].*text).size());
  out.planes(std::span<const std::uint32_t>(lengths));
  out.joined_text(lengths.size(),
                  [&](std::size_t o) -> std::string_view { return model.objects[o].*text; });
}

void read_texts(BlobReader& in, model::Model& model, std::string model::Object::* text) {
  const std::vector<std::uint32_t> lengths = in.planes<std::uint32_t>();
  const std::string all = in.text();
  if (lengths.size() != model.objects.size())
    return in.refuse("it has not as many names as objects");
  std::size_t at = 0;
  for (std::size_t o = 0; o < lengths.size(); ++o) {
    if (lengths[o] > all.size() - at) return in.refuse("a name ends behind all names");
    model.objects[o].*text = all.substr(at, lengths[o]);
    at += lengths[o];
  }
}

}  // namespace

BlobWriter names_of(const model::Model& model) {
  BlobWriter out;
  std::vector<std::string> labels;
  for (const model::SourceFile& file : model.files) labels.push_back(file.label);
  out.texts(labels);
  std::vector<std::uint32_t> files;
  std::vector<bool> positional;
  files.reserve(model.objects.size());
  positional.reserve(model.objects.size());
  for (const model::Object& object : model.objects) {
    files.push_back(object.file);
    positional.push_back(object.positional_id);
  }
  out.planes(std::span<const std::uint32_t>(files));
  out.flags(positional);
  write_texts(out, model, &model::Object::id);
  write_texts(out, model, &model::Object::name);
  return out;
}

Result<std::vector<std::byte>> encode_names(const model::Model& model) {
  return names_of(model).finish();
}

Result<model::Model> decode_names(std::span<const std::byte> bytes, const std::string& what) {
  Result<BlobReader> in = BlobReader::open(bytes, what);
  if (!in) return in.error();
  model::Model model;
  for (std::string& label : in->texts()) model.files.emplace_back().label = std::move(label);
  const std::vector<std::uint32_t> files = in->planes<std::uint32_t>();
  const std::vector<bool> positional = in->flags();
  if (positional.size() != files.size()) in->refuse("it has not as many ids as objects");
  if (!in->failed()) model.objects.resize(files.size());
  for (std::size_t o = 0; o < model.objects.size(); ++o) {
    model.objects[o].file = files[o];
    model.objects[o].positional_id = positional[o];
    if (files[o] >= model.files.size()) in->refuse("an object is of no file");
  }
  read_texts(*in, model, &model::Object::id);
  read_texts(*in, model, &model::Object::name);
  if (const Status status = in->finish(); !status) return status.error();
  return model;
}

}  // namespace strake::project
